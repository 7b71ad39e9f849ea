//! Pictures of scenes without a window: several samples a pixel, exact to f32.

use crate::darkroom::{Darkroom, Developing};
use crate::light::{light, texels, upload};
use glam::{DVec3, Vec3};
use image::{Rgb32FImage, RgbaImage};
use render::display::{Accumulator, Development, Seen};
use render::target::{Format, Radiance};
use render::{Gpu, GpuError, Pending, SceneRenderer, Subject};
use view::{PixelSample, Shot, Stored};

/// Place in the scene that a pixel's centre shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shown {
    /// Place in metres relative to the scene's origin; for a moving body, in its own frame.
    pub position: DVec3,
    /// Index into the scene's motions; `None` for a resting surface.
    pub motion: Option<usize>,
    /// Exact apparent position of that place, relative to the observer in the observer's axes, metres. The place
    /// where it was drawn may differ.
    pub apparent: DVec3,
}

/// Targets of one size, used again for every picture.
pub struct Studio {
    size: [u32; 2],
    samples: u32,
    radiance: Radiance,
    sum: Accumulator,
    darkroom: Darkroom,
}

impl Studio {
    /// Makes the targets. `samples` is the number of samples for each pixel; a single sample lies at the pixel's
    /// centre.
    pub fn new(gpu: &Gpu, size: [u32; 2], samples: u32) -> Self {
        Self::with_format(gpu, size, samples, Self::format(gpu))
    }

    /// Makes the targets for renderers that draw in the given format.
    pub fn with_format(gpu: &Gpu, size: [u32; 2], samples: u32, format: Format) -> Self {
        Self::with_darkroom(gpu, size, samples, format, Darkroom::new(gpu, size, format.colour))
    }

    /// Makes the targets for pictures that a darkroom of their size develops.
    pub fn with_darkroom(gpu: &Gpu, size: [u32; 2], samples: u32, format: Format, darkroom: Darkroom) -> Self {
        Self { size, samples, radiance: Radiance::new(gpu, size, format), sum: darkroom.accumulator(gpu), darkroom }
    }

    /// Target format of the renderers whose pictures are taken here.
    pub fn format(gpu: &Gpu) -> Format {
        Format::exact(gpu)
    }

    /// Takes a picture.
    ///
    /// # Arguments
    /// * `pending` — what [`SceneRenderer::submit`] gave for the shot's observer.
    /// * `elapsed_s` — the observer's proper time since the picture before, seconds, for the adaptation of the eye;
    ///   `None` adapts it at once.
    ///
    /// # Errors
    /// [`GpuError::Lost`] if the device went away.
    pub fn photograph(
        &mut self,
        gpu: &Gpu,
        renderer: &mut SceneRenderer,
        shot: &Shot,
        pending: Pending,
        development: &Development,
        elapsed_s: Option<f64>,
    ) -> Result<RgbaImage, GpuError> {
        self.begin(gpu, renderer, shot, pending, development, elapsed_s)?.finish_one(gpu)
    }

    /// Begins to take a picture, as [`photograph`](Self::photograph) does. The next one may be begun at once.
    ///
    /// # Errors
    /// [`GpuError::Lost`] if the device went away.
    pub fn begin(
        &mut self,
        gpu: &Gpu,
        renderer: &mut SceneRenderer,
        shot: &Shot,
        pending: Pending,
        development: &Development,
        elapsed_s: Option<f64>,
    ) -> Result<Developing, GpuError> {
        let stored = self.draw(gpu, renderer, shot, pending)?;
        let radiance = if self.samples > 1 { self.sum.result() } else { self.radiance.result() };
        Ok(self.darkroom.begin(gpu, &[Seen { radiance, stored, elapsed_s }], development))
    }

    /// Takes a picture as light: linear sRGB in cd/m², before exposure, tone curve and gamut. Values beyond the range
    /// of f32 become its largest value.
    ///
    /// # Errors
    /// Those of [`Studio::photograph`].
    pub fn expose(
        &mut self,
        gpu: &Gpu,
        renderer: &mut SceneRenderer,
        shot: &Shot,
        pending: Pending,
    ) -> Result<Rgb32FImage, GpuError> {
        let stored = self.draw(gpu, renderer, shot, pending)?;
        let radiance = if self.samples > 1 { self.sum.result() } else { self.radiance.result() };
        light(gpu, radiance, &stored)
    }

    /// Develops light that was computed elsewhere: texels as the renderers draw them, row by row, for a picture of
    /// this studio's size.
    ///
    /// # Errors
    /// Those of [`Studio::photograph`].
    pub fn develop(
        &mut self,
        gpu: &Gpu,
        texels: &[[f32; 4]],
        stored: Stored,
        development: &Development,
        elapsed_s: Option<f64>,
    ) -> Result<RgbaImage, GpuError> {
        let radiance = upload(gpu, self.size, texels, self.radiance.format.colour);
        self.darkroom.begin(gpu, &[Seen { radiance: &radiance, stored, elapsed_s }], development).finish_one(gpu)
    }

    /// Place in the scene that each pixel's centre shows, row by row; `None` for a pixel that shows no surface. The
    /// places are exact only if the device draws 32-bit floats.
    ///
    /// # Errors
    /// Those of [`Studio::photograph`].
    pub fn places(
        &mut self,
        gpu: &Gpu,
        renderer: &mut SceneRenderer,
        shot: &Shot,
        pending: Pending,
    ) -> Result<Vec<Option<Shown>>, GpuError> {
        renderer.subject = Subject::Places;
        let drawn = self.draw_samples(gpu, renderer, shot, pending, 1);
        renderer.subject = Subject::Light;
        drawn?;
        let sights = renderer.sights(shot);
        let shown = |[x, y, z, whose]: [f32; 4]| {
            let position = Vec3::new(x, y, z).as_dvec3();
            let index = (whose.round() as usize).checked_sub(1)?;
            Some(Shown { position, motion: index.checked_sub(1), apparent: sights.get(index)?.apparent(position) })
        };
        Ok(texels(gpu, self.radiance.result())?.into_iter().map(shown).collect())
    }

    /// Begins to take a picture that is drawn once for each of these shots, which share its light evenly: from the
    /// places of a lens, at the moments of an exposure.
    ///
    /// # Errors
    /// [`GpuError::Lost`] if the device went away.
    pub fn begin_of_many(
        &mut self,
        gpu: &Gpu,
        renderer: &mut SceneRenderer,
        shots: &[Shot],
        development: &Development,
        elapsed_s: Option<f64>,
    ) -> Result<Developing, GpuError> {
        let stored = self.draw_many(gpu, renderer, shots)?;
        let radiance = self.sum.result();
        Ok(self.darkroom.begin(gpu, &[Seen { radiance, stored, elapsed_s }], development))
    }

    /// Light of a picture that is drawn once for each of these shots.
    ///
    /// # Errors
    /// [`GpuError::Lost`] if the device went away.
    pub fn expose_many(
        &mut self,
        gpu: &Gpu,
        renderer: &mut SceneRenderer,
        shots: &[Shot],
    ) -> Result<Rgb32FImage, GpuError> {
        let stored = self.draw_many(gpu, renderer, shots)?;
        light(gpu, self.sum.result(), &stored)
    }

    fn draw_many(&mut self, gpu: &Gpu, renderer: &mut SceneRenderer, shots: &[Shot]) -> Result<Stored, GpuError> {
        let count = shots.len() as u32;
        self.sum.restart();
        let mut stored = Stored::UNSHIFTED;
        let submit = |renderer: &mut SceneRenderer, shot: &Shot| renderer.submit(gpu, &shot.observer, shot.effects);
        let mut pending = shots.first().map(|shot| submit(renderer, shot)).transpose()?;
        for (shot, sample) in shots.iter().zip(0..) {
            let own = pending.take().unwrap_or_default();
            // The next eye's photo-surface is worked out while this one's is drawn.
            pending = shots.get(sample as usize + 1).map(|next| submit(renderer, next)).transpose()?;
            renderer.show(gpu, own)?;
            renderer.prepare(gpu, shot, self.size);
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            renderer.draw(gpu, &mut encoder, &self.radiance, shot, PixelSample::of(sample, count));
            self.darkroom.add(gpu, &mut encoder, &mut self.sum, self.radiance.result(), count);
            gpu.queue.submit([encoder.finish()]);
            // One of them moves, or none does.
            let own = renderer.stored(shot);
            stored = Stored { shifted: stored.shifted || own.shifted, ..own };
        }
        Ok(stored)
    }

    /// Draws all samples, and adds them up.
    fn draw(
        &mut self,
        gpu: &Gpu,
        renderer: &mut SceneRenderer,
        shot: &Shot,
        pending: Pending,
    ) -> Result<Stored, GpuError> {
        self.draw_samples(gpu, renderer, shot, pending, self.samples)
    }

    fn draw_samples(
        &mut self,
        gpu: &Gpu,
        renderer: &mut SceneRenderer,
        shot: &Shot,
        pending: Pending,
        samples: u32,
    ) -> Result<Stored, GpuError> {
        renderer.show(gpu, pending)?;
        renderer.prepare(gpu, shot, self.size);
        self.sum.restart();
        for sample in 0..samples {
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            renderer.draw(gpu, &mut encoder, &self.radiance, shot, PixelSample::of(sample, samples));
            if samples > 1 {
                self.darkroom.add(gpu, &mut encoder, &mut self.sum, self.radiance.result(), samples);
            }
            gpu.queue.submit([encoder.finish()]);
        }
        Ok(renderer.stored(shot))
    }
}
