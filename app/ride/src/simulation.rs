//! The ride as a pure function: samples and frame times in, observers out.
//!
//! # How it works
//!
//! A [`Simulation`] owns the desk and the vehicle. Every frame hands it the samples that have come since the frame
//! before, and asks for the present observer. It works through the ticks that have become due, 240 per second of real
//! time. In each it feeds the desk all samples up to the tick, performs the actions that were pressed, and moves the
//! vehicle by a step of own time. Real time × time scale is the own time of the user, who is the observer (B 5.6.1,
//! W 6.3): of the vehicle as long as no head is tracked in it, else of the head. While a tracked head moves in the
//! vehicle, the vehicle's clock runs γ times as fast as the user's, of which both the head's tracked velocity and the
//! vehicle's steps are taken ([`Vehicle::time_ratio`](crate::Vehicle::time_ratio)). A frame
//! shows a copy of the vehicle, moved on by the rest of a tick, so a film is as smooth as its frame times.
//!
//! The rider may look round ([`Controls::look`]): that turns the frame's gaze and nothing else, so the worldline and
//! the recorded numbers are those of a rider who looks along the nose.
//!
//! A film needs the ride at the times of its pictures, which lie between the frames. Whoever takes them
//! ([`FrameTaker`]) is handed such frames on the way to the next one ([`Simulation::frame_for`]): each is made of the
//! ticks due by then and of the rest of a tick on a copy, as a frame of that time would have been. Head and look, which
//! change by leaps from report to report, glide there ([`BetweenReports`]).
//!
//! Nothing else enters: no clock, no thread, no random number. The same [`Setup`], samples and frame times give the
//! same bits, and a [`Replay`](crate::Replay) proves it. The ticks do not depend on the frame times either, as long as
//! every sample is there by the tick that it precedes, and no frame takes more than a quarter of a second. After a
//! longer frame the world waits ([`RideFrame::dropped_ticks`]).

use std::collections::BTreeMap;
use std::sync::Arc;

use glam::{DQuat, DVec3};
use input::recording::FrameRecord;
use input::{Action, Controls, Desk, HeadState, Nanos, Place, Sample};
use scene::Surroundings;
use view::Gaze;

use crate::assist::{Assist, AssistMode};
use crate::between_reports::BetweenReports;
use crate::frame::RideFrame;
use crate::setup::{Setup, SetupError};
use crate::taker::FrameTaker;
use crate::ticks::{TICKS_PER_SECOND, Ticks};
use crate::vehicle::{LightSpeed, Notice, Vehicle};

/// Largest ratio of own time to real time.
pub const FASTEST_TIME_SCALE: f64 = 16.0;

/// A ride in progress.
pub struct Simulation {
    setup: Setup,
    surroundings: Arc<dyn Surroundings>,
    desk: Desk,
    /// Samples that are not yet due, by their times; those of one time by their numbers, as they came.
    waiting: BTreeMap<(Nanos, u64), Sample>,
    /// Number of samples that came so far.
    arrived: u64,
    ticks: Ticks,
    /// Vehicle at the beginning of the ride.
    first: Vehicle,
    vehicle: Vehicle,
    /// Controls of the last tick.
    controls: Controls,
    /// Assisted steering, if the setup has any.
    assist: Option<Assist>,
    /// Controls of the vehicle in the last step: the rider's, or what the assist made of them.
    steered: Controls,
    paused: bool,
    time_scale: f64,
    frames: u64,
    /// Head and look as they are shown between two frames. They decide nothing.
    head: Option<BetweenReports<HeadState>>,
    look: Option<BetweenReports<DQuat>>,
}

/// What has happened since the last frame.
#[derive(Clone, Debug, Default)]
struct SinceFrame {
    steps: u64,
    actions: Vec<Action>,
    notices: Vec<Notice>,
    dropped_ticks: u64,
}

impl Simulation {
    /// Creates a ride that has not begun.
    ///
    /// # Errors
    /// [`SetupError`] if a setting or the start cannot be used.
    pub fn new(setup: Setup, surroundings: Arc<dyn Surroundings>) -> Result<Self, SetupError> {
        let desk = Desk::new(setup.desk.clone())?;
        let mut vehicle = Vehicle::new(setup.light_speed, setup.kind, setup.start.state()?, setup.vehicle)?;
        vehicle.settle(&*surroundings);
        let assisted = setup.vehicle.assist != AssistMode::Off;
        let assist = assisted.then(|| Assist::new(surroundings.circuit()));
        Ok(Self {
            setup,
            surroundings,
            desk,
            waiting: BTreeMap::new(),
            arrived: 0,
            ticks: Ticks::default(),
            first: vehicle.clone(),
            vehicle,
            controls: Controls::default(),
            assist,
            steered: Controls::default(),
            paused: false,
            time_scale: 1.0,
            frames: 0,
            head: None,
            look: None,
        })
    }

    /// Setup with which the ride began.
    pub fn setup(&self) -> &Setup {
        &self.setup
    }

    /// Desk, for reports on input that could not be understood.
    pub fn desk(&self) -> &Desk {
        &self.desk
    }

    /// Vehicle at the last tick.
    pub fn vehicle(&self) -> &Vehicle {
        &self.vehicle
    }

    /// True while the ride is held.
    pub fn is_paused(&self) -> bool {
        self.paused
    }

    /// Proper time per real time.
    pub fn time_scale(&self) -> f64 {
        self.time_scale
    }

    /// Simulates up to the real time `at`. `samples` are all samples since the frame before; those dated later than
    /// `at` wait.
    pub fn frame(&mut self, at: Nanos, samples: &[Sample]) -> RideFrame {
        self.frame_for(at, samples, None)
    }

    /// Frame of [`Simulation::frame`], to the bit, and on the way to it those that `taker` wants.
    pub fn frame_for(&mut self, at: Nanos, samples: &[Sample], mut taker: Option<&mut dyn FrameTaker>) -> RideFrame {
        samples.iter().for_each(|sample| self.wait(sample));
        let wanted = taker.as_mut().map_or_else(Vec::new, |taker| taker.wanted(at));
        let mut wanted = wanted.into_iter().peekable();
        let mut newest = self.ticks.last();
        let (ticks, dropped_ticks) = self.ticks.due(at);
        let mut since = SinceFrame { dropped_ticks, ..SinceFrame::default() };
        for tick in ticks {
            while let Some(between) = wanted.next_if(|between| *between < tick) {
                if let Some(taker) = &mut taker {
                    taker.take(self.between(between, newest, &since));
                }
            }
            since.steps += self.tick(tick, &mut since.notices);
            since.actions.append(&mut self.controls.actions);
            newest = tick;
        }
        if let Some(taker) = &mut taker {
            wanted.for_each(|between| taker.take(self.between(between.min(at), newest, &since)));
        }
        let frame = self.shown(at, newest, since);
        self.frames += 1;
        frame
    }

    /// Frame at the time `at`, not before the newest tick, as it is shown.
    fn shown(&self, at: Nanos, newest: Nanos, since: SinceFrame) -> RideFrame {
        let mut shown = self.vehicle.clone();
        if !self.paused {
            shown.step(self.own_s() * Ticks::fraction(newest, at), &self.steered, &*self.surroundings);
        }
        let SinceFrame { steps, actions, notices, dropped_ticks } = since;
        RideFrame {
            record: record(self.frames, at, steps, &shown),
            controls: Controls { actions, ..self.controls.clone() },
            gaze: turned(shown.gaze(), self.controls.look.nose_from_gaze()),
            vehicle: shown,
            paused: self.paused,
            time_scale: self.time_scale,
            notices,
            dropped_ticks,
        }
    }

    /// Frame between two others, in which head and look glide.
    fn between(&self, at: Nanos, newest: Nanos, since: &SinceFrame) -> RideFrame {
        let mut frame = self.shown(at, newest, since.clone());
        if let (Some(head), Some(state)) = (&self.head, &mut frame.controls.head) {
            *state = head.at(at);
        }
        if let Some(look) = &self.look {
            frame.gaze = turned(frame.vehicle.gaze(), look.at(at));
        }
        frame
    }

    /// Queues a sample by its time, after those of the same time.
    fn wait(&mut self, sample: &Sample) {
        self.waiting.insert((sample.at, self.arrived), sample.clone());
        self.arrived += 1;
    }

    /// Simulates one tick. Returns the number of steps that the vehicle made.
    fn tick(&mut self, at: Nanos, notices: &mut Vec<Notice>) -> u64 {
        while let Some(first) = self.waiting.first_entry().filter(|first| first.key().0 <= at) {
            self.desk.feed(&first.remove());
        }
        self.desk.ride(self.vehicle.kind());
        self.controls = self.desk.controls(at);
        self.head = self.controls.head.map(|head| BetweenReports::on(self.head.take(), at, head));
        self.look = Some(BetweenReports::on(self.look.take(), at, self.controls.look.nose_from_gaze()));
        let mut single_steps = 0;
        for index in 0..self.controls.actions.len() {
            let action = self.controls.actions[index].clone();
            single_steps += u64::from(action == Action::Step);
            self.act(action, notices);
        }
        let steps = if self.paused { single_steps } else { 1 };
        self.steered = self.controls.clone();
        for _ in 0..steps {
            self.steer();
            self.vehicle.step(self.own_s(), &self.steered, &*self.surroundings);
            for &notice in self.vehicle.notices() {
                tell(notices, notice);
            }
        }
        steps
    }

    /// Lets the assist steer for the next step, if it is to.
    fn steer(&mut self) {
        let wanted = self.setup.vehicle.assist == AssistMode::On || !self.desk.is_steered_by_hand();
        let own_s = self.own_s();
        if let Some(assist) = self.assist.as_mut().filter(|_| wanted) {
            self.steered = assist.steered(&self.controls, &self.vehicle, &*self.surroundings, own_s);
        }
    }

    /// Own time of the vehicle per tick, seconds.
    fn own_s(&self) -> f64 {
        let of_user_s = self.time_scale / f64::from(TICKS_PER_SECOND);
        match (&self.controls.head, &self.setup.desk.head) {
            (Some(head), Some(config)) if config.counts_turn_and_clock() => of_user_s * self.vehicle.time_ratio(head),
            _ => of_user_s,
        }
    }

    /// Performs an action that concerns the ride; other actions are left to the program.
    fn act(&mut self, action: Action, notices: &mut Vec<Notice>) {
        match action {
            Action::TogglePause => self.paused = !self.paused,
            Action::Hold(hold) => self.paused = hold,
            Action::TimeScale(scale) => self.time_scale = scale.clamp(0.0, FASTEST_TIME_SCALE),
            Action::ScaleTime(factor) => self.time_scale = (self.time_scale * factor).clamp(0.0, FASTEST_TIME_SCALE),
            Action::SpeedOfLight(speed) => match LightSpeed::new(speed) {
                Ok(light_speed) => self.vehicle.set_light_speed(light_speed),
                Err(_) => tell(notices, Notice::SpeedOfLightRefused),
            },
            Action::Vehicle(kind) => self.vehicle.set_kind(kind, &*self.surroundings),
            Action::Restart => self.restart(),
            Action::Jump(place) => self.jump(&place),
            // The desk turns look and head; the program shows, photographs, records and leaves.
            _ => {}
        }
    }

    /// Puts the vehicle at rest at a place. Clocks and odometers run on; its kind and the speed of light stay.
    fn jump(&mut self, place: &Place) {
        let [position, look] = [place.position_m, place.look].map(DVec3::from_array);
        if let Some(assist) = &mut self.assist {
            assist.restart();
        }
        self.vehicle.jump(position, look, &*self.surroundings);
    }

    /// Puts the vehicle back to the start. Its kind and the speed of light stay as they are.
    fn restart(&mut self) {
        if let Some(assist) = &mut self.assist {
            assist.restart();
        }
        let (light_speed, kind) = (self.vehicle.light_speed(), self.vehicle.kind());
        self.vehicle = self.first.clone();
        self.vehicle.set_light_speed(light_speed);
        self.vehicle.set_kind(kind, &*self.surroundings);
    }
}

/// Gaze of a rider who looks round: another direction of view from the same eye.
fn turned(gaze: Gaze, nose_from_gaze: DQuat) -> Gaze {
    if nose_from_gaze == DQuat::IDENTITY {
        return gaze;
    }
    Gaze { observer_from_eye: gaze.observer_from_eye * nose_from_gaze, ..gaze }
}

fn tell(notices: &mut Vec<Notice>, notice: Notice) {
    if !notices.contains(&notice) {
        notices.push(notice);
    }
}

/// Recorded numbers of a frame.
fn record(frame: u64, at: Nanos, steps: u64, vehicle: &Vehicle) -> FrameRecord {
    let Gaze { observer, observer_from_eye: orientation } = vehicle.gaze();
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
        doppler_ahead: celerity.kappa(),
        road: vehicle.odometer().road_m,
        odometer: vehicle.odometer().own_m,
    }
}
