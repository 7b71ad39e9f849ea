//! One channel's picture: its targets, and how it is drawn for an eye.

use crate::curved::Curved;
use crate::enlarged_light::LightEnlarger;
use crate::facet::Facet;
use crate::gains;
use crate::head::OccupantEye;
use crate::picture_shares::part;
use crate::quality::Quality;
use glam::{DMat3, DQuat};
use render::certainty::Certainty;
use render::display::{Accumulator, Developer, Pass, clear};
use render::target::{Radiance, texture};
use render::{BentScreen, Gpu, HiddenArea, SceneRenderer, near_m};
use room::{Channel, Display, EyeBehind, FlatSurface, frustum};
use view::{Camera, Effects, Field, PixelSample, Shot, Stored, Tangents};

/// Side of the square of pixels that share one computed gain, pixels.
const COARSER_GAINS: u32 = 4;

/// Light of one channel.
pub struct ChannelPicture {
    target: PictureTarget,
    /// Light of all pixels, while fewer are drawn.
    enlarged: Option<wgpu::TextureView>,
    sum: Option<Accumulator>,
    /// Gains that the pixels are multiplied by.
    pub gains: Option<wgpu::TextureView>,
    /// Developed picture in linear light, once it has been asked for.
    pub developed: Option<wgpu::TextureView>,
    /// Scale and kind of the stored light.
    pub stored: Stored,
    /// Near plane of the picture drawn last, metres, if it has depth.
    near_m: Option<f64>,
}

/// Textures that a channel is drawn into.
enum PictureTarget {
    /// Target of a flat screen, drawn at once.
    Flat(Box<Radiance>),
    /// Targets of a curved screen: the whole picture, or flat pictures that are resampled.
    Curved(Box<Curved>),
}

/// Context in which the channels of one eye are drawn.
pub struct EyeContext<'a> {
    /// Graphics device.
    pub gpu: &'a Gpu,
    /// Fineness of the pictures.
    pub quality: &'a Quality,
    /// Passes that add up samples.
    pub passes: &'a Developer,
    /// Pass that enlarges light, where its format allows that.
    pub enlarger: Option<&'a LightEnlarger>,
    /// Pass that resamples flat pictures onto a curved surface.
    pub resample: &'a Pass,
    /// Eye of the occupant.
    pub eye: OccupantEye,
    /// Relativistic effects on the picture.
    pub effects: Effects,
    /// Factor of the stored light that all pictures share; `None` if each channel has its own.
    pub stored_scale: Option<f64>,
}

impl EyeContext<'_> {
    /// View of a flat picture in the room.
    fn shot(&self, room_from_eye: DMat3, tangents: Tangents) -> Shot {
        let observer_from_eye = self.eye.observer_from_room * DQuat::from_mat3(&room_from_eye);
        Shot {
            camera: Camera { observer_from_eye, field: Field::Screen(tangents) },
            observer: self.eye.observer,
            effects: self.effects,
            stored_scale: None,
            outside: None,
        }
    }
}

impl ChannelPicture {
    /// Creates the targets and tables of a channel.
    pub fn new(gpu: &Gpu, display: &Display, channel: &Channel, quality: &Quality, passes: &Developer) -> Self {
        let size = channel.size();
        let mut picture = match channel.flat(display) {
            Some(_) => Self::flat(gpu, size, quality, passes),
            None => Self::curved(gpu, Curved::new(gpu, display, channel, quality.format), quality, passes),
        };
        picture.update_gains(gpu, display, channel);
        picture
    }

    /// Creates the targets of a flat picture of `size` pixels.
    pub fn flat(gpu: &Gpu, size: [u32; 2], quality: &Quality, passes: &Developer) -> Self {
        let target = Radiance::new(gpu, size, quality.format);
        Self::with(gpu, PictureTarget::Flat(Box::new(target)), size, quality, passes)
    }

    /// Creates the targets of a picture whose pixels show points of any surface.
    pub fn curved(gpu: &Gpu, curved: Curved, quality: &Quality, passes: &Developer) -> Self {
        let size = curved.shown.size;
        Self::with(gpu, PictureTarget::Curved(Box::new(curved)), size, quality, passes)
    }

    fn with(gpu: &Gpu, target: PictureTarget, size: [u32; 2], quality: &Quality, passes: &Developer) -> Self {
        let sum = (quality.samples > 1).then(|| passes.accumulator(gpu, size));
        Self { target, enlarged: None, sum, gains: None, developed: None, stored: Stored::UNSHIFTED, near_m: None }
    }

    /// Computes the gains of the channel's pixels anew.
    pub fn update_gains(&mut self, gpu: &Gpu, display: &Display, channel: &Channel) {
        // Measured maps have edges and need every pixel. Computed gains are smooth.
        let measured = channel.alpha.is_some() || channel.beta.is_some();
        let finest = if measured { channel.size() } else { channel.size().map(|side| side.div_ceil(COARSER_GAINS)) };
        self.gains = channel.gains(display, finest).map(|gains| gains::upload(gpu, &gains));
    }

    /// Draws with this share of the channel's width and height from now on.
    pub fn fit(&mut self, gpu: &Gpu, display: &Display, channel: &Channel, share: f64) {
        let size = part(channel.size(), share);
        match &mut self.target {
            PictureTarget::Flat(target) if target.size == size => {}
            PictureTarget::Flat(target) => **target = target.resized(gpu, size),
            PictureTarget::Curved(curved) => curved.fit(gpu, display, channel, size),
        }
        let usage = wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING;
        let made = |format| texture(gpu, "enlarged light", channel.size(), format, 1, usage);
        let format = self.drawn().texture().format();
        self.enlarged = (size != channel.size()).then(|| self.enlarged.take().unwrap_or_else(|| made(format)));
    }

    /// Keeps the depth of flat pictures from now on.
    pub fn keep_depth(&mut self) {
        if let PictureTarget::Flat(target) = &mut self.target {
            target.keeps_depth = true;
        }
    }

    /// Draws nothing in these triangles of a flat picture from now on: tangents to the right and up, three by three.
    pub fn hide(&mut self, gpu: &Gpu, corners: &[[f32; 2]]) {
        if let PictureTarget::Flat(target) = &mut self.target {
            target.hidden = (!corners.is_empty()).then(|| HiddenArea::new(gpu, target.format, corners));
        }
    }

    /// Draws all of a flat picture from now on, and keeps no depth.
    pub fn show_whole(&mut self) {
        if let PictureTarget::Flat(target) = &mut self.target {
            (target.hidden, target.keeps_depth) = (None, false);
        }
    }

    /// Target of a flat picture with the depth of what was drawn last, and its near plane, metres.
    pub fn depth(&self) -> Option<(&Radiance, f64)> {
        match &self.target {
            PictureTarget::Flat(target) if target.keeps_depth => Some((target, self.near_m?)),
            _ => None,
        }
    }

    /// Light as it was drawn.
    fn drawn(&self) -> &wgpu::TextureView {
        match &self.target {
            PictureTarget::Flat(target) => target.result(),
            PictureTarget::Curved(curved) => curved.shown.result(),
        }
    }

    /// Point of the room for each of the channel's pixels, if its screen is not flat.
    pub fn points(&self) -> Option<&wgpu::TextureView> {
        match &self.target {
            PictureTarget::Flat(_) => None,
            PictureTarget::Curved(curved) => Some(&curved.whole_points),
        }
    }

    /// Light of the newest sample.
    fn sample(&self) -> &wgpu::TextureView {
        self.enlarged.as_ref().unwrap_or_else(|| self.drawn())
    }

    /// Light of the channel: the sum of its samples.
    pub fn light(&self) -> &wgpu::TextureView {
        self.sum.as_ref().map_or_else(|| self.sample(), Accumulator::result)
    }

    /// Views and sizes of the channel's flat pictures. If the eye is behind the screen, the picture is made black.
    /// `flat`: the screen, if it is flat.
    ///
    /// # Errors
    /// [`EyeBehind`] if the eye is behind the screen.
    pub fn aim(
        &mut self,
        flat: Option<&FlatSurface>,
        renderer: &SceneRenderer,
        context: &EyeContext<'_>,
    ) -> Result<Vec<(Shot, [u32; 2])>, EyeBehind> {
        let mut shots = match self.shots(flat, renderer, context) {
            Ok(shots) => shots,
            Err(behind) => {
                self.blacken(context.gpu);
                return Err(behind);
            }
        };
        // The pictures of a channel store light with the same scale.
        let scale = context.stored_scale.or_else(|| shots.first().map(|(shot, _)| shot.scale()));
        shots.iter_mut().for_each(|(shot, _)| shot.stored_scale = scale);
        Ok(shots)
    }

    /// Draws all samples of the views, for an eye that the renderer has been prepared for.
    pub fn draw(
        &mut self,
        renderer: &mut SceneRenderer,
        shots: &[(Shot, [u32; 2])],
        context: &EyeContext<'_>,
    ) -> Certainty {
        let &EyeContext { gpu, quality, passes, .. } = context;
        let Some((first, size)) = shots.first() else {
            self.blacken(gpu);
            return Certainty::default();
        };
        self.stored = renderer.stored(first);
        let near_m = || near_m(first.observer.celerity, first.effects.places);
        self.near_m = renderer.has_depth(first).then(near_m);

        if let Some(sum) = &mut self.sum {
            sum.restart();
        }
        let submit = |encoder: wgpu::CommandEncoder| gpu.queue.submit([encoder.finish()]);
        // A picture that is drawn at once is prepared once for all samples.
        let whole_size = match &self.target {
            PictureTarget::Flat(target) => Some(target.size),
            PictureTarget::Curved(curved) if curved.targets.is_empty() => Some(curved.shown.size),
            PictureTarget::Curved(_) => None,
        };
        if let Some(size) = whole_size {
            renderer.prepare_picture(gpu, shots, size);
        }
        for sample in 0..quality.samples {
            let place = PixelSample::of(sample, quality.samples);
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            match &self.target {
                PictureTarget::Flat(target) => renderer.draw(gpu, &mut encoder, target, first, place),
                PictureTarget::Curved(curved) if whole_size.is_some() => {
                    let OccupantEye { place_m: eye_m, observer_from_room, .. } = context.eye;
                    let screen = BentScreen { points: &curved.points, eye_m, observer_from_room };
                    renderer.draw_bent(gpu, &mut encoder, &curved.shown, first, place, &screen);
                }
                PictureTarget::Curved(curved) => {
                    // A pixel of the screen has several of a facet.
                    let width = (place.width * quality.density).min(1.0);
                    let place = PixelSample { offset: place.offset * quality.density, width };
                    for (target, shot) in curved.targets.iter().zip(shots) {
                        // A single picture is prepared once for all samples.
                        if sample == 0 || shots.len() > 1 {
                            renderer.prepare_picture(gpu, &[*shot], shot.1);
                        }
                        let mut encoder = gpu.device.create_command_encoder(&Default::default());
                        renderer.draw(gpu, &mut encoder, target, &shot.0, place);
                        submit(encoder);
                    }
                    curved.resample(gpu, &mut encoder, context.resample, context.eye.place_m);
                }
            }
            if let (Some(enlarger), Some(whole)) = (context.enlarger, &self.enlarged) {
                enlarger.enlarge(gpu, &mut encoder, self.drawn(), whole);
            }
            submit(encoder);
            if let Some(mut sum) = self.sum.take() {
                let mut encoder = gpu.device.create_command_encoder(&Default::default());
                passes.add(gpu, &mut encoder, &mut sum, self.sample(), quality.samples);
                submit(encoder);
                self.sum = Some(sum);
            }
        }
        renderer.certainty(first, *size)
    }

    /// Views and sizes of the channel's flat pictures.
    fn shots(
        &mut self,
        flat: Option<&FlatSurface>,
        renderer: &SceneRenderer,
        context: &EyeContext<'_>,
    ) -> Result<Vec<(Shot, [u32; 2])>, EyeBehind> {
        let place_m = context.eye.place_m;
        match &mut self.target {
            PictureTarget::Flat(target) => {
                let frustum = frustum(flat.expect("its screen is flat"), place_m)?;
                if let Some(hidden) = &target.hidden {
                    hidden.place(context.gpu, &frustum.tangents);
                }
                Ok(vec![(context.shot(frustum.room_from_eye, frustum.tangents), target.size)])
            }
            PictureTarget::Curved(curved) => {
                let share = f64::from(curved.shown.size[0]) / f64::from(curved.whole_points.texture().width());
                if renderer.shows_bent_screens(context.effects) {
                    curved.look_from(context.gpu, place_m, share);
                    curved.targets.clear();
                } else {
                    curved.look_from(context.gpu, place_m, share * context.quality.density);
                    curved.make_targets(context.gpu, context.quality.format);
                }
                let shot = |facet: &Facet| (context.shot(facet.room_from_facet, facet.tangents), facet.size);
                Ok(curved.facets.iter().map(shot).collect())
            }
        }
    }

    /// Makes the picture black.
    fn blacken(&self, gpu: &Gpu) {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        match &self.target {
            PictureTarget::Flat(target) => drop(target.begin(&mut encoder)),
            PictureTarget::Curved(curved) => drop(clear(&mut encoder, curved.shown.result())),
        }
        if let Some(enlarged) = &self.enlarged {
            drop(clear(&mut encoder, enlarged));
        }
        if let Some(sum) = &self.sum {
            sum.blacken(&mut encoder);
        }
        gpu.queue.submit([encoder.finish()]);
    }
}
