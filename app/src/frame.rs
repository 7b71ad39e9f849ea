//! One frame, from device to light: the whole program on one page.
//!
//! ```text
//! devices ─► samples ─► controls ─► vehicle: RK4 in proper time ─► worldline ─► observer ─► eyes
//!     ─► polygon: photo-surface of the scene (rayon, beside the render thread, into mapped buffers) ─► draw
//!        image: map of the world around the eye ─► bend, pixel by pixel
//!         ─► exposure, tone, gamut, curve of the screen ─► window, or the windows of a room
//! ```

use crate::canvas::{Canvas, Submitted, Watcher};
use crate::error::Error;
use crate::session::live::Live;
use crate::session::tracker;
use crate::stage_times::StageTimes;
use filming::OutsideLook;
use glam::DVec3;
use input::{Action, HeadState, SECOND};
use presentation::{Latency, Presentation};
use render::certainty::Certainty;
use render::{Gpu, SceneRenderer};
use ride::RideFrame;
use room::EyeBehind;
use std::collections::VecDeque;
use std::time::{Duration, Instant};
use walls::{Drawing, Governor, PictureShares};
use words::Phrase;

/// Time that a frame may take at rest: less than the quarter of a second after which own time is not ridden.
const STILL: Duration = Duration::from_millis(120);
/// Time of a room's frame at rest after which rest is given up.
const LONGEST_STILL: Duration = Duration::from_millis(225);

/// A ride, and the renderer that draws it.
pub struct RideInProgress {
    /// Devices, simulation, log.
    pub live: Live,
    /// Renderer of the scene.
    pub renderer: SceneRenderer,
    /// Frames submitted and not yet drawn, oldest first.
    under_way: VecDeque<Submitted>,
    /// True if photo-surfaces are computed beside the drawing, so that frames may overlap.
    pub overlaps: bool,
    /// View from outside.
    pub outside: OutsideLook,
    /// Head of somebody who watches a recorded ride in a headset, and looks round in it.
    pub viewer: Option<HeadState>,
    /// Newest frame of the ride.
    pub frame: Option<RideFrame>,
    /// Vertices without a finite apparent position in the picture drawn last.
    pub not_finite: usize,
    /// Channel whose eye is behind its screen.
    pub behind: Option<(String, EyeBehind)>,
    /// Errors of directions in the picture drawn last.
    pub certainty: Certainty,
    /// Times of the stages of a frame.
    pub times: StageTimes,
    /// Governor of the windows' resolution; `None` if every pixel is drawn however long it takes.
    governor: Option<Governor>,
    /// Time at which the frame before was drawn, and the way.
    drawn_before: Option<(Instant, Drawing)>,
    /// True if a room at rest took too long: it is drawn as in motion from then on.
    coarse_rest: bool,
    /// Share of the windows' width and height that is drawn.
    pub share: f64,
}

impl RideInProgress {
    /// A ride that is about to begin.
    pub fn new(renderer: SceneRenderer, live: Live, governor: Option<Governor>) -> Self {
        Self {
            live,
            renderer,
            under_way: VecDeque::new(),
            overlaps: false,
            outside: OutsideLook::default(),
            viewer: None,
            frame: None,
            not_finite: 0,
            behind: None,
            certainty: Certainty::default(),
            times: StageTimes::default(),
            governor,
            drawn_before: None,
            coarse_rest: false,
            share: 1.0,
        }
    }

    /// Draws by another renderer of the same scene from now on.
    pub fn draw_by(&mut self, renderer: SceneRenderer) {
        // What is under way was begun by the renderer before.
        self.under_way.clear();
        self.renderer = renderer;
    }

    /// Advances the ride to this moment and draws its light. Returns the rider's actions that concern the program,
    /// `None` at the end.
    ///
    /// # Errors
    /// A lost device, or a recording that cannot be replayed.
    pub fn frame(
        &mut self,
        gpu: &Gpu,
        canvas: &mut Canvas,
        shown: &Presentation,
    ) -> Result<Option<Vec<Action>>, Error> {
        self.times.begin();

        // Devices to observer: samples, controls, vehicle, worldline, head.
        let Some(frame) = self.live.frame()? else { return Ok(None) };
        let light_speed = frame.vehicle.light_speed().speed_of_light_m_s();
        let head = self.viewer.as_ref().or(frame.controls.head.as_ref());
        let head = head.map(|state| tracker::head(&held(state, frame.paused), light_speed));
        let (gaze, outside) = self.outside.follow(&frame.gaze, shown);
        let watcher = Watcher {
            gaze,
            vehicle: *frame.vehicle.state(),
            thrust: *frame.vehicle.thrust(),
            head,
            look: frame.controls.look,
            outside,
        };
        let elapsed_s = self.frame.as_ref().map(|before| elapsed_s(before, &frame));
        let actions = frame.controls.actions.clone();
        self.frame = Some(frame);
        self.times.stage(Phrase::StageRide);

        // Observer to photo-surfaces, on their own thread. The frame shown is this one, or with overlap the one
        // before it.
        let newest = canvas.submit(gpu, &mut self.renderer, &watcher, shown.effects, shown.fov_deg)?;
        self.overlaps = newest.is_under_way();
        let ahead = usize::from(shown.latency == Latency::Overlap && self.overlaps);
        self.under_way.push_back(newest);
        self.under_way.drain(..self.under_way.len().saturating_sub(1 + ahead));
        while self.under_way.len() <= ahead {
            let again = canvas.submit(gpu, &mut self.renderer, &watcher, shown.effects, shown.fov_deg)?;
            self.under_way.push_back(again);
        }
        let oldest = self.under_way.pop_front().expect("this frame was pushed");
        self.times.stage(Phrase::StageSubmit);

        // Photo-surfaces to light.
        let drawn = canvas.draw(gpu, &mut self.renderer, oldest)?;
        self.times.transformed(drawn.transform);
        self.not_finite = drawn.not_finite;
        self.certainty = drawn.certainty;
        self.behind = drawn.behind.into_iter().next();
        self.times.stage(Phrase::StageDraw);
        self.govern(canvas);

        // The viewer adapts to it. Windows show it: window/show.rs.
        canvas.adapt(gpu, &shown.development, elapsed_s);
        Ok(Some(actions))
    }
}

impl RideInProgress {
    /// Begins with a resolution by the time that a frame with every pixel took which nobody saw.
    pub fn begin(&mut self, canvas: &mut Canvas, took: Duration) {
        if let Some(governor) = &mut self.governor {
            governor.begin(took);
            canvas.set_shares(shares(governor, false));
        }
    }

    /// Holds the rate of a screen that has one of its own, unless every pixel is drawn.
    pub fn hold_rate(&mut self, frame_rate: f64) {
        /// Difference of two rates that are one.
        const SAME: f64 = 0.01;
        if let Some(governor) = &mut self.governor
            && (governor.frame_rate() / frame_rate - 1.0).abs() > SAME
        {
            *governor = Governor::new(frame_rate);
        }
    }

    /// Sets the resolution of the next frame, so that the frame rate is held. Pictures at rest take the time that they
    /// need.
    fn govern(&mut self, canvas: &mut Canvas) {
        self.share = canvas.share();
        let Some(governor) = &mut self.governor else { return };
        let (now, drawing) = (Instant::now(), canvas.drawing());
        let before = self.drawn_before.replace((now, drawing));
        // The time between two frames of a kind is that of the second.
        let Some((before, _)) = before.filter(|(_, before)| *before == drawing) else { return };
        if drawing == Drawing::Moving {
            governor.frame(now - before);
        } else if !matches!(canvas, Canvas::Picture(_)) && now - before > LONGEST_STILL {
            // A room is drawn again and again at rest, and own time must not be lost in it.
            self.coarse_rest = true;
        } else {
            return;
        }
        canvas.set_shares(shares(governor, self.coarse_rest));
    }
}

/// Head of a rider who walks about while the simulation is held: no time passes, so wherever it is, it is at rest.
fn held(state: &HeadState, paused: bool) -> HeadState {
    let rests = HeadState { velocity_m_s: DVec3::ZERO, turn_rad_s: DVec3::ZERO, ..*state };
    if paused { rests } else { *state }
}

/// Shares of the pictures' width and height that are drawn. `coarse_rest`: at rest no more than in motion.
fn shares(governor: &Governor, coarse_rest: bool) -> PictureShares {
    let moving = governor.share();
    PictureShares { moving, resting: if coarse_rest { moving } else { governor.share_within(STILL) } }
}

/// Time in which an eye adapts, seconds: the rider's own, or real time while the ride is paused.
fn elapsed_s(before: &RideFrame, now: &RideFrame) -> f64 {
    if now.paused {
        now.record.at.saturating_sub(before.record.at) as f64 / SECOND as f64
    } else {
        now.vehicle.odometer().own_s - before.vehicle.odometer().own_s
    }
}
