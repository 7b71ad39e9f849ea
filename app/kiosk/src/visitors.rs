//! Visitors of a kiosk. A touch of any control begins a fresh ride at the start, and nothing is left of the visitor
//! before: neither speed of light nor vehicle, pause or clock.
//!
//! All that changes the ride enters as samples, so recordings of a kiosk replay. While the attract ride is shown, the
//! bicycle of the tour stands in for the real one. What the devices say is decoded a second time here, to tell a touch
//! from a device that merely goes on talking.

use crate::attract::Attract;
use crate::day_log::{DayEvent, DayLog, DayLogError};
use crate::frame_tally::FrameTally;
use crate::head_watch::{HeadNews, HeadWatch};
use crate::reach::Reach;
use crate::turns::{Turn, Turns};
use glam::DVec3;
use input::{Action, ConfigError, Controls, Desk, Nanos, SECOND, Sample, SampleSource, Signal};
use ride::{RideFrame, Setup, Vehicle};
use std::collections::BTreeSet;

/// Deflection of a stick, pull of a brake, and speed of a wheel (m/s) below which nobody touches it: what worn sticks
/// and sensors give by themselves.
const DRIFT: f64 = 0.15;
/// Turn of the handlebar that is a touch, radians. A handlebar may lean in any position.
const TURNED_RAD: f64 = 0.1;

/// Sequence of visitors.
pub struct Kiosk {
    turns: Turns,
    attract: Attract,
    /// Desk that hears the devices besides the keyboard: a wheel that keys have pedalled goes on without them.
    devices: Desk,
    /// Codes of the keys that are down.
    held: BTreeSet<u8>,
    /// Angle of the handlebar at the last touch, radians.
    steer_rad: f64,
    /// Touch of something that is no device of the ride.
    touched: bool,
    /// State of a fresh ride.
    fresh: [Action; 2],
    setup_kind: Action,
    /// True while the real bicycle is connected.
    bicycle: bool,
    paused: bool,
    log: Option<DayLog>,
    /// Fault of the log that nobody has been told of.
    unwritten: Option<DayLogError>,
    /// Beginning, distance and top speed (v/c) of the visitor's ride.
    began: Nanos,
    road_m: f64,
    /// Odometer at the last frame of the visitor, metres.
    odometer_m: f64,
    top_beta: f64,
    /// Ball within which a visitor finds the scene again, if the scene has an extent.
    reach: Option<Reach>,
    /// Distance from the scene's middle at which the ride has left it behind, metres.
    strayed: Option<f64>,
    head: HeadWatch,
    tally: FrameTally,
}

impl Kiosk {
    /// Kiosk before its first visitor. `time_scale` is that of every ride.
    ///
    /// # Errors
    /// [`ConfigError`] of the devices' settings.
    pub fn new(
        idle_s: f64,
        setup: &Setup,
        time_scale: f64,
        circuit: &[DVec3],
        log: Option<DayLog>,
    ) -> Result<Self, ConfigError> {
        let attract = Attract::new(circuit, setup.kind, &setup.desk);
        let mut kiosk = Self {
            turns: Turns::new((idle_s * SECOND as f64) as Nanos, attract.longest()),
            attract,
            devices: Desk::new(setup.desk.clone())?,
            held: BTreeSet::new(),
            steer_rad: 0.0,
            touched: false,
            fresh: [Action::TimeScale(time_scale), Action::SpeedOfLight(setup.light_speed.speed_of_light_m_s())],
            setup_kind: Action::Vehicle(setup.kind),
            bicycle: false,
            paused: false,
            log,
            unwritten: None,
            began: 0,
            road_m: 0.0,
            odometer_m: f64::INFINITY,
            top_beta: 0.0,
            reach: None,
            strayed: None,
            head: HeadWatch::default(),
            tally: FrameTally::default(),
        };
        kiosk.note(&DayEvent::Start { version: env!("CARGO_PKG_VERSION") });
        Ok(kiosk)
    }

    /// The same kiosk for a scene given by the middle and the radius of its extent, world metres. A ride from which
    /// nothing of it can be found again goes back to the start. `start` is that of the ride.
    pub fn round_scene(mut self, middle: DVec3, radius_m: f64, start: DVec3) -> Self {
        self.reach = Reach::new(middle, radius_m, start);
        self
    }

    /// True while the attract ride is shown.
    pub fn attracts(&self) -> bool {
        self.turns.attracts()
    }

    /// Notes a touch of something that is no device of the ride.
    pub fn touch(&mut self) {
        self.touched = true;
    }

    /// Samples that the ride gets instead of those of the devices, in order of time, and the turn that begins with
    /// them.
    pub fn samples(&mut self, now: Nanos, samples: Vec<Sample>, vehicle: &Vehicle) -> (Vec<Sample>, Option<Turn>) {
        let touched = self.is_touched(now, &samples) | std::mem::take(&mut self.touched);
        let (rode, last_touch) = (!self.turns.attracts(), self.turns.last_touch());
        let strayed = self.strayed.take();
        let turn = self.turns.step(now, touched, strayed.is_some());
        if let (Some(_), Some(reach)) = (turn, &mut self.reach) {
            reach.begin();
        }
        let mut passed = Vec::new();
        match turn {
            Some(Turn::Attract) => {
                if rode && self.began > 0 {
                    if let Some(metres) = strayed {
                        self.note(&DayEvent::Strayed { metres });
                    }
                    self.ridden_until(last_touch);
                }
                passed.extend(self.attract.begin(now));
                passed.extend(self.start_anew(now, &Action::Vehicle(self.attract.vehicle())));
                self.note(&DayEvent::Attract);
            }
            Some(Turn::Visitor) => {
                // The touch itself belongs to the new ride.
                let at = samples.first().map_or(now, |first| first.at.min(now));
                passed.extend(self.attract.end(at));
                passed.extend(self.start_anew(at, &self.setup_kind.clone()));
                if self.bicycle {
                    passed.push(Sample::opened(at, SampleSource::Bicycle));
                }
                (self.began, self.road_m, self.top_beta) = (now.max(1), 0.0, 0.0);
                // Until the vehicle is at the start, the odometer is that of the attract ride.
                self.odometer_m = f64::INFINITY;
            }
            None => {}
        }
        if self.turns.attracts() {
            passed.extend(samples.into_iter().filter(|sample| sample.source != SampleSource::Bicycle));
            passed.extend(self.attract.samples(vehicle, now));
        } else {
            passed.extend(samples);
        }
        passed.sort_by_key(|sample| sample.at);
        (passed, turn)
    }

    /// Takes note of a frame of the ride.
    pub fn shown(&mut self, now: Nanos, frame: &RideFrame) {
        self.paused = frame.paused;
        if !self.turns.attracts() {
            // A return to the start takes the odometer back, not the road that was ridden.
            let road_m = frame.vehicle.odometer().road_m;
            self.road_m += (road_m - self.odometer_m).max(0.0);
            self.odometer_m = road_m;
            self.top_beta = self.top_beta.max(frame.gaze.observer.celerity.beta().vector().length());
        }
        if let Some(reach) = &mut self.reach {
            self.strayed = reach.left_at(frame.gaze.observer.event.position);
        }
        self.tally.add(now);
        if self.tally.is_due(now) {
            self.sum_up(now);
        }
    }

    /// Takes note of a tracked head at the time `now`; `lost` is the sentence on one that is not seen.
    pub fn head(&mut self, now: Nanos, lost: Option<&str>) {
        match self.head.step(now, lost.is_some()) {
            Some(HeadNews::Lost(seconds)) => {
                self.fault(&format!("for {seconds:.0} s: {}", lost.unwrap_or_default()));
            }
            Some(HeadNews::Found(seconds)) => {
                self.fault(&format!("the head is tracked again; it was lost for {seconds:.0} s"));
            }
            None => {}
        }
    }

    /// Writes a fault into the day's log.
    pub fn fault(&mut self, sentence: &str) {
        self.note(&DayEvent::Fault { sentence });
    }

    /// Fault of the day's log, once.
    pub fn take_fault(&mut self) -> Option<DayLogError> {
        self.unwritten.take()
    }

    /// Completes the day's log.
    pub fn finish(&mut self, now: Nanos) {
        if !self.turns.attracts() && self.began > 0 {
            self.ridden_until(now);
        }
        self.sum_up(now);
        self.note(&DayEvent::End);
    }

    /// Actions that bring the ride back to its start with nothing left of what came before.
    fn start_anew(&self, at: Nanos, vehicle: &Action) -> Vec<Sample> {
        let unpause = self.paused.then_some(Action::TogglePause);
        let [scale, light] = &self.fresh;
        let actions = unpause.iter().chain([scale, light, vehicle, &Action::Restart]);
        actions.map(|action| Sample::action(at, action)).collect()
    }

    /// True if somebody touches a control. A device that goes on talking while nobody does is no touch.
    fn is_touched(&mut self, now: Nanos, samples: &[Sample]) -> bool {
        for sample in samples {
            if sample.source == SampleSource::Bicycle {
                self.bicycle = sample.signal != Signal::Closed;
            }
            match (sample.source, &sample.signal) {
                (SampleSource::Keyboard, Signal::Bytes(bytes)) => match **bytes {
                    [code, 0] => drop(self.held.remove(&code)),
                    [code, _] => drop(self.held.insert(code)),
                    _ => {}
                },
                (SampleSource::Keyboard, _) => self.held.clear(),
                _ => self.devices.feed(sample),
            }
        }
        let by_hand = |source| matches!(source, SampleSource::Keyboard | SampleSource::Mouse | SampleSource::Settings);
        let pressed = samples.iter().any(|sample| by_hand(sample.source) && matches!(sample.signal, Signal::Bytes(_)));
        let controls = self.devices.controls(now);
        let touched = pressed
            || !self.held.is_empty()
            || is_held(&controls)
            || (controls.steer_rad - self.steer_rad).abs() > TURNED_RAD;
        if touched {
            self.steer_rad = controls.steer_rad;
        }
        touched
    }

    fn ridden_until(&mut self, end: Nanos) {
        let seconds = end.saturating_sub(self.began) as f64 / SECOND as f64;
        let (metres, top_beta) = (self.road_m, self.top_beta);
        self.note(&DayEvent::Ride { seconds, metres, top_beta });
        self.began = 0;
    }

    fn sum_up(&mut self, now: Nanos) {
        if let Some(frames) = self.tally.take(now) {
            self.note(&frames);
        }
    }

    fn note(&mut self, event: &DayEvent<'_>) {
        if let Some(Err(error)) = self.log.as_mut().map(|log| log.note(event)) {
            self.unwritten = Some(error);
        }
    }
}

/// True if a control is held away from its rest.
fn is_held(controls: &Controls) -> bool {
    let deflected = |values: &[f64]| values.iter().any(|value| value.abs() > DRIFT);
    let wheel = controls.wheel_speed.unwrap_or(0.0);
    !controls.actions.is_empty()
        || deflected(&[wheel, controls.brake])
        || deflected(&controls.thrust)
        || deflected(&controls.turn)
}
