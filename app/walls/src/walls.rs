//! Channels of a display, drawn and shown together.

use crate::calibration::Calibration;
use crate::combine::Combiner;
use crate::enlarged_light::LightEnlarger;
use crate::head::{Occupant, OccupantEye};
use crate::picture::{ChannelPicture, EyeContext};
use crate::picture_shares::PictureShares;
use crate::quality::Quality;
use crate::room_rest::RoomRest;
use crate::room_sheet::RoomSheet;
use crate::scene_depth::SceneDepth;
use crate::sheet_passes::SheetPasses;
use crate::test_grid::TestGrids;
use crate::veil::{Veil, VeilPasses};
use render::certainty::Certainty;
use render::display::{Adaptation, Developer, Development, LINEAR_FORMAT, Pass, Seen, resample};
use render::{Gpu, GpuError, Pending, SceneRenderer};
use room::{Channel, Display, EyeBehind, EyeSide, HeadsetEye, Warp, WindowPlace};
use std::time::Duration;
use view::Effects;

/// Outcome of drawing the channels.
#[derive(Clone, Debug, Default)]
pub struct DrawnChannels {
    /// Channels that stay black because their eye is behind their screen: the channel's name, and the eye's place.
    pub behind: Vec<(String, EyeBehind)>,
    /// Number of vertices that have no place in the photo-surfaces.
    pub not_finite: usize,
    /// Time that the photo-surfaces took, all eyes together.
    pub transform: Duration,
    /// Displacement of the drawn picture from the true one, in the channel where it is largest.
    pub certainty: Certainty,
}

/// Photo-surfaces of an occupant's eyes under way, for one picture of the room.
#[must_use = "a room that is not drawn was worked out in vain"]
pub struct SubmittedRoom {
    /// Occupant that looks.
    pub occupant: Occupant,
    pub(crate) effects: Effects,
    pub(crate) eyes: Vec<SubmittedEye>,
}

/// Photo-surface of one eye under way.
pub(crate) struct SubmittedEye {
    side: EyeSide,
    pub(crate) eye: OccupantEye,
    pending: Pending,
}

impl SubmittedRoom {
    /// True if a photo-surface is under way, false if the method needs none.
    pub fn is_under_way(&self) -> bool {
        self.eyes.iter().any(|eye| eye.pending.is_under_way())
    }
}

/// Channels of a display, ready to be drawn.
pub struct Walls {
    /// Display that the channels belong to.
    pub display: Display,
    pub(crate) quality: Quality,
    pub(crate) pictures: Vec<ChannelPicture>,
    /// Format of the screens.
    pub(crate) screen: wgpu::TextureFormat,
    /// Passes that develop pictures for the screens.
    pub(crate) passes: Developer,
    /// Passes that develop pictures into linear light.
    pub(crate) linear_passes: Developer,
    /// Combiners of both eyes' pictures, one entry per window.
    pub(crate) combiners: Vec<Option<Combiner>>,
    pub(crate) resample: Pass,
    /// Pass that enlarges the channels' light; `None` if it is always drawn to the full.
    pub(crate) enlarger: Option<LightEnlarger>,
    /// Shares of the channels' width and height that are drawn, and the one drawn last.
    pub(crate) shares: PictureShares,
    pub(crate) share: f64,
    /// Room that was drawn last: its occupant, and its eyes' rest.
    pub(crate) shown: Option<(Occupant, Effects)>,
    pub(crate) rest: Option<RoomRest>,
    pub(crate) rests: bool,
    pub(crate) adaptation: Adaptation,
    /// Eyes of the headset whose display this is: its screens are put before them for each picture.
    pub headset: Option<Vec<HeadsetEye>>,
    /// Pass that hands the depth of pictures on, once it has been asked for.
    pub(crate) scene_depth: Option<SceneDepth>,
    /// Sheets that float in the room, the undermost first.
    pub sheets: Vec<RoomSheet>,
    pub(crate) sheet_passes: SheetPasses,
    /// Veil over the light of flat screens, under the sheets.
    pub vignette: Veil,
    /// Veil over all that flat screens show, the sheets as well.
    pub fade: Veil,
    pub(crate) veil_passes: VeilPasses,
    /// Test grids that are shown instead of light.
    pub(crate) grids: Option<TestGrids>,
}

impl Walls {
    /// Creates targets, tables and passes. `screen` is the format in which channels are shown.
    pub fn new(gpu: &Gpu, display: Display, quality: Quality, screen: wgpu::TextureFormat) -> Self {
        let colour = quality.format.colour;
        let passes = Developer::new(gpu, colour, screen);
        let picture = |channel: &Channel| ChannelPicture::new(gpu, &display, channel, &quality, &passes);
        let combiner = |window: &WindowPlace| Combiner::new(gpu, window.combine, window.swap_eyes, screen);
        Self {
            pictures: display.channels.iter().map(picture).collect(),
            combiners: display.windows.iter().map(combiner).collect(),
            linear_passes: Developer::new(gpu, colour, LINEAR_FORMAT),
            resample: resample(gpu, colour, quality.smooth),
            enlarger: (!quality.format.is_exact()).then(|| LightEnlarger::new(gpu, colour)).flatten(),
            shares: PictureShares::default(),
            share: 1.0,
            shown: None,
            rest: None,
            rests: false,
            adaptation: Adaptation::new(gpu),
            headset: None,
            scene_depth: None,
            sheets: Vec::new(),
            sheet_passes: SheetPasses::default(),
            vignette: Veil::NONE,
            fade: Veil::NONE,
            veil_passes: VeilPasses::default(),
            grids: None,
            screen,
            passes,
            quality,
            display,
        }
    }

    /// Format of the screens.
    pub fn format(&self) -> wgpu::TextureFormat {
        self.screen
    }

    /// Begins anew, as if nothing had been drawn: the next frame is not at rest.
    pub fn begin_anew(&mut self) {
        (self.shown, self.rest, self.rests) = (None, None, false);
    }

    /// Begins the photo-surfaces of an occupant's eyes, beside whatever is drawn meanwhile.
    ///
    /// # Errors
    /// [`GpuError::Lost`] if the device went away.
    pub fn submit(
        &self,
        gpu: &Gpu,
        renderer: &mut SceneRenderer,
        occupant: &Occupant,
        effects: Effects,
    ) -> Result<SubmittedRoom, GpuError> {
        let mut eyes = Vec::new();
        for side in [EyeSide::Left, EyeSide::Right, EyeSide::Centre] {
            if self.display.channels.iter().any(|channel| channel.eye == side) {
                let eye = occupant.eye(&self.display.viewer, side);
                let pending = renderer.submit(gpu, &eye.observer, effects)?;
                eyes.push(SubmittedEye { side, eye, pending });
            }
        }
        Ok(SubmittedRoom { occupant: *occupant, effects, eyes })
    }

    /// Draws the light of every channel; nothing while the channels show test grids.
    ///
    /// # Errors
    /// [`GpuError::Lost`] if the device went away.
    pub fn draw(
        &mut self,
        gpu: &Gpu,
        renderer: &mut SceneRenderer,
        submitted: SubmittedRoom,
    ) -> Result<DrawnChannels, GpuError> {
        let mut drawn = DrawnChannels::default();
        if self.grids.is_some() {
            return Ok(drawn);
        }
        if let Some(eyes) = &self.headset {
            self.display.follow_head(eyes, submitted.occupant.head.place_m);
        }
        self.fit(gpu, renderer, &submitted);
        let SubmittedRoom { effects, eyes, .. } = submitted;
        let Self { display, quality, passes, resample, enlarger, .. } = self;
        let enlarger = enlarger.as_ref();
        for SubmittedEye { side, eye, pending } in eyes {
            let transformed = renderer.show(gpu, pending)?;
            drawn.transform += transformed.duration;
            drawn.not_finite += transformed.not_finite;
            let stored_scale = None;
            let context = EyeContext { gpu, quality, passes, enlarger, resample, eye, effects, stored_scale };
            let of_eye = display.channels.iter().zip(&mut self.pictures);
            let mut aimed = Vec::new();
            for (channel, picture) in of_eye.filter(|(channel, _)| channel.eye == side) {
                match picture.aim(channel.flat(display).as_ref(), renderer, &context) {
                    Ok(shots) => aimed.push((picture, shots)),
                    Err(behind) => drawn.behind.push((channel.name.clone(), behind)),
                }
            }
            // The work that the eye's channels share is done first, then each channel is drawn.
            let all: Vec<_> = aimed.iter().flat_map(|(_, shots)| shots.iter().copied()).collect();
            renderer.prepare_eye(gpu, &all);
            for (picture, shots) in aimed {
                drawn.certainty = drawn.certainty.or_worse(picture.draw(renderer, &shots, &context));
            }
        }
        Ok(drawn)
    }

    /// Adapts the viewer to the present light of the channels.
    pub fn adapt(&mut self, gpu: &Gpu, development: &Development, elapsed_s: Option<f64>) {
        if self.grids.is_some() {
            return;
        }
        let seen = |picture: &ChannelPicture| (picture.light().clone(), picture.stored);
        let lights: Vec<_> = self.pictures.iter().map(seen).collect();
        let seen: Vec<_> =
            lights.iter().map(|(radiance, stored)| Seen { radiance, stored: *stored, elapsed_s }).collect();
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        self.passes.adapt_to_all(gpu, &mut encoder, &mut self.adaptation, &seen, development);
        gpu.queue.submit([encoder.finish()]);
    }

    /// Shows test grids from now on, with the chosen corner marked.
    pub fn show_grids(&mut self, gpu: &Gpu, calibration: &Calibration) {
        self.grids = Some(TestGrids::new(gpu, &self.display, &self.passes, calibration));
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
            self.pictures[channel].update_gains(gpu, &self.display, &self.display.channels[channel]);
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
        let picture = |channel: &Channel| ChannelPicture::new(gpu, display, channel, quality, passes);
        self.pictures = display.channels.iter().map(picture).collect();
    }
}
