//! Pictures on the surfaces around a viewer: every channel of a display, drawn for a head in the vehicle.
//!
//! # How it works
//! 1. An [`Occupant`] gives the place of each eye, in the world and in the room ([`head`]).
//! 2. The photo-surface of an eye does not depend on the direction of view, so it is computed once for all channels
//!   of that eye (W 6.4.1).
//! 3. A channel on a flat screen is drawn through the screen's own off-axis frustum. Any other channel is drawn into
//!   flat pictures around the eye ([`facet`]), in which every pixel of the channel then looks up its place
//!   ([`curved`]).
//! 4. Both eyes adapt to all channels together, so that no edge between two screens shows. Then each channel is
//!   developed, multiplied by its projector's gains, and put into its window.

pub mod calibration;
pub mod curved;
pub mod facet;
pub mod head;
mod picture;
pub mod preview;
mod show;
mod test_grid;
pub mod tracker;

pub use head::{Head, Occupant, OccupantEye};

use crate::gpu::{Gpu, GpuError};
use crate::renderers::certainty::Certainty;
use crate::renderers::display::{self, Adaptation, Combiner, Development, Pass, Seen};
use crate::renderers::target::Format;
use crate::renderers::{Effects, SceneRenderer};
use crate::room::{Channel, Display, Eye, EyeBehind, Warp, WindowPlace};
use calibration::Calibration;
use physics::photo_surface::{Eye as Vantage, PhotoSurfaceError};
use picture::{Picture, Sitting};
use std::time::Duration;
use test_grid::Grids;
use thiserror::Error;

/// Reason why a display cannot show anything.
#[derive(Debug, Error)]
pub enum WallsError {
    /// An eye without a valid place or celerity.
    #[error(transparent)]
    Nowhere(#[from] PhotoSurfaceError),
    /// A device that is missing or lost.
    #[error(transparent)]
    Gpu(#[from] GpuError),
}

/// Outcome of drawing the channels.
#[derive(Clone, Debug, Default)]
pub struct Drawn {
    /// Channels that stay black because their eye is behind their screen: the channel's name, and the eye's place.
    pub behind: Vec<(String, EyeBehind)>,
    /// Number of vertices that have no place in the photo-surfaces.
    pub not_finite: usize,
    /// Time that the photo-surfaces took, all eyes together.
    pub transform: Duration,
    /// Displacement of the drawn picture from the true one, in the channel where it is largest.
    pub certainty: Certainty,
}

/// Fineness with which channels are drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quality {
    /// Formats of the textures that are drawn into.
    pub format: Format,
    /// Samples per pixel, one draw each.
    pub samples: u32,
    /// Texels of flat pictures per pixel of a screen that is not flat, along each axis.
    pub density: f64,
    /// True if these texels are interpolated; else the nearest one is taken.
    pub smooth: bool,
}

/// Channels of a display, ready to be drawn.
pub struct Walls {
    /// Display that the channels belong to.
    pub display: Display,
    quality: Quality,
    pictures: Vec<Picture>,
    passes: display::Display,
    /// Passes as above, for pictures in linear light.
    linear_passes: display::Display,
    /// Combiners of both eyes' pictures, one entry per window.
    combiners: Vec<Option<Combiner>>,
    resample: Pass,
    adaptation: Adaptation,
    /// Test grids that are shown instead of light.
    grids: Option<Grids>,
}

impl Walls {
    /// Creates targets, tables and passes. `screen` is the format in which channels are shown.
    pub fn new(gpu: &Gpu, display: Display, quality: Quality, screen: wgpu::TextureFormat) -> Self {
        let colour = quality.format.colour;
        let passes = display::Display::new(gpu, colour, screen);
        let picture = |channel: &Channel| Picture::new(gpu, &display, channel, &quality, &passes);
        let combiner = |window: &WindowPlace| Combiner::new(gpu, window.combine, window.swap_eyes, screen);
        Self {
            pictures: display.channels.iter().map(picture).collect(),
            combiners: display.windows.iter().map(combiner).collect(),
            linear_passes: display::Display::new(gpu, colour, display::LINEAR_FORMAT),
            resample: display::resample(gpu, colour, quality.smooth),
            adaptation: Adaptation::new(gpu),
            grids: None,
            passes,
            quality,
            display,
        }
    }

    /// Draws the light of every channel as the occupant sees it. While test grids are shown, nothing is drawn.
    ///
    /// # Errors
    /// [`WallsError`]: an eye without a valid place, or a lost device.
    pub fn draw(
        &mut self,
        gpu: &Gpu,
        renderer: &mut SceneRenderer,
        occupant: &Occupant,
        effects: Effects,
    ) -> Result<Drawn, WallsError> {
        if self.grids.is_some() {
            return Ok(Drawn::default());
        }
        // The photo-surfaces of later eyes are computed while the first eye's channels are drawn.
        let mut eyes = Vec::new();
        for side in [Eye::Left, Eye::Right, Eye::Centre] {
            if self.display.channels.iter().any(|channel| channel.eye == side) {
                let eye = occupant.eye(&self.display.viewer, side);
                let vantage = Vantage::new(eye.observer.event.position, eye.observer.celerity.vector())?;
                if renderer.transforms(effects) {
                    renderer.submit(gpu, vantage, eye.observer.event.ct)?;
                }
                eyes.push((side, eye, vantage));
            }
        }

        let mut drawn = Drawn::default();
        let Self { display, quality, passes, resample, .. } = self;
        for (side, eye, vantage) in eyes {
            if renderer.transforms(effects) {
                let transformed = renderer.receive()?;
                drawn.transform += transformed.duration;
                drawn.not_finite += transformed.stats.not_finite();
                renderer.show(gpu, transformed);
            }
            let sitting = Sitting { gpu, display, quality, passes, resample, eye, vantage, effects };
            let of_eye = sitting.display.channels.iter().zip(&mut self.pictures);
            let mut aimed = Vec::new();
            for (channel, picture) in of_eye.filter(|(channel, _)| channel.eye == side) {
                match picture.aim(channel, &sitting) {
                    Ok(shots) => aimed.push((picture, shots)),
                    Err(behind) => drawn.behind.push((channel.name.clone(), behind)),
                }
            }
            // The work that the eye's channels share is done first, then each channel is drawn.
            let all: Vec<_> = aimed.iter().flat_map(|(_, shots)| shots.iter().copied()).collect();
            renderer.prepare_eye(gpu, &all);
            for (picture, shots) in aimed {
                drawn.certainty = drawn.certainty.or_worse(picture.draw(renderer, &shots, &sitting));
            }
        }
        Ok(drawn)
    }

    /// Adapts the viewer to the present light of the channels.
    pub fn adapt(&mut self, gpu: &Gpu, development: &Development, elapsed_s: Option<f64>) {
        if self.grids.is_some() {
            return;
        }
        let seen = |picture: &Picture| (picture.light().clone(), picture.stored);
        let lights: Vec<_> = self.pictures.iter().map(seen).collect();
        let seen: Vec<_> =
            lights.iter().map(|(radiance, stored)| Seen { radiance, stored: *stored, elapsed_s }).collect();
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        self.passes.adapt_to_all(gpu, &mut encoder, &mut self.adaptation, &seen, development);
        gpu.queue.submit([encoder.finish()]);
    }

    /// Shows test grids from now on, with the chosen corner marked.
    pub fn show_grids(&mut self, gpu: &Gpu, calibration: &Calibration) {
        self.grids = Some(Grids::new(gpu, &self.display, &self.passes, calibration));
    }

    /// Moves a channel's corners to their places in `calibration` and redraws the channel's test grid. The channel's
    /// own gains are updated at once; all other tables follow when [light is shown](Self::show_light) again.
    pub fn show_grid(&mut self, gpu: &Gpu, calibration: &Calibration, channel: usize) {
        let Some(grids) = &mut self.grids else { return };
        let warp = calibration.warp(channel);
        let moves = !matches!(self.display.channels[channel].warp, Some(Warp::Grid(_)));
        if moves && self.display.channels[channel].warp != warp {
            self.display.channels[channel].warp = warp;
            grids.moved = true;
            self.pictures[channel].brighten(gpu, &self.display, &self.display.channels[channel]);
        }
        grids.update(gpu, &self.display, calibration, channel);
    }

    /// Shows light again. If corners were moved, tables and gains are rebuilt for all channels, because channels on
    /// one screen affect each other's gains.
    pub fn show_light(&mut self, gpu: &Gpu) {
        if !self.grids.take().is_some_and(|grids| grids.moved) {
            return;
        }
        let Self { display, quality, passes, .. } = &*self;
        let picture = |channel: &Channel| Picture::new(gpu, display, channel, quality, passes);
        self.pictures = display.channels.iter().map(picture).collect();
    }
}
