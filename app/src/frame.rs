//! One frame, from device to light: the whole program on one page.
//!
//! ```text
//! devices ─► samples ─► controls ─► vehicle: RK4 in proper time ─► worldline ─► observer ─► eye
//!     ─► polygon: photo-surface of the scene (rayon, beside the render thread, into mapped buffers) ─► draw
//!        image: map of the world around the eye ─► bend, pixel by pixel
//!         ─► exposure, tone, gamut, curve of the screen ─► window, or the windows of a room
//! ```

use crate::command::Latency;
use crate::error::Error;
use crate::gpu::Gpu;
use crate::live::{Live, gaze};
use crate::pace::Pace;
use crate::render::shot;
use crate::renderers::certainty::Certainty;
use crate::renderers::display::Stored;
use crate::renderers::target::Radiance;
use crate::renderers::{Effects, SceneRenderer};
use crate::simulation::Frame;
use crate::views::Gaze;
use crate::walls::{Head, Occupant, Walls, tracker};
use crate::window::{Readings, RidePanel};
use glam::DVec2;
use input::{Action, SECOND};
use std::collections::VecDeque;

/// What a frame is drawn on.
pub enum Canvas<'a> {
    /// One flat picture, as the vehicle's driver sees it.
    Picture {
        /// What is drawn into.
        target: &'a Radiance,
        /// Vertical field of view, degrees.
        fov: f64,
    },
    /// The surfaces of a room in the vehicle.
    Room(&'a mut Walls),
}

/// Where a frame goes, and how it is drawn.
pub struct Pictured<'a> {
    /// What is drawn on.
    pub canvas: Canvas<'a>,
    /// What relativity does to the picture.
    pub effects: Effects,
    /// Whether the next photo-surface is worked out while this one is drawn.
    pub latency: Latency,
}

/// A ride and what draws it.
pub struct Ride {
    /// Devices, simulation, log.
    pub live: Live,
    renderer: SceneRenderer,
    /// Whose photo-surfaces are under way, oldest first.
    under_way: VecDeque<Gaze>,
    /// Whose photo-surface is drawn.
    shown: Option<Gaze>,
    /// Vertices that have no place in it.
    not_finite: usize,
    /// That an eye is behind a screen.
    behind: Option<String>,
    /// Whom a room's screens were drawn for last.
    pub occupant: Option<Occupant>,
    /// The newest frame.
    pub frame: Option<Frame>,
    /// How far from their places things are drawn in it.
    certainty: Certainty,
    /// How the target holds the light of what was drawn last.
    pub stored: Stored,
    /// Time that the eye had to adapt since the frame before, seconds; `None` at first.
    pub elapsed_s: Option<f64>,
    /// How long each stage takes.
    pub pace: Pace,
}

impl Ride {
    /// A ride that is about to begin.
    pub fn new(renderer: SceneRenderer, live: Live) -> Self {
        Self {
            live,
            renderer,
            under_way: VecDeque::new(),
            shown: None,
            not_finite: 0,
            behind: None,
            occupant: None,
            frame: None,
            certainty: Certainty::default(),
            stored: Stored::UNSHIFTED,
            elapsed_s: None,
            pace: Pace::default(),
        }
    }

    /// Advances the ride to this moment and draws it. Returns what the rider wants of the program, `None` at the end.
    ///
    /// # Errors
    /// A lost device, or a recording that cannot be replayed.
    pub fn frame(&mut self, gpu: &Gpu, pictured: Pictured<'_>) -> Result<Option<Vec<Action>>, Error> {
        self.pace.begin();

        // Devices to observer: samples, controls, vehicle, worldline.
        let Some(frame) = self.live.frame()? else { return Ok(None) };
        let newest = gaze(&frame)?;
        let actions = frame.controls.actions.clone();
        self.elapsed_s = self.frame.as_ref().map(|before| elapsed_s(before, &frame));
        let vehicle = *frame.vehicle.state();
        let light = frame.vehicle.world().speed_of_light_m_s();
        let head = frame.controls.head.as_ref().map(|state| tracker::head(state, light));
        self.frame = Some(frame);
        self.pace.stage("ride");
        let (target, fov) = match pictured.canvas {
            Canvas::Picture { target, fov } => (target, fov),
            Canvas::Room(walls) => {
                let head = head.unwrap_or(Head::at_rest(walls.display.viewer.head_m));
                self.surround(gpu, walls, &Occupant { vehicle, head }, pictured.effects)?;
                return Ok(Some(actions));
            }
        };

        // The photo-surface of the newest eye, on its own thread; shown is the oldest one that is ready by now.
        if self.renderer.transforms(pictured.effects) {
            self.renderer.submit(gpu, newest.eye, newest.ct)?;
            self.under_way.push_back(newest);
            let ahead = usize::from(pictured.latency == Latency::Overlap);
            while self.under_way.len() > ahead || self.shown.is_none() {
                let transformed = self.renderer.receive()?;
                self.pace.transformed(transformed.duration);
                self.not_finite = transformed.stats.not_finite();
                self.renderer.show(gpu, transformed);
                self.shown = self.under_way.pop_front();
            }
        } else {
            self.shown = None;
            self.not_finite = 0;
            for _ in self.under_way.drain(..) {
                self.renderer.discard()?;
            }
        }
        let shown = self.shown.unwrap_or(newest);
        self.pace.stage("wait");

        // Draw it.
        let shot = shot(&shown, fov, pictured.effects);
        self.renderer.prepare(gpu, &shot, target.size);
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        self.renderer.draw(gpu, &mut encoder, target, &shot, DVec2::ZERO);
        gpu.queue.submit([encoder.finish()]);
        self.stored = self.renderer.stored(&shot);
        self.certainty = self.renderer.certainty(&shot, target.size);
        self.pace.stage("draw");
        Ok(Some(actions))
    }

    /// Draws every channel of a room, each eye's photo-surface beside the drawing of the one before.
    fn surround(&mut self, gpu: &Gpu, walls: &mut Walls, occupant: &Occupant, effects: Effects) -> Result<(), Error> {
        let drawn = walls.draw(gpu, &mut self.renderer, occupant, effects)?;
        self.pace.transformed(drawn.transform);
        self.not_finite = drawn.not_finite;
        self.certainty = drawn.certainty;
        self.occupant = Some(*occupant);
        self.behind = drawn.behind.first().map(|(channel, behind)| format!("{channel} is black: {behind}"));
        self.pace.stage("draw");
        Ok(())
    }

    /// What the display at the edges shows.
    pub fn readings(&self) -> Readings {
        let Some(frame) = &self.frame else { return Readings::default() };
        let celerity = frame.eye.observer.celerity;
        let world = frame.vehicle.world();
        let mut notices = self.live.told();
        if self.not_finite > 0 {
            notices.push(format!("{} vertices are nowhere and not drawn", self.not_finite));
        }
        notices.extend(self.behind.clone());
        notices.extend(self.certainty.notice());
        if frame.time_scale != 1.0 {
            notices.push(format!("own time × {:.2}", frame.time_scale));
        }
        Readings {
            beta: celerity.beta().vector().length(),
            gamma: celerity.gamma(),
            rapidity: celerity.rapidity(),
            speed_of_light: world.speed_of_light_m_s(),
            own_clock_s: frame.vehicle.odometer().own_s,
            world_clock_s: frame.vehicle.odometer().world_s,
            road_m: frame.vehicle.odometer().road_m,
            own_m: frame.vehicle.odometer().own_m,
            frame_rate: self.pace.frame_rate(),
            stages_ms: self.pace.stages_ms(),
            certainty: self.certainty.reading(),
            notices,
            paused: frame.paused,
            recording: self.live.is_recording(),
        }
    }

    /// What the settings panel shows of the ride.
    pub fn panel(&self, gpu: &Gpu) -> RidePanel {
        let vehicle = self.frame.as_ref().map(|frame| &frame.vehicle);
        RidePanel {
            vehicle: vehicle.map_or_else(Default::default, |vehicle| vehicle.kind()),
            time_scale: self.frame.as_ref().map_or(1.0, |frame| frame.time_scale),
            speed_of_light: vehicle.map_or(1.0, |vehicle| vehicle.world().speed_of_light_m_s()),
            devices: self.live.devices(),
            drawing: format!(
                "{} triangles by the {} renderer on {}",
                self.renderer.triangle_count(),
                self.renderer.name(),
                gpu.description()
            ),
        }
    }
}

/// Time in which an eye adapts: the rider's own, or, while his clock stands, that of whoever looks on.
fn elapsed_s(before: &Frame, now: &Frame) -> f64 {
    if now.paused {
        now.record.at.saturating_sub(before.record.at) as f64 / SECOND as f64
    } else {
        now.vehicle.odometer().own_s - before.vehicle.odometer().own_s
    }
}
