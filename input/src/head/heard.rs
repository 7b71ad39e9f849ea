//! Things that a tracker has been heard to send: sensors, bodies, sets of buttons and of axes, tracked or not.
//!
//! A listing shows them, so that a wrong number or name can be told from a dead tracker. They change no ride.

use std::fmt;

use glam::{DQuat, DVec3};

use crate::clock::{Nanos, SECOND, seconds_between};
use crate::wand::held_buttons::HeldButtons;

/// Most things of one tracker that are listed; a hostile one may name any number.
pub const MOST_HEARD: usize = 64;
/// Silence after which the rate counts as zero, and a pose as no longer tracked, seconds.
const SILENCE_S: f64 = 2.0;

/// Kind of a thing that a tracker sends.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum HeardKind {
    /// Sensor of a VRPN device.
    Sensor,
    /// Optical body of DTrack, from its line `6d`.
    Body,
    /// Body of DTrack that may be seen by its inertial sensor alone, from its line `6di`.
    InertialBody,
    /// Flystick of DTrack: pose, buttons and joystick.
    Flystick,
    /// Buttons of a VRPN device.
    Buttons,
    /// Analog channels of a VRPN device.
    Axes,
}

/// Thing that a tracker has been heard to send, with its last state.
///
/// *Frames, units*: the tracker's own axes; metres.
#[derive(Clone, Debug, PartialEq)]
pub struct HeardSensor {
    /// Kind of the thing.
    pub kind: HeardKind,
    /// Name of its device at the server; empty where the tracker has no names.
    pub device: String,
    /// Number of the sensor, body or flystick; 0 for buttons and axes.
    pub number: i32,
    /// Number of reports since the connection was opened.
    pub count: u64,
    /// Time of the last report.
    pub last_at: Nanos,
    /// True if the last report holds a pose, or is no pose at all. False while the tracker says that it does not see
    /// the thing, or sends the zero pose or numbers that are no pose.
    pub tracked: bool,
    /// Time at which it was tracked last; that of the first report if it never was.
    pub seen_at: Nanos,
    /// Last place and turn that was sent.
    pub pose: Option<(DVec3, DQuat)>,
    /// Buttons that are held.
    pub buttons: Option<HeldButtons>,
    /// Last values of the joystick or the analog channels.
    pub axes: Vec<f64>,
    /// Rate over the last whole second of reports, Hz.
    rate_hz: f64,
    second_began: Nanos,
    this_second: u32,
}

impl HeardKind {
    /// Name of a thing of this kind.
    pub(crate) fn named(self, device: &str, number: i32) -> String {
        match self {
            Self::Sensor => format!("sensor {number} of {device}"),
            Self::Body => format!("body {number}"),
            Self::InertialBody => format!("inertial body {number}"),
            Self::Flystick => format!("flystick {number}"),
            Self::Buttons => format!("buttons of {device}"),
            Self::Axes => format!("axes of {device}"),
        }
    }
}

impl HeardSensor {
    fn new(kind: HeardKind, device: &str, number: i32, at: Nanos) -> Self {
        Self {
            kind,
            device: device.to_owned(),
            number,
            count: 0,
            last_at: at,
            tracked: true,
            seen_at: at,
            pose: None,
            buttons: None,
            axes: Vec::new(),
            rate_hz: 0.0,
            second_began: at,
            this_second: 0,
        }
    }

    /// True if this is the thing of that kind, device and number.
    pub(crate) fn is(&self, kind: HeardKind, device: &str, number: i32) -> bool {
        (self.kind, self.number) == (kind, number) && self.device == device
    }

    /// Rate of the reports over the last second, Hz; 0 after two seconds of silence.
    pub fn rate_hz(&self, now: Nanos) -> f64 {
        if seconds_between(self.last_at, now) > SILENCE_S { 0.0 } else { self.rate_hz }
    }

    /// True if the tracker sees the thing at the time `now`. Buttons and axes are seen as long as they are known,
    /// because they report changes alone.
    pub fn is_tracked(&self, now: Nanos) -> bool {
        let reports_changes = matches!(self.kind, HeardKind::Buttons | HeardKind::Axes);
        self.tracked && (reports_changes || seconds_between(self.last_at, now) <= SILENCE_S)
    }

    /// Takes the pose of a report; `None` if the tracker does not see the thing, whose last pose is kept.
    pub(crate) fn see(&mut self, at: Nanos, pose: Option<(DVec3, DQuat)>) {
        self.tracked = pose.is_some();
        if pose.is_some() {
            (self.pose, self.seen_at) = (pose, at);
        }
    }

    fn count(&mut self, at: Nanos) {
        self.count += 1;
        self.this_second += 1;
        self.last_at = at;
        if at.saturating_sub(self.second_began) >= SECOND {
            self.rate_hz = f64::from(self.this_second) / seconds_between(self.second_began, at);
            (self.second_began, self.this_second) = (at, 0);
        }
    }
}

impl fmt::Display for HeardSensor {
    /// Name of the thing, as `sensor 1 of Head`, `body 3`, `flystick 0`, `buttons of Wand`.
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(&self.kind.named(&self.device, self.number))
    }
}

/// Names in one text: `a`, `a and b`, `a, b and c`.
pub(crate) fn enumerated(names: &[String]) -> String {
    match names.split_last() {
        None => String::new(),
        Some((last, [])) => last.clone(),
        Some((last, others)) => format!("{} and {last}", others.join(", ")),
    }
}

/// All things that a tracker has been heard to send, [`MOST_HEARD`] at most.
#[derive(Clone, Debug, Default)]
pub(crate) struct HeardSensors {
    sensors: Vec<HeardSensor>,
}

impl HeardSensors {
    /// Things in the order in which they were first heard.
    pub(crate) fn sensors(&self) -> &[HeardSensor] {
        &self.sensors
    }

    /// Forgets all, with the connection.
    pub(crate) fn forget(&mut self) {
        self.sensors.clear();
    }

    /// Counts a report, and gives its entry to be filled; `None` if there are too many.
    pub(crate) fn report(&mut self, at: Nanos, kind: HeardKind, device: &str, number: i32) -> Option<&mut HeardSensor> {
        let index = match self.sensors.iter().position(|known| known.is(kind, device, number)) {
            Some(index) => index,
            None if self.sensors.len() < MOST_HEARD => {
                self.sensors.push(HeardSensor::new(kind, device, number, at));
                self.sensors.len() - 1
            }
            None => return None,
        };
        let heard = &mut self.sensors[index];
        heard.count(at);
        Some(heard)
    }

    /// Marks all things of this kind as unseen that were not reported at the time `at`.
    pub(crate) fn unseen_but_at(&mut self, at: Nanos, kind: HeardKind) {
        for heard in self.sensors.iter_mut().filter(|heard| heard.kind == kind && heard.last_at != at) {
            heard.tracked = false;
        }
    }
}

#[cfg(test)]
mod tests {
    //! Laws: a thing that is heard is listed once, with its rate; a flood of names costs no memory.
    use super::*;

    #[test]
    fn the_rate_is_that_of_the_last_second_and_ends_with_the_reports() {
        let mut heard = HeardSensors::default();
        for number in 0..150 {
            let at = number * SECOND / 60;
            heard.report(at, HeardKind::Body, "", 3).unwrap();
            heard.report(at, HeardKind::Sensor, "Head", 3).unwrap();
        }
        let [body, sensor] = heard.sensors() else { panic!("{:?}", heard.sensors()) };
        assert_eq!((body.to_string().as_str(), body.count), ("body 3", 150));
        assert_eq!(sensor.to_string(), "sensor 3 of Head");
        assert!((body.rate_hz(3 * SECOND) - 60.0).abs() < 1.5, "{}", body.rate_hz(3 * SECOND));
        assert!(body.is_tracked(3 * SECOND) && !body.is_tracked(5 * SECOND));
        assert_eq!(body.rate_hz(5 * SECOND), 0.0);
    }

    #[test]
    fn what_a_frame_leaves_out_is_unseen() {
        let mut heard = HeardSensors::default();
        for (at, number) in [(0, 1), (0, 2), (1, 2)] {
            heard.report(at, HeardKind::Body, "", number).unwrap().tracked = true;
        }
        heard.unseen_but_at(1, HeardKind::Body);
        assert_eq!(heard.sensors().iter().map(|body| body.tracked).collect::<Vec<_>>(), [false, true]);
    }

    #[test]
    fn names_without_end_cost_no_memory() {
        let mut heard = HeardSensors::default();
        for number in 0..10_000 {
            heard.report(0, HeardKind::Sensor, "x", number);
        }
        assert_eq!(heard.sensors().len(), MOST_HEARD);
        heard.forget();
        assert!(heard.report(0, HeardKind::Sensor, "x", 10_000).is_some());
    }
}
