//! Flat picture of a window: drawn with as many pixels as there is time for, and to the full when nothing moves.

use crate::picture_shares::{Drawing, PictureShares, STILL_AFTER, part};
use crate::walls::DrawnChannels;
use glam::{DVec2, Vec2Swizzles};
use render::certainty::Certainty;
use render::display::{Accumulator, Adaptation, DevelopedPart, Developer, Development, Enlarger, Seen};
use render::target::{Format, Radiance};
use render::{Gpu, GpuError, Pending, SceneRenderer};
use std::time::{Duration, Instant};
use view::{PixelSample, Shot, Stored};

/// Samples of each pixel of a picture at rest, one a frame.
const STILL_SAMPLES: u32 = 16;
/// Factor on the map's texels for each pixel, along each axis, at rest.
const STILL_MAP: f64 = 1.4;
/// Time that a frame at rest may take: less than the quarter of a second after which own time is not ridden.
const STILL_FRAME: Duration = Duration::from_millis(200);
/// Number of frames for which a complete picture at rest is still developed anew, while the eye adapts.
const ADAPTING_FRAMES: u32 = 20;
/// One picture, and the eye that is adapted to it.
pub struct FlatPicture {
    /// Width and height of the window, pixels.
    size: [u32; 2],
    /// Shares of its width and height that are drawn while anything changes, and at rest.
    shares: PictureShares,
    /// Texels of a map for each pixel while anything changes.
    map_scale: f64,
    /// Light of the frame drawn last.
    radiance: Radiance,
    still: Option<Still>,
    /// Picture drawn last, and the time of the last change.
    shown: Option<(Shot, Instant)>,
    developer: Developer,
    enlarger: Enlarger,
    adaptation: Adaptation,
    stored: Stored,
    certainty: Certainty,
}

/// Picture at rest: the sum of its samples so far.
struct Still {
    sum: Accumulator,
    samples: u32,
    /// Size of the cut that is drawn: another cut begins another sum.
    triangles: Option<usize>,
    /// Development of the picture shown last, and number of frames for which it is complete.
    developed: Option<Development>,
    frames: u32,
    /// Time of the sample before, and the longest time from one to the next.
    sampled: Option<Instant>,
    longest: Duration,
}

impl FlatPicture {
    /// A picture of `size` pixels, shown on a screen of this format. `map_scale`: texels of a map for each pixel.
    pub fn new(gpu: &Gpu, size: [u32; 2], format: Format, screen: wgpu::TextureFormat, map_scale: f64) -> Self {
        Self {
            size,
            shares: PictureShares::default(),
            map_scale,
            radiance: Radiance::new(gpu, size, format),
            still: None,
            shown: None,
            developer: Developer::new(gpu, format.colour, screen),
            enlarger: Enlarger::new(gpu, screen),
            adaptation: Adaptation::new(gpu),
            stored: Stored::UNSHIFTED,
            certainty: Certainty::default(),
        }
    }

    /// Width and height of the window's picture, pixels.
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// Changes the size of the window, pixels.
    pub fn resize(&mut self, size: [u32; 2]) {
        if self.size != size {
            (self.size, self.still, self.shown) = (size, None, None);
        }
    }

    /// Changes the shares of the window's width and height that are drawn.
    pub fn set_shares(&mut self, shares: PictureShares) {
        self.shares = shares;
    }

    /// Share of the window's width and height that the frame drawn last has.
    pub fn share(&self) -> f64 {
        f64::from(self.radiance.size[0]) / f64::from(self.size[0].max(1))
    }

    /// Way in which the frame was drawn last.
    pub fn drawing(&self) -> Drawing {
        if self.still.is_some() { Drawing::Resting } else { Drawing::Moving }
    }

    /// Changes the texels of a map for each pixel.
    pub fn set_map_scale(&mut self, map_scale: f64) {
        self.map_scale = map_scale;
    }

    /// Begins anew, as if nothing had been drawn: the next frame is not at rest.
    pub fn begin_anew(&mut self) {
        (self.still, self.shown) = (None, None);
    }

    /// Draws the light of a frame, or adds a sample to the picture if nothing has changed for a while.
    ///
    /// # Errors
    /// [`GpuError::Lost`] if the device went away.
    pub fn draw(
        &mut self,
        gpu: &Gpu,
        renderer: &mut SceneRenderer,
        shot: &Shot,
        pending: Pending,
    ) -> Result<DrawnChannels, GpuError> {
        let transformed = renderer.show(gpu, pending)?;
        self.stored = renderer.stored(shot);
        let rests_since = self.shown.filter(|(before, _)| {
            let held = before.observer.event.ct == shot.observer.event.ct;
            looks_alike(before, shot) && (held || renderer.is_still_in(shot, self.size))
        });
        let since = rests_since.map_or_else(Instant::now, |(_, since)| since);
        self.shown = Some((*shot, since));
        if rests_since.is_some() && since.elapsed() >= STILL_AFTER {
            self.add_sample(gpu, renderer, shot);
        } else {
            self.still = None;
            renderer.set_map_texels(self.map_scale, DVec2::ZERO);
            self.fit(gpu, part(self.size, self.shares.moving));
            renderer.prepare(gpu, shot, self.radiance.size);
            self.expose(gpu, renderer, shot, PixelSample::WHOLE);
            self.certainty = renderer.certainty(shot, self.radiance.size);
        }
        Ok(DrawnChannels {
            behind: Vec::new(),
            not_finite: transformed.not_finite,
            transform: transformed.duration,
            certainty: self.certainty,
        })
    }

    /// Adds a sample to the picture at rest, until it has all of them.
    fn add_sample(&mut self, gpu: &Gpu, renderer: &mut SceneRenderer, shot: &Shot) {
        // A complete picture with fewer pixels than there is time for begins again with more.
        let share = self.share();
        let finer = self.still.as_ref().filter(|still| still.frames >= ADAPTING_FRAMES && share < 0.995).map(|still| {
            let pace = STILL_FRAME.as_secs_f64() / still.longest.as_secs_f64().max(1e-3);
            (share * pace.sqrt()).min(1.0)
        });
        if let Some(finer) = finer.filter(|finer| *finer > 1.05 * share) {
            self.shares.resting = finer;
            self.still = None;
        }
        if self.still.is_none() {
            self.fit(gpu, part(self.size, self.shares.resting));
        }
        let size = self.radiance.size;
        let mut still = self.still.take().unwrap_or_else(|| Still {
            sum: self.developer.accumulator(gpu, size),
            samples: 0,
            triangles: None,
            developed: None,
            frames: 0,
            sampled: None,
            longest: Duration::ZERO,
        });
        // A cut of the scene may still be coming; after it, every sample is drawn from the same one.
        if still.samples < STILL_SAMPLES || renderer.cut_stats().is_some() {
            renderer.set_map_texels(STILL_MAP * self.map_scale, map_shift(still.samples % STILL_SAMPLES));
            renderer.prepare(gpu, shot, size);
        }
        let triangles = renderer.cut_stats().map(|cut| cut.triangles);
        if triangles != still.triangles {
            still.sum.restart();
            (still.samples, still.triangles) = (0, triangles);
        }
        if still.samples < STILL_SAMPLES {
            self.expose(gpu, renderer, shot, PixelSample::of(still.samples, STILL_SAMPLES));
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            self.developer.add(gpu, &mut encoder, &mut still.sum, self.radiance.result(), STILL_SAMPLES);
            gpu.queue.submit([encoder.finish()]);
            still.samples += 1;
            let before = still.sampled.replace(Instant::now());
            still.longest = still.longest.max(before.map_or(Duration::ZERO, |before| before.elapsed()));
            still.frames = 0;
            self.certainty = renderer.certainty(shot, size);
        }
        self.still = Some(still);
    }

    /// Draws a sample into the target.
    fn expose(&self, gpu: &Gpu, renderer: &mut SceneRenderer, shot: &Shot, sample: PixelSample) {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        renderer.draw(gpu, &mut encoder, &self.radiance, shot, sample);
        gpu.queue.submit([encoder.finish()]);
    }

    /// Gives the target this size.
    fn fit(&mut self, gpu: &Gpu, size: [u32; 2]) {
        if self.radiance.size != size {
            self.radiance = Radiance::new(gpu, size, self.radiance.format);
        }
    }

    /// Light of the whole picture in every pixel of the window, and the eye that is adapted to it: drawn anew if the
    /// frame has fewer pixels.
    pub fn whole(&mut self, gpu: &Gpu, renderer: &mut SceneRenderer) -> (&wgpu::TextureView, &Adaptation) {
        if let (Some((shot, _)), true) = (self.shown, self.radiance.size != self.size) {
            // A picture at rest with fewer pixels begins again.
            self.still = None;
            self.fit(gpu, self.size);
            renderer.prepare(gpu, &shot, self.size);
            self.expose(gpu, renderer, &shot, PixelSample::WHOLE);
        }
        let complete = self.still.as_ref().filter(|still| still.samples == STILL_SAMPLES);
        (complete.map_or(self.radiance.result(), |still| still.sum.result()), &self.adaptation)
    }

    /// Adapts the eye to the light drawn last. `elapsed_s`: time to adapt, seconds; `None` adapts at once.
    pub fn adapt(&mut self, gpu: &Gpu, development: &Development, elapsed_s: Option<f64>) {
        if self.still.as_ref().is_some_and(|still| still.frames >= ADAPTING_FRAMES) {
            return;
        }
        let seen = Seen { radiance: self.radiance.result(), stored: self.stored, elapsed_s };
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        self.developer.adapt(gpu, &mut encoder, &mut self.adaptation, &seen, development);
        gpu.queue.submit([encoder.finish()]);
    }

    /// Develops the light for the window.
    pub fn show(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        development: &Development,
        screen: &wgpu::TextureView,
    ) {
        let Self { radiance, still, developer, enlarger, adaptation, .. } = self;
        let part = |exposure: f32| {
            let [width, height] = radiance.size;
            DevelopedPart { viewport: [0, 0, width, height], over: false, exposure, gains: None, gamma: None }
        };
        match still {
            Some(still) if still.samples > 0 => {
                // A complete picture to which the eye is adapted is not developed again.
                if still.frames < ADAPTING_FRAMES || still.developed != Some(*development) {
                    let target = enlarger.target(gpu, radiance.size);
                    // The sum of a part of the samples is that much darker.
                    let part = part(STILL_SAMPLES as f32 / still.samples as f32);
                    developer.show_part(gpu, encoder, still.sum.result(), adaptation, development, &target, &part);
                    still.frames += 1;
                    still.developed = Some(*development);
                }
                enlarger.enlarge(gpu, encoder, screen);
            }
            _ if radiance.size != [screen.texture().width(), screen.texture().height()] => {
                let target = enlarger.target(gpu, radiance.size);
                let light = radiance.result();
                developer.show_part(gpu, encoder, light, adaptation, development, &target, &part(1.0));
                enlarger.enlarge(gpu, encoder, screen);
            }
            _ => developer.show_part(gpu, encoder, radiance.result(), adaptation, development, screen, &part(1.0)),
        }
    }
}

/// Shift of a map's texels for a sample at rest, parts of a texel: as the places in a pixel, in another order, so that
/// both together take every sample elsewhere.
fn map_shift(sample: u32) -> DVec2 {
    PixelSample::of((5 * sample + 7) % STILL_SAMPLES, STILL_SAMPLES).offset.yx()
}

/// True if two pictures of a scene in which nothing moves are the same: the time of the event does not matter.
fn looks_alike(one: &Shot, other: &Shot) -> bool {
    let same = |shot: &Shot| (shot.observer.event.position, shot.observer.celerity, shot.outside);
    same(one) == same(other)
        && (one.camera, one.effects, one.stored_scale) == (other.camera, other.effects, other.stored_scale)
}
