//! Records of a frame, and the entries of a recording.

use std::fmt;

use serde::{Deserialize, Serialize};

use crate::clock::Nanos;
use crate::controls::Controls;
use crate::sample::{Sample, Signal};

/// Observer after a frame's steps.
///
/// # Frames, units
/// World axes, right-handed, y up; lengths and times in metres (of light travel), as in the physics. The celerity is
/// in units of the speed of light. The orientation is the quaternion (x, y, z, w) that takes the pilot's axes to the
/// axes of the comoving frame that is a pure boost of the world's.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FrameRecord {
    /// Number of the frame, from 0.
    pub frame: u64,
    /// Real time of the frame, at which the controls were read.
    pub at: Nanos,
    /// Number of steps that were integrated in this frame.
    pub steps: u64,
    /// Proper time of the observer, metres.
    pub proper_time: f64,
    /// Time in the world's frame, metres.
    pub ct: f64,
    /// Place in the world, metres.
    pub position: [f64; 3],
    /// Celerity γβ in the world.
    pub celerity: [f64; 3],
    /// Orientation, quaternion (x, y, z, w).
    pub orientation: [f64; 4],
    /// Rapidity, for plots.
    pub rapidity: f64,
    /// Doppler factor dead ahead of the motion, for plots.
    pub doppler_ahead: f64,
    /// Distance ridden along the road, metres.
    pub road: f64,
    /// Distance ridden by the vehicle's own odometer (∫ β dτ), metres.
    pub odometer: f64,
}

/// First difference between two frame records.
#[derive(Clone, Debug, PartialEq)]
pub struct FrameDifference {
    /// Name of the field, with its index.
    pub field: String,
    /// Value in the recording.
    pub recorded: String,
    /// Value in the replay.
    pub replayed: String,
}

impl FrameRecord {
    /// All real numbers of the record, with their names.
    fn numbers(&self) -> impl Iterator<Item = (FieldPlace, f64)> {
        let vectors: [(&str, &[f64]); 9] = [
            ("proper_time", std::slice::from_ref(&self.proper_time)),
            ("ct", std::slice::from_ref(&self.ct)),
            ("position", &self.position),
            ("celerity", &self.celerity),
            ("orientation", &self.orientation),
            ("rapidity", std::slice::from_ref(&self.rapidity)),
            ("doppler_ahead", std::slice::from_ref(&self.doppler_ahead)),
            ("road", std::slice::from_ref(&self.road)),
            ("odometer", std::slice::from_ref(&self.odometer)),
        ];
        vectors.into_iter().flat_map(|(field, vector)| {
            let place = move |index| FieldPlace { field, index: (vector.len() > 1).then_some(index) };
            vector.iter().enumerate().map(move |(index, &number)| (place(index), number))
        })
    }

    /// First number that JSON cannot carry, with its name.
    pub(super) fn not_finite(&self) -> Option<(String, f64)> {
        let found = self.numbers().find(|(_, number)| !number.is_finite());
        found.map(|(place, number)| (place.to_string(), number))
    }

    /// Compares a recorded frame with a replayed one, bit for bit; −0 differs from 0.
    pub fn first_difference(&self, replayed: &Self) -> Option<FrameDifference> {
        let counts = [
            ("frame", self.frame, replayed.frame),
            ("at", self.at, replayed.at),
            ("steps", self.steps, replayed.steps),
        ];
        if let Some((field, ours, theirs)) = counts.into_iter().find(|(_, ours, theirs)| ours != theirs) {
            let (recorded, replayed) = (ours.to_string(), theirs.to_string());
            return Some(FrameDifference { field: field.to_owned(), recorded, replayed });
        }
        let differs = |((place, ours), (_, theirs)): &((FieldPlace, f64), (FieldPlace, f64))| {
            ours.to_bits() != theirs.to_bits() && !(place.field == "rapidity" && is_rounding(*ours, *theirs))
        };
        self.numbers().zip(replayed.numbers()).find(differs).map(|((place, ours), (_, theirs))| {
            let (recorded, replayed) = (format!("{ours:?}"), format!("{theirs:?}"));
            FrameDifference { field: place.to_string(), recorded, replayed }
        })
    }
}

/// True if two values of a function differ by its rounding alone. The rapidity is one of the celerity, which is
/// compared to the bit; earlier versions asked the C library for it, whose last bits differ between processors.
fn is_rounding(ours: f64, theirs: f64) -> bool {
    const ROUNDINGS: f64 = 4.0;
    (ours - theirs).abs() <= ROUNDINGS * f64::EPSILON * ours.abs()
}

/// Name of a number in a frame record.
#[derive(Clone, Copy)]
struct FieldPlace {
    field: &'static str,
    index: Option<usize>,
}

impl fmt::Display for FieldPlace {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.index {
            Some(index) => write!(formatter, "{}[{index}]", self.field),
            None => formatter.write_str(self.field),
        }
    }
}

/// Controls of a frame.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ControlsRecord {
    /// Number of the frame.
    pub frame: u64,
    /// Real time of the frame, at which the controls were read.
    pub at: Nanos,
    /// Controls at that time.
    #[serde(flatten)]
    pub controls: Controls,
}

/// Message of a recording.
#[derive(Clone, Debug, PartialEq)]
pub enum RecordingEntry {
    /// Sample of a device.
    Sample(Sample),
    /// Controls that the desk made for a frame.
    Controls(ControlsRecord),
    /// Observer after the frame.
    Frame(FrameRecord),
}

impl RecordingEntry {
    /// Memory that the entry takes, bytes.
    pub fn memory(&self) -> usize {
        let more = match self {
            Self::Sample(Sample { signal: Signal::Bytes(bytes), .. }) => bytes.len(),
            Self::Sample(_) | Self::Frame(_) => 0,
            Self::Controls(record) => size_of_val(record.controls.actions.as_slice()),
        };
        size_of::<Self>() + more
    }
}

/// Controls of a frame, as they are written, with the number of samples that came before them.
#[derive(Clone, Debug, Serialize)]
pub(super) struct WrittenControls<'a> {
    pub(super) samples: u64,
    #[serde(flatten)]
    pub(super) record: &'a ControlsRecord,
}

/// Controls of a frame, as they are read. The first format had no number of samples.
#[derive(Clone, Debug, Deserialize)]
pub(super) struct ReadControls {
    pub(super) samples: Option<u64>,
    #[serde(flatten)]
    pub(super) record: ControlsRecord,
}

#[cfg(test)]
mod tests {
    //! Every field must take part in the comparison and be known to the schema: a forgotten field would differ
    //! unnoticed, or would not be plotted.
    use super::super::topic::RecordingTopic;
    use super::*;
    use serde_json::Value;

    fn frame() -> FrameRecord {
        FrameRecord { frame: 3, position: [0.1, -0.0, 1e-300], orientation: [0.0, 0.0, 0.0, 1.0], ..Default::default() }
    }

    /// Calls `each` with the record changed in one number, for every number in it.
    fn nudge_each(record: &FrameRecord, mut each: impl FnMut(String, FrameRecord)) {
        let value = serde_json::to_value(record).unwrap();
        let nudge = |value: &Value| match value {
            Value::Number(number) if number.is_u64() => Value::from(number.as_u64().unwrap() + 1),
            number => Value::from(f64::from_bits(number.as_f64().unwrap().to_bits() ^ 1)),
        };
        for (key, field) in value.as_object().unwrap() {
            let mut changed = value.clone();
            if let Value::Array(elements) = field {
                for (index, element) in elements.iter().enumerate() {
                    let mut changed = value.clone();
                    changed[key][index] = nudge(element);
                    each(format!("{key}[{index}]"), serde_json::from_value(changed).unwrap());
                }
            } else {
                changed[key] = nudge(field);
                each(key.clone(), serde_json::from_value(changed).unwrap());
            }
        }
    }

    #[test]
    fn equal_frames_do_not_differ() {
        assert_eq!(frame().first_difference(&frame()), None);
    }

    #[test]
    fn the_last_bit_of_every_field_shows() {
        let mut fields = 0;
        nudge_each(&frame(), |name, changed| {
            assert_eq!(frame().first_difference(&changed).unwrap().field, name);
            fields += 1;
        });
        assert_eq!(fields, 3 + 2 + 3 + 3 + 4 + 4);
    }

    #[test]
    fn minus_zero_is_not_zero() {
        let mut changed = frame();
        changed.position[1] = 0.0;
        let difference = frame().first_difference(&changed).unwrap();
        assert_eq!((difference.recorded.as_str(), difference.replayed.as_str()), ("-0.0", "0.0"));
    }

    #[test]
    fn every_bit_survives_the_text() {
        let mut record = frame();
        record.position = [f64::MIN_POSITIVE / 3.0, -0.0, 1.0 / 3.0];
        record.celerity = [1e12 + 1.0 / 1024.0, f64::MAX, f64::EPSILON];
        let text = serde_json::to_string(&record).unwrap();
        assert_eq!(record.first_difference(&serde_json::from_str(&text).unwrap()), None);
    }

    #[test]
    fn schemas_describe_exactly_what_is_written() {
        let controls = ControlsRecord::default();
        let written = [
            (
                RecordingTopic::Controls,
                serde_json::to_value(WrittenControls { samples: 0, record: &controls }).unwrap(),
            ),
            (RecordingTopic::Frames, serde_json::to_value(FrameRecord::default()).unwrap()),
        ];
        for (topic, written) in written {
            let schema: Value = serde_json::from_str(topic.schema().unwrap().1).unwrap();
            let described: Vec<_> = schema["properties"].as_object().unwrap().keys().collect();
            let written: Vec<_> = written.as_object().unwrap().keys().collect();
            assert_eq!(described, written, "{topic:?}");
        }
    }
}
