//! Lines on what devices send: the reason of the last message that could not be read, and all that a tracker is heard
//! to send, used by a ride or not.

use glam::EulerRot;
use input::devices::{DeviceState, DeviceStatus};
use input::head::{HeardKind, HeardSensor};
use input::trainer::TrainerDecoder;
use input::{Desk, HeadConfig, Nanos, SampleSource, TrackerUrl};
use std::fmt::Write as _;

/// Line on the messages of a device that could not be read, with the reason of the last one; `None` if all could.
pub fn bad(desk: &Desk, source: SampleSource) -> Option<String> {
    let faults = desk.faults(source);
    faults.last().map(|last| format!("{} bad, the last: {last}", faults.number()))
}

/// Line about the trainer: what it measures at the time `now`.
pub fn trainer(trainer: &TrainerDecoder, now: Nanos) -> String {
    let told =
        |value: Option<f64>, unit: &str| value.map_or(format!("no {unit}"), |value| format!("{value:.0} {unit}"));
    format!(
        "trainer {} · {} · {}",
        told(trainer.wheel_speed(now).map(|speed| speed * 3.6), "km/h"),
        told(trainer.cadence_hz(now).map(|hz| hz * 60.0), "rpm"),
        told(trainer.power_w(now), "W")
    )
}

/// Line on each thing that the tracker of this source has been heard to send.
pub fn things(desk: &Desk, source: SampleSource, now: Nanos) -> Vec<String> {
    let head = desk.head().map(|head| head.config()).filter(|config| config.url.source() == source);
    let is_head = |thing: &HeardSensor| {
        head.is_some_and(|head| is_pose(thing, head) && thing.number == head.sensor && is_of(&head.url, thing))
    };
    desk.heard(source).iter().map(|thing| line(thing, is_head(thing), now)).collect()
}

/// True for a thing that may be on this head.
fn is_pose(thing: &HeardSensor, head: &HeadConfig) -> bool {
    match thing.kind {
        HeardKind::Sensor => true,
        HeardKind::Body => !head.inertial,
        HeardKind::InertialBody => head.inertial,
        _ => false,
    }
}

/// True if a thing belongs to the device that this address names.
fn is_of(url: &TrackerUrl, thing: &HeardSensor) -> bool {
    match url {
        TrackerUrl::Vrpn { device, .. } => *device == thing.device,
        _ => true,
    }
}

/// Device as the settings panel shows it: its state in a line, and what it sends in further ones.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DeviceReport {
    /// Name, state and rate of the device.
    pub line: String,
    /// Reason of the last message that could not be read, and the things that a tracker is heard to send.
    pub details: Vec<String>,
}

/// Report on a device at the time `now`, with `most` things of a tracker at most.
pub fn report(status: &DeviceStatus, desk: &Desk, now: Nanos, most: usize) -> DeviceReport {
    let source = status.source;
    let line = match &status.state {
        DeviceState::Open => format!("{source}: {} at {:.0} Hz", status.name, status.rate_hz),
        DeviceState::Absent(why) => format!("{source}: {why}"),
    };
    let mut details: Vec<String> = status.note.iter().cloned().chain(bad(desk, source)).collect();
    if source == SampleSource::Trainer && status.state == DeviceState::Open {
        details.push(trainer(desk.trainer(), now));
    }
    let mut things = things(desk, source, now);
    let more = things.len().saturating_sub(most);
    things.truncate(most);
    details.append(&mut things);
    if more > 0 {
        details.push(format!("and {more} more: see rapidity devices"));
    }
    DeviceReport { line, details }
}

fn line(thing: &HeardSensor, is_head: bool, now: Nanos) -> String {
    let mut line = format!("{thing}{}: {:.0} a second", if is_head { " (the head)" } else { "" }, thing.rate_hz(now));
    if !thing.is_tracked(now) {
        line += ", not seen";
    }
    if let Some((place, turn)) = thing.pose {
        let (yaw, pitch, roll) = turn.to_euler(EulerRot::YXZ);
        let [yaw, pitch, roll] = [yaw, pitch, roll].map(f64::to_degrees);
        let _ = write!(line, ", {:+.3} {:+.3} {:+.3} m", place.x, place.y, place.z);
        let _ = write!(line, ", yaw {yaw:+.1}° pitch {pitch:+.1}° roll {roll:+.1}°");
    }
    if let Some(buttons) = thing.buttons {
        let held: Vec<String> = buttons.numbers().map(|button| button.to_string()).collect();
        let _ = write!(line, ", held: {}", if held.is_empty() { "none".to_owned() } else { held.join(" ") });
    }
    if !thing.axes.is_empty() {
        let axes: Vec<String> = thing.axes.iter().map(|axis| format!("{axis:+.2}")).collect();
        let _ = write!(line, ", axes {}", axes.join(" "));
    }
    line
}

#[cfg(test)]
mod tests {
    //! Law: what a tracker sends is listed with its pose, used or not, and what cannot be read with its reason. A
    //! listing without them leaves a wrong number or a wrong port a riddle.
    #![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

    use super::*;
    use input::{DeskConfig, HeadConfig, Sample};

    #[test]
    fn bodies_are_listed_used_or_not_and_the_last_bad_datagram_with_its_reason() {
        let head = HeadConfig { sensor: 1, ..HeadConfig::new("dtrack://".parse().unwrap()) };
        let mut desk = Desk::new(DeskConfig { head: Some(head), ..Default::default() }).unwrap();
        assert_eq!(bad(&desk, SampleSource::Dtrack), None);
        let frame = b"fr 1\r\n6d 2 [0 1.0][100.0 200.0 300.0 0 0 0][1 0 0 0 1 0 0 0 1] \
            [1 1.0][0.0 1700.0 0.0 0 0 0][0 0 -1 0 1 0 1 0 0]\r\n";
        desk.feed(&Sample::bytes(0, SampleSource::Dtrack, *frame));
        desk.feed(&Sample::bytes(1, SampleSource::Dtrack, *b"\xff"));
        let lines = things(&desk, SampleSource::Dtrack, 2);
        let expected = [
            "body 0: 0 a second, +0.100 +0.200 +0.300 m, yaw +0.0° pitch +0.0° roll +0.0°",
            "body 1 (the head): 0 a second, +0.000 +1.700 +0.000 m, yaw +90.0° pitch +0.0° roll +0.0°",
        ];
        assert_eq!(lines.iter().map(|line| line.replace("-0.0°", "+0.0°")).collect::<Vec<_>>(), expected);
        let told = bad(&desk, SampleSource::Dtrack).unwrap();
        assert!(told.starts_with("1 bad, the last: ") && told.contains("not ASCII"), "{told}");

        // The panel shows the same, and no more than it has room for.
        let status = DeviceStatus {
            source: SampleSource::Dtrack,
            name: "DTrack".to_owned(),
            path: String::new(),
            state: DeviceState::Open,
            rate_hz: 60.0,
            samples: 2,
            dropped: 0,
            last: Vec::new(),
            note: None,
        };
        let report = report(&status, &desk, 2, 1);
        assert_eq!(report.line, "dtrack: DTrack at 60 Hz");
        assert_eq!(report.details.len(), 3);
        assert_eq!((&report.details[0], report.details[2].as_str()), (&told, "and 1 more: see rapidity devices"));
    }
}
