//! ART DTrack: one UDP datagram of ASCII lines for every frame of the cameras.
//!
//! | line | holds |
//! |---|---|
//! | `ts2 S US LATENCY` | seconds since 1970 and microseconds of the measurement, and latency until sending, µs |
//! | `ts S` | the same by older controllers: seconds since midnight |
//! | `6d N [id q][x y z a b c][r0 … r8] …` | N bodies: number, quality, position in mm, angles, matrix by columns |
//!
//! All other lines (`fr`, `6dcal`, `6df2`, `3d`, …) are passed over. A body that the cameras do not see is not in the
//! `6d` line, or has quality −1. The matrix is used, not the angles.
//!
//! ```
//! use input::decoder::{Actions, Decoder};
//! use input::dtrack::DtrackDecoder;
//!
//! let mut decoder = DtrackDecoder::default();
//! let frame = b"fr 1\r\n6d 1 [0 1.000][100.0 200.0 300.0 0 0 0][1 0 0 0 1 0 0 0 1]\r\n";
//! decoder.bytes(0, frame, &mut Actions::default());
//! assert_eq!(decoder.take_poses()[0].position_m.to_array(), [0.1, 0.2, 0.3]);
//! ```

use glam::{DMat3, DQuat, DVec3};
use thiserror::Error;

use crate::clock::Nanos;
use crate::decoder::{Actions, Decoder};
use crate::faults::Faults;
use crate::head::config::HeadConfig;
use crate::head::heard::{HeardSensor, HeardSensors};
use crate::head::tracked_pose::TrackedPose;

/// Usual port of DTrack.
pub const PORT: u16 = 5000;
/// Length of the longest datagram that is accepted, bytes: about a hundred bodies.
pub const LONGEST_DATAGRAM: usize = 32 * 1024;
/// Largest deviation of a rotation matrix's columns from orthonormal; six decimals are sent.
const ORTHONORMAL: f64 = 1e-2;

/// Reason for skipping a datagram, or a line of it.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum DtrackError {
    /// A datagram that is too long.
    #[error("a datagram of more than {LONGEST_DATAGRAM} bytes")]
    TooLong,
    /// Bytes outside ASCII.
    #[error("a datagram that is not ASCII text; does something else send to this port?")]
    NotText,
    /// A line that cannot be read.
    #[error("a `{line}` line: expected {expected}")]
    Line {
        /// Name of the line.
        line: &'static str,
        /// Description of a correct line.
        expected: &'static str,
    },
    /// A matrix that is no rotation.
    #[error("body {body}: its matrix is no rotation")]
    Matrix {
        /// Number of the body.
        body: i32,
    },
}

/// Time at which a frame was measured.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct DtrackStamp {
    measured_s: Option<f64>,
    latency_s: Option<f64>,
}

/// Decoder of [`SampleSource::Dtrack`](crate::SampleSource::Dtrack): a datagram a sample.
#[derive(Debug, Default)]
pub struct DtrackDecoder {
    poses: Vec<TrackedPose>,
    heard: HeardSensors,
    faults: Faults,
}

impl DtrackDecoder {
    /// Poses of the datagram fed last: the bodies that were seen.
    pub fn take_poses(&mut self) -> Vec<TrackedPose> {
        std::mem::take(&mut self.poses)
    }

    /// Bodies and flysticks that the controller has sent since the socket was opened.
    pub fn heard(&self) -> &[HeardSensor] {
        self.heard.sensors()
    }

    /// Sentence for a body that is not seen, naming those that are; `None` while it is seen.
    pub fn advice(&self, _at: Nanos, _config: &HeadConfig) -> Option<String> {
        None
    }

    fn datagram(&mut self, at: Nanos, bytes: &[u8]) -> Result<(), DtrackError> {
        if bytes.len() > LONGEST_DATAGRAM {
            return Err(DtrackError::TooLong);
        }
        let text = std::str::from_utf8(bytes).ok().filter(|text| text.is_ascii()).ok_or(DtrackError::NotText)?;
        // The time may stand behind the bodies.
        let stamp = stamp(text)?;
        for body in lines(text, "6d").map(bodies) {
            for body in body? {
                match body.pose(at, stamp) {
                    Ok(pose) => self.poses.push(pose),
                    Err(error) => self.faults.count(error.to_string()),
                }
            }
        }
        Ok(())
    }
}

/// Rest of each line that begins with this name.
fn lines<'a>(text: &'a str, name: &'static str) -> impl Iterator<Item = &'a str> {
    text.split(['\r', '\n']).filter_map(move |line| line.strip_prefix(name)?.strip_prefix(' '))
}

fn stamp(text: &str) -> Result<DtrackStamp, DtrackError> {
    let bad = |line, expected| DtrackError::Line { line, expected };
    if let Some(line) = lines(text, "ts2").next() {
        let mut fields = line.split_ascii_whitespace().map(str::parse::<u32>);
        let (Some(Ok(seconds)), Some(Ok(microseconds)), Some(Ok(latency))) =
            (fields.next(), fields.next(), fields.next())
        else {
            return Err(bad("ts2", "seconds, microseconds, microseconds of latency"));
        };
        let measured_s = f64::from(seconds) + 1e-6 * f64::from(microseconds);
        return Ok(DtrackStamp { measured_s: Some(measured_s), latency_s: Some(1e-6 * f64::from(latency)) });
    }
    let Some(line) = lines(text, "ts").next() else {
        return Ok(DtrackStamp::default());
    };
    let seconds = line.trim().parse().ok().filter(|seconds: &f64| seconds.is_finite());
    let seconds = seconds.ok_or(bad("ts", "seconds since midnight"))?;
    Ok(DtrackStamp { measured_s: Some(seconds), latency_s: None })
}

/// Body in a `6d` line.
struct DtrackBody {
    id: i32,
    quality: f64,
    position_mm: DVec3,
    rotation: DMat3,
}

impl DtrackBody {
    fn pose(&self, at: Nanos, stamp: DtrackStamp) -> Result<TrackedPose, DtrackError> {
        let error = self.rotation.transpose() * self.rotation - DMat3::IDENTITY;
        let largest = error.to_cols_array().into_iter().map(f64::abs).fold(0.0, f64::max);
        if largest.is_nan() || largest > ORTHONORMAL || self.rotation.determinant() < 0.0 {
            return Err(DtrackError::Matrix { body: self.id });
        }
        Ok(TrackedPose {
            sensor: self.id,
            at,
            measured_s: stamp.measured_s,
            latency_s: stamp.latency_s,
            position_m: self.position_mm / 1000.0,
            orientation: DQuat::from_mat3(&self.rotation).normalize(),
            velocity_m_s: None,
        })
    }
}

/// Bodies of a `6d` line that were seen.
fn bodies(line: &str) -> Result<Vec<DtrackBody>, DtrackError> {
    const BAD: DtrackError =
        DtrackError::Line { line: "6d", expected: "a number of bodies and as many [id quality][6 numbers][9 numbers]" };
    let (count, mut rest) = line.trim().split_once(' ').unwrap_or((line.trim(), ""));
    let count: usize = count.parse().map_err(|_| BAD)?;
    let mut bodies = Vec::new();
    let mut found = 0;
    while !rest.trim_start().is_empty() {
        let (id, quality) = block(&mut rest).and_then(|text| text.split_once(' ')).ok_or(BAD)?;
        let id = id.parse().map_err(|_| BAD)?;
        let quality = quality.trim().parse().map_err(|_| BAD)?;
        let [x, y, z, ..] = block(&mut rest).and_then(numbers::<6>).ok_or(BAD)?;
        let rotation = block(&mut rest).and_then(numbers::<9>).ok_or(BAD)?;
        found += 1;
        let rotation = DMat3::from_cols_array(&rotation);
        let body = DtrackBody { id, quality, position_mm: DVec3::new(x, y, z), rotation };
        if body.quality >= 0.0 {
            bodies.push(body);
        }
    }
    if found == count { Ok(bodies) } else { Err(BAD) }
}

/// Text between the next pair of brackets, which must come at once.
fn block<'a>(rest: &mut &'a str) -> Option<&'a str> {
    let (block, behind) = rest.trim_start().strip_prefix('[')?.split_once(']')?;
    *rest = behind;
    Some(block.trim())
}

/// Exactly `N` finite numbers.
fn numbers<const N: usize>(text: &str) -> Option<[f64; N]> {
    let mut numbers = [0.0; N];
    let mut fields = text.split_ascii_whitespace();
    for number in &mut numbers {
        *number = fields.next()?.parse().ok().filter(|number: &f64| number.is_finite())?;
    }
    fields.next().is_none().then_some(numbers)
}

impl Decoder for DtrackDecoder {
    fn reset(&mut self, _at: Nanos) {}

    fn bytes(&mut self, at: Nanos, bytes: &[u8], _actions: &mut Actions) {
        if let Err(error) = self.datagram(at, bytes) {
            self.faults.count(error.to_string());
        }
    }

    fn faults(&self) -> &Faults {
        &self.faults
    }
}

#[cfg(test)]
mod tests {
    //! A frame as ART's controllers send it must give the poses that the stock VRPN server made of it; a transposed
    //! matrix would turn the head the other way. A line that cannot be read is skipped whole.
    use super::*;

    /// Frame that gave position 0.1 0.2 0.3 and quaternion 0 0 0.258819 0.965926 in the stock server.
    const FRAME: &str = concat!(
        "fr 21753\r\nts2 1795325065 643615 4200\r\n6dcal 2\r\n",
        "6d 1 [0 1.000][100.000 200.000 300.000 0.0 0.0 30.0]",
        "[0.866025 0.500000 0.000000 -0.500000 0.866025 0.000000 0.000000 0.000000 1.000000]\r\n",
        "6df2 0 0 \r\n3d 1 [1 1.000][210.730 -90.669 -108.554]\r\n",
    );
    /// Tolerance of six printed decimals.
    const PRINTED: f64 = 1e-6;

    fn decode(datagram: &[u8]) -> (Vec<TrackedPose>, u64) {
        let mut decoder = DtrackDecoder::default();
        decoder.bytes(7, datagram, &mut Actions::default());
        (decoder.take_poses(), decoder.faults().number())
    }

    #[test]
    fn a_frame_gives_what_the_stock_server_made_of_it() {
        let (poses, faults) = decode(FRAME.as_bytes());
        assert_eq!((poses.len(), faults), (1, 0));
        let pose = &poses[0];
        assert_eq!((pose.sensor, pose.at), (0, 7));
        assert_eq!((pose.measured_s, pose.latency_s), (Some(1_795_325_065.643_615), Some(0.0042)));
        assert_eq!(pose.position_m, DVec3::new(0.1, 0.2, 0.3));
        let expected = DQuat::from_xyzw(0.0, 0.0, 0.258_819, 0.965_926);
        assert!(pose.orientation.abs_diff_eq(expected, PRINTED), "{}", pose.orientation);
    }

    #[test]
    fn older_controllers_stamp_seconds_of_the_day_and_the_oldest_nothing() {
        let (poses, _) = decode(FRAME.replace("ts2 1795325065 643615 4200", "ts 39596.024831").as_bytes());
        assert_eq!((poses[0].measured_s, poses[0].latency_s), (Some(39_596.024_831), None));
        let (poses, faults) = decode(FRAME.replace("ts2 1795325065 643615 4200\r\n", "").as_bytes());
        assert_eq!((poses[0].measured_s, poses[0].latency_s, faults), (None, None, 0));
    }

    #[test]
    fn bodies_that_are_not_seen_are_not_given() {
        assert_eq!(decode(b"fr 1\r\n6dcal 2\r\n6d 0 \r\n"), (vec![], 0));
        assert_eq!(decode(b"fr 1\r\n6dcal 2\r\n"), (vec![], 0));
        assert_eq!(decode(FRAME.replace("[0 1.000]", "[0 -1.000]").as_bytes()), (vec![], 0));
    }

    #[test]
    fn several_bodies_come_in_their_order() {
        let (before, bodies) = FRAME.split_once("6d 1 ").unwrap();
        let (body, _) = bodies.split_once("\r\n").unwrap();
        let two = format!("{before}6d 2 {body} {}\r\n", body.replace("[0 1.000]", "[7 0.9]"));
        let sensors: Vec<i32> = decode(two.as_bytes()).0.iter().map(|pose| pose.sensor).collect();
        assert_eq!(sensors, [0, 7]);
    }

    #[test]
    fn of_a_frame_cut_anywhere_nothing_false_is_read() {
        let whole = decode(FRAME.as_bytes()).0;
        for length in 0..FRAME.len() {
            let (poses, _) = decode(&FRAME.as_bytes()[..length]);
            assert!(poses.is_empty() || poses == whole, "cut at {length}: {poses:?}");
        }
    }

    #[test]
    fn what_cannot_be_right_is_counted() {
        let bad = [
            ("6d 1 ", "6d 2 "),
            ("6d 1 ", "6d x "),
            ("[0 1.000]", "[0]"),
            ("[0 1.000]", ""),
            ("100.000", "nan"),
            ("100.000", "1e999"),
            ("0.866025 0.500000", "0.866025 0.700000"),
            ("0.000000 1.000000]", "0.000000 -1.000000]"),
            ("0.000000 1.000000]", "0.000000]"),
            ("1795325065", "-1"),
            ("fr 21753", "fr 2175\u{fc}"),
        ];
        for (good, bad) in bad {
            assert_eq!(decode(FRAME.replace(good, bad).as_bytes()), (vec![], 1), "{bad}");
        }
        assert_eq!(decode(&vec![b' '; LONGEST_DATAGRAM + 1]), (vec![], 1));
        assert_eq!(decode(&vec![b'['; LONGEST_DATAGRAM]), (vec![], 0));
        assert_eq!(decode(&[b"6d 9 ", &vec![b'['; 9000][..]].concat()), (vec![], 1));
    }
}
