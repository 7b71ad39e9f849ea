//! Lines on what devices send: the reason of the last message that could not be read, and all that a tracker is heard
//! to send, used by a ride or not.

use crate::german;
use glam::EulerRot;
use input::devices::{DeviceFault, DeviceNote, DeviceState, DeviceStatus};
use input::head::{HeardKind, HeardSensor};
use input::trainer::TrainerDecoder;
use input::{Desk, HeadConfig, Nanos, SampleSource, TrackerUrl};
use std::fmt::Display;
use words::{Language, Phrase};

/// Line on the messages of a device that could not be read, with the reason of the last one; `None` if all could.
pub fn bad(desk: &Desk, source: SampleSource, language: Language) -> Option<String> {
    let faults = desk.faults(source);
    faults.last().map(|last| language.fill(Phrase::BadMessages, &[&faults.number(), &last]))
}

/// Sentence on a device that is not open.
pub fn fault(fault: &DeviceFault, language: Language) -> String {
    match language {
        Language::English => fault.to_string(),
        Language::German => german::fault(fault),
    }
}

/// Sentence on a device that is open and yet does not do all that it should.
pub fn note(note: DeviceNote, language: Language) -> String {
    match language {
        Language::English => note.to_string(),
        Language::German => german::note(note),
    }
}

/// Line about the trainer: what it measures at the time `now`.
pub fn trainer(trainer: &TrainerDecoder, now: Nanos, language: Language) -> String {
    let told = |value: Option<f64>, unit: &str| match value {
        Some(value) => format!("{value:.0} {unit}"),
        None => language.fill(Phrase::NoValue, &[&unit]),
    };
    let speed = told(trainer.wheel_speed(now).map(|speed| speed * 3.6), "km/h");
    let cadence = told(trainer.cadence_hz(now).map(|hz| hz * 60.0), language.text(Phrase::TurnsPerMinute));
    language.fill(Phrase::TrainerLine, &[&speed, &cadence, &told(trainer.power_w(now), "W")])
}

/// Line on each thing that the tracker of this source has been heard to send.
pub fn things(desk: &Desk, source: SampleSource, now: Nanos, language: Language) -> Vec<String> {
    let head = desk.head().map(|head| head.config()).filter(|config| config.url.source() == source);
    let is_head = |thing: &HeardSensor| {
        head.is_some_and(|head| is_pose(thing, head) && thing.number == head.sensor && is_of(&head.url, thing))
    };
    desk.heard(source).iter().map(|thing| line(thing, is_head(thing), now, language)).collect()
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
pub fn report(status: &DeviceStatus, desk: &Desk, now: Nanos, most: usize, language: Language) -> DeviceReport {
    let source = status.source;
    let own = match language {
        Language::English => source.name(),
        Language::German => german::source(source),
    };
    // A device without a name bears that of its source.
    let name = if status.name == source.name() { own } else { &status.name };
    let line = match &status.state {
        DeviceState::Open => language.fill(Phrase::DeviceAt, &[&own, &name, &format!("{:.0}", status.rate_hz)]),
        DeviceState::Absent(why) => format!("{own}: {}", fault(why, language)),
    };
    let noted = status.note.map(|noted| note(noted, language));
    let mut details: Vec<String> = noted.into_iter().chain(bad(desk, source, language)).collect();
    if source == SampleSource::Trainer && status.state == DeviceState::Open {
        details.push(trainer(desk.trainer(), now, language));
    }
    let mut things = things(desk, source, now, language);
    let more = things.len().saturating_sub(most);
    things.truncate(most);
    details.append(&mut things);
    if more > 0 {
        details.push(language.fill(Phrase::MoreThings, &[&more]));
    }
    DeviceReport { line, details }
}

fn line(thing: &HeardSensor, is_head: bool, now: Nanos, language: Language) -> String {
    let name = match language {
        Language::English => thing.to_string(),
        Language::German => german::thing(thing),
    };
    let name = if is_head { language.fill(Phrase::IsHead, &[&name]) } else { name };
    let mut parts = vec![language.fill(Phrase::HeardAt, &[&name, &format!("{:.0}", thing.rate_hz(now))])];
    if !thing.is_tracked(now) {
        parts.push(language.text(Phrase::NotSeen).to_owned());
    }
    if let Some((place, turn)) = thing.pose {
        parts.push(format!("{:+.3} {:+.3} {:+.3} m", place.x, place.y, place.z));
        let (yaw, pitch, roll) = turn.to_euler(EulerRot::YXZ);
        let angles = [yaw, pitch, roll].map(|angle| format!("{:+.1}", angle.to_degrees()));
        parts.push(language.fill(Phrase::Angles, &angles.each_ref().map(|angle| angle as &dyn Display)));
    }
    if let Some(buttons) = thing.buttons {
        let held: Vec<String> = buttons.numbers().map(|button| button.to_string()).collect();
        let none = language.text(Phrase::NoButton).to_owned();
        parts.push(language.fill(Phrase::Held, &[&if held.is_empty() { none } else { held.join(" ") }]));
    }
    if !thing.axes.is_empty() {
        let axes: Vec<String> = thing.axes.iter().map(|axis| format!("{axis:+.2}")).collect();
        parts.push(language.fill(Phrase::Axes, &[&axes.join(" ")]));
    }
    parts.join(", ")
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
        let language = Language::English;
        assert_eq!(bad(&desk, SampleSource::Dtrack, language), None);
        let frame = b"fr 1\r\n6d 2 [0 1.0][100.0 200.0 300.0 0 0 0][1 0 0 0 1 0 0 0 1] \
            [1 1.0][0.0 1700.0 0.0 0 0 0][0 0 -1 0 1 0 1 0 0]\r\n";
        desk.feed(&Sample::bytes(0, SampleSource::Dtrack, *frame));
        desk.feed(&Sample::bytes(1, SampleSource::Dtrack, *b"\xff"));
        let lines = things(&desk, SampleSource::Dtrack, 2, language);
        let expected = [
            "body 0: 0 a second, +0.100 +0.200 +0.300 m, yaw +0.0° pitch +0.0° roll +0.0°",
            "body 1 (the head): 0 a second, +0.000 +1.700 +0.000 m, yaw +90.0° pitch +0.0° roll +0.0°",
        ];
        assert_eq!(lines.iter().map(|line| line.replace("-0.0°", "+0.0°")).collect::<Vec<_>>(), expected);
        let told = bad(&desk, SampleSource::Dtrack, language).unwrap();
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
        let report = report(&status, &desk, 2, 1, language);
        assert_eq!(report.line, "dtrack: DTrack at 60 Hz");
        assert_eq!(report.details.len(), 3);
        assert_eq!((&report.details[0], report.details[2].as_str()), (&told, "and 1 more: see rapidity devices"));

        // In German, too, with the same numbers; what the decoder says of the datagram stays as it is.
        let german = super::report(&status, &desk, 2, 1, Language::German);
        assert_eq!(german.line, "DTrack: DTrack mit 60 Hz");
        let [bad, body, more] = german.details.try_into().unwrap();
        assert!(bad.starts_with("1 unlesbar, zuletzt: ") && bad.ends_with(told.rsplit(": ").next().unwrap()), "{bad}");
        let body = body.replace("-0.0°", "+0.0°");
        assert_eq!(body, "Körper 0: 0 je Sekunde, +0.100 +0.200 +0.300 m, Gieren +0.0° Nicken +0.0° Rollen +0.0°");
        assert_eq!(more, "und 1 weitere: siehe rapidity devices");
        let gone = DeviceState::Absent(DeviceFault::NoInterface);
        let status = DeviceStatus { source: SampleSource::Trainer, state: gone, ..status };
        let line = super::report(&status, &desk, 2, 1, Language::German).line;
        assert_eq!(line, "Rollentrainer: dieser Rechner hat dafür keine Netzwerkschnittstelle");
    }
}
