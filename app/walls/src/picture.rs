//! One channel: where it is drawn, and how it is drawn for an eye.

use super::Quality;
use super::curved::Curved;
use super::facet::Facet;
use super::head::OccupantEye;
use crate::gpu::Gpu;
use crate::renderers::certainty::Certainty;
use crate::renderers::display::{self, Accumulator, Pass, Stored};
use crate::renderers::target::Radiance;
use crate::renderers::{Effects, SceneRenderer, Shot};
use crate::room::{Channel, Display, EyeBehind, frustum};
use crate::views::{Camera, Field, Tangents, sample_offset};
use glam::{DMat3, DQuat, DVec2};
use physics::photo_surface::Eye as Vantage;

/// Pixels along each side for which a gain is worked out.
const COARSER_GAINS: u32 = 4;

/// One channel's light.
pub struct Picture {
    way: Way,
    sum: Option<Accumulator>,
    /// What its pixels are multiplied by.
    pub gains: Option<wgpu::TextureView>,
    /// In linear light, once that was asked for.
    pub developed: Option<wgpu::TextureView>,
    /// How its light is held.
    pub stored: Stored,
}

enum Way {
    Flat(Box<Radiance>),
    Curved(Box<Curved>),
}

/// Who draws what for whom.
pub struct Sitting<'a> {
    /// The device.
    pub gpu: &'a Gpu,
    /// The room.
    pub display: &'a Display,
    /// How finely.
    pub quality: &'a Quality,
    /// Sums of samples.
    pub passes: &'a display::Display,
    /// From flat pictures to surfaces.
    pub resample: &'a Pass,
    /// Who looks.
    pub eye: OccupantEye,
    /// The same, for renderers.
    pub vantage: Vantage,
    /// What relativity does.
    pub effects: Effects,
}

impl Sitting<'_> {
    /// What a flat picture in the room shows.
    fn shot(&self, room_from_eye: DMat3, tangents: Tangents) -> Shot {
        let observer_from_eye = self.eye.observer_from_room * DQuat::from_mat3(&room_from_eye);
        Shot {
            camera: Camera { observer_from_eye, field: Field::Screen(tangents) },
            eye: self.vantage,
            ct: self.eye.observer.event.ct,
            effects: self.effects,
            stored_scale: None,
        }
    }
}

impl Picture {
    /// Targets and tables of a channel.
    pub fn new(gpu: &Gpu, display: &Display, channel: &Channel, quality: &Quality, passes: &display::Display) -> Self {
        let size = channel.size();
        let way = match channel.flat(display) {
            Some(_) => Way::Flat(Box::new(Radiance::new(gpu, size, quality.format))),
            None => Way::Curved(Box::new(Curved::new(gpu, display, channel, quality.format))),
        };
        let sum = (quality.samples > 1).then(|| passes.accumulator(gpu, size));
        let mut picture = Self { way, sum, gains: None, developed: None, stored: Stored::UNSHIFTED };
        picture.brighten(gpu, display, channel);
        picture
    }

    /// Works out what its pixels are multiplied by.
    pub fn brighten(&mut self, gpu: &Gpu, display: &Display, channel: &Channel) {
        // Measured maps have edges; what is worked out has none.
        let measured = channel.alpha.is_some() || channel.beta.is_some();
        let finest = if measured { channel.size() } else { channel.size().map(|side| side.div_ceil(COARSER_GAINS)) };
        self.gains = channel.gains(display, finest).map(|gains| display::gains(gpu, &gains));
    }

    /// The light of the newest sample.
    fn sample(&self) -> &wgpu::TextureView {
        match &self.way {
            Way::Flat(target) => target.result(),
            Way::Curved(curved) => &curved.shown,
        }
    }

    /// The light of the channel.
    pub fn light(&self) -> &wgpu::TextureView {
        self.sum.as_ref().map_or_else(|| self.sample(), Accumulator::result)
    }

    /// What its flat pictures show, and their pixels. An eye behind its screen sees black.
    ///
    /// # Errors
    /// [`EyeBehind`].
    pub fn aim(&mut self, channel: &Channel, sitting: &Sitting<'_>) -> Result<Vec<(Shot, [u32; 2])>, EyeBehind> {
        let mut shots = match self.shots(channel, sitting) {
            Ok(shots) => shots,
            Err(behind) => {
                self.blacken(sitting.gpu);
                return Err(behind);
            }
        };
        // All of them hold light alike.
        let scale = shots.first().map(|(shot, _)| shot.scale());
        shots.iter_mut().for_each(|(shot, _)| shot.stored_scale = scale);
        Ok(shots)
    }

    /// Draws all samples of them, for an eye that the renderer has been prepared for.
    pub fn draw(
        &mut self,
        renderer: &mut SceneRenderer,
        shots: &[(Shot, [u32; 2])],
        sitting: &Sitting<'_>,
    ) -> Certainty {
        let &Sitting { gpu, quality, passes, .. } = sitting;
        let Some((first, size)) = shots.first() else {
            self.blacken(gpu);
            return Certainty::default();
        };
        self.stored = renderer.stored(first);

        if let Some(sum) = &mut self.sum {
            sum.restart();
        }
        let submit = |encoder: wgpu::CommandEncoder| gpu.queue.submit([encoder.finish()]);
        for sample in 0..quality.samples {
            let offset = sample_offset(sample, quality.samples);
            let (targets, offset): (Vec<_>, _) = match &self.way {
                Way::Flat(target) => (vec![&**target], offset),
                Way::Curved(curved) => {
                    (curved.facets.iter().map(|(_, target)| target).collect(), offset * quality.density)
                }
            };
            for (target, (shot, size)) in targets.into_iter().zip(shots) {
                // What all samples share is kept if there is only one picture.
                if sample == 0 || shots.len() > 1 {
                    renderer.prepare_picture(gpu, shot, *size);
                }
                let mut encoder = gpu.device.create_command_encoder(&Default::default());
                renderer.draw(gpu, &mut encoder, target, shot, offset);
                submit(encoder);
            }
            if let Way::Curved(curved) = &self.way {
                let mut encoder = gpu.device.create_command_encoder(&Default::default());
                curved.resample(gpu, &mut encoder, sitting.resample, sitting.eye.place_m);
                submit(encoder);
            }
            if let Some(mut sum) = self.sum.take() {
                let mut encoder = gpu.device.create_command_encoder(&Default::default());
                passes.add(gpu, &mut encoder, &mut sum, self.sample(), quality.samples);
                submit(encoder);
                self.sum = Some(sum);
            }
        }
        renderer.certainty(first, *size)
    }

    /// Where its flat pictures look.
    fn shots(&mut self, channel: &Channel, sitting: &Sitting<'_>) -> Result<Vec<(Shot, [u32; 2])>, EyeBehind> {
        let place_m = sitting.eye.place_m;
        match &mut self.way {
            Way::Flat(target) => {
                let flat = channel.flat(sitting.display).expect("its screen is flat");
                let frustum = frustum(&flat, place_m)?;
                let low = DVec2::new(frustum.left, frustum.bottom);
                let high = DVec2::new(frustum.right, frustum.top);
                Ok(vec![(sitting.shot(frustum.room_from_eye, Tangents { low, high }), target.size)])
            }
            Way::Curved(curved) => {
                curved.look_from(sitting.gpu, place_m, sitting.quality.density, sitting.quality.format);
                let shot = |facet: &Facet| (sitting.shot(facet.room_from_facet, facet.tangents), facet.size);
                Ok(curved.facets.iter().map(|(facet, _)| shot(facet)).collect())
            }
        }
    }

    /// Shows nothing.
    fn blacken(&self, gpu: &Gpu) {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        match &self.way {
            Way::Flat(target) => drop(target.begin(&mut encoder)),
            Way::Curved(curved) => drop(display::clear(&mut encoder, &curved.shown)),
        }
        if let Some(sum) = &self.sum {
            sum.blacken(&mut encoder);
        }
        gpu.queue.submit([encoder.finish()]);
    }
}
