//! The ride as a pure function: samples and frame times in, observers out.
//!
//! # How it works
//!
//! A [`Simulation`] owns the desk and the vehicle. Every frame hands it the samples that came since the last one and asks where the observer is now. It
//! goes through the ticks that have become due, 240 a second of real time: feeds the desk all samples up to the tick, does what was pressed, and moves the
//! vehicle by a step of own time, which is real time × time scale (B 5.6.1: proper time is the user's time). What is shown is a copy of the vehicle, moved
//! on by the rest of a tick, so that a film is as smooth as its frame times.
//!
//! Nothing else enters: no clock, no thread, no random number. The same [`Setup`], samples and frame times give the same bits, which is what a
//! [`Replay`] proves. The ticks do not depend on how time is cut into frames either, as long as every sample is there by the tick that it precedes, and no frame
//! takes more than a quarter of a second; then the world waits ([`Frame::dropped_ticks`]).

mod replay;
mod setup;
mod ticks;
mod tour;
mod way;

use std::collections::VecDeque;
use std::sync::Arc;

use input::recording::FrameRecord;
use input::{Action, Controls, Desk, Nanos, Sample};

pub use replay::{Replay, ReplayError, Replayed};
pub use setup::{Setup, SetupError, Start};
pub use ticks::TICKS_PER_SECOND;
pub use tour::Tour;

use crate::vehicle::{Eye, Notice, Surroundings, Vehicle, World};
use ticks::Ticks;

/// Own time runs no faster than this many times real time.
pub const FASTEST_TIME_SCALE: f64 = 16.0;

/// A ride in progress.
pub struct Simulation {
    setup: Setup,
    surroundings: Arc<dyn Surroundings>,
    desk: Desk,
    /// Samples not yet due, by time.
    waiting: VecDeque<Sample>,
    ticks: Ticks,
    /// The vehicle as the ride began.
    first: Vehicle,
    vehicle: Vehicle,
    /// Of the last tick.
    controls: Controls,
    paused: bool,
    time_scale: f64,
    frames: u64,
}

/// What a frame shows, and what is recorded of it.
#[derive(Clone, Debug)]
pub struct Frame {
    /// The numbers that a replay has to reproduce to the bit.
    pub record: FrameRecord,
    /// Controls of the last tick, with all actions since the last frame. Those that concern the ride itself have been done.
    pub controls: Controls,
    /// Who looks.
    pub eye: Eye,
    /// The vehicle as it is shown.
    pub vehicle: Vehicle,
    /// Whether the clock stands.
    pub paused: bool,
    /// Own time per real time.
    pub time_scale: f64,
    /// What to tell the rider, each once.
    pub notices: Vec<Notice>,
    /// Ticks that were not simulated, because the frame came late.
    pub dropped_ticks: u64,
}

impl Simulation {
    /// A ride that has not begun.
    ///
    /// # Errors
    /// A setting or the start cannot be used.
    pub fn new(setup: Setup, surroundings: Arc<dyn Surroundings>) -> Result<Self, SetupError> {
        let desk = Desk::new(setup.desk.clone())?;
        let mut vehicle = Vehicle::new(setup.world, setup.kind, setup.start.state()?, setup.vehicle)?;
        vehicle.settle(&*surroundings);
        Ok(Self {
            setup,
            surroundings,
            desk,
            waiting: VecDeque::new(),
            ticks: Ticks::default(),
            first: vehicle.clone(),
            vehicle,
            controls: Controls::default(),
            paused: false,
            time_scale: 1.0,
            frames: 0,
        })
    }

    /// What the ride began with.
    pub fn setup(&self) -> &Setup {
        &self.setup
    }

    /// The desk, for what could not be understood.
    pub fn desk(&self) -> &Desk {
        &self.desk
    }

    /// The vehicle at the last tick.
    pub fn vehicle(&self) -> &Vehicle {
        &self.vehicle
    }

    /// Simulates up to the real time `at`; `samples` are all that have come since the frame before. Those that are dated later than `at` wait.
    pub fn frame(&mut self, at: Nanos, samples: &[Sample]) -> Frame {
        samples.iter().for_each(|sample| self.wait(sample));
        let (ticks, dropped_ticks) = self.ticks.due(at);
        let mut steps = 0;
        let mut actions = Vec::new();
        let mut notices = Vec::new();
        for tick in ticks {
            steps += self.tick(tick, &mut notices);
            actions.append(&mut self.controls.actions);
        }

        let mut shown = self.vehicle.clone();
        if !self.paused {
            shown.step(self.step_s() * self.ticks.fraction(at), &self.controls, &*self.surroundings);
        }
        let record = record(self.frames, at, steps, &shown);
        self.frames += 1;
        Frame {
            record,
            controls: Controls { actions, ..self.controls.clone() },
            eye: shown.eye(),
            vehicle: shown,
            paused: self.paused,
            time_scale: self.time_scale,
            notices,
            dropped_ticks,
        }
    }

    /// Queues a sample by its time, after those of the same time.
    fn wait(&mut self, sample: &Sample) {
        let place = self.waiting.iter().rposition(|earlier| earlier.at <= sample.at).map_or(0, |last| last + 1);
        self.waiting.insert(place, sample.clone());
    }

    /// One tick; says how many steps the vehicle made.
    fn tick(&mut self, at: Nanos, notices: &mut Vec<Notice>) -> u64 {
        while let Some(sample) = self.waiting.pop_front_if(|sample| sample.at <= at) {
            self.desk.feed(&sample);
        }
        self.controls = self.desk.controls(at);
        let mut single_steps = 0;
        for index in 0..self.controls.actions.len() {
            let action = self.controls.actions[index];
            single_steps += u64::from(action == Action::Step);
            self.act(action, notices);
        }
        let steps = if self.paused { single_steps } else { 1 };
        for _ in 0..steps {
            self.vehicle.step(self.step_s(), &self.controls, &*self.surroundings);
            for &notice in self.vehicle.notices() {
                tell(notices, notice);
            }
        }
        steps
    }

    /// Own time per tick, seconds.
    fn step_s(&self) -> f64 {
        self.time_scale / f64::from(TICKS_PER_SECOND)
    }

    /// Does what concerns the ride; the rest is for the program.
    fn act(&mut self, action: Action, notices: &mut Vec<Notice>) {
        match action {
            Action::TogglePause => self.paused = !self.paused,
            Action::TimeScale(scale) => self.time_scale = scale.clamp(0.0, FASTEST_TIME_SCALE),
            Action::ScaleTime(factor) => self.time_scale = (self.time_scale * factor).clamp(0.0, FASTEST_TIME_SCALE),
            Action::SpeedOfLight(speed) => match World::new(speed) {
                Ok(world) => self.vehicle.set_world(world),
                Err(_) => tell(notices, Notice::SpeedOfLightRefused),
            },
            Action::Vehicle(kind) => self.vehicle.set_kind(kind, &*self.surroundings),
            Action::Restart => self.restart(),
            Action::Step | Action::Photo | Action::ToggleRecording | Action::ToggleHelp => {}
        }
    }

    /// Puts the vehicle, of whatever kind it is by now, back to the start.
    fn restart(&mut self) {
        let (world, kind) = (self.vehicle.world(), self.vehicle.kind());
        self.vehicle = self.first.clone();
        self.vehicle.set_world(world);
        self.vehicle.set_kind(kind, &*self.surroundings);
    }
}

fn tell(notices: &mut Vec<Notice>, notice: Notice) {
    if !notices.contains(&notice) {
        notices.push(notice);
    }
}

/// The numbers of a frame.
fn record(frame: u64, at: Nanos, steps: u64, vehicle: &Vehicle) -> FrameRecord {
    let Eye { observer, orientation } = vehicle.eye();
    let celerity = observer.celerity;
    FrameRecord {
        frame,
        at,
        steps,
        proper_time: vehicle.state().proper_time,
        ct: observer.event.ct,
        position: observer.event.position.to_array(),
        celerity: celerity.vector().to_array(),
        orientation: orientation.to_array(),
        rapidity: celerity.rapidity(),
        doppler_ahead: celerity.gamma() + celerity.magnitude(),
        road: vehicle.odometer().road_m,
        odometer: vehicle.odometer().own_m,
    }
}
