//! opentrack: a UDP datagram of 48 bytes for every pose, six numbers of 64 bits, little-endian.
//!
//! | bytes | number | positive |
//! |---|---|---|
//! | 0–7, 8–15, 16–23 | x, y, z, cm | to the left, up, back from the screen |
//! | 24–31, 32–39, 40–47 | yaw, pitch, roll, degrees | to the right, up, to the left |
//!
//! These are the directions of opentrack's own trackers and games: its SteamVR input mirrors x and yaw of axes that
//! are the room's, and its FlightGear output mirrors them back. The head's turn is first roll, then pitch, then yaw.
//! A pose counts from opentrack's centre, the place and direction at which its *Center* key was pressed.
//!
//! A datagram has neither a time nor a name. opentrack repeats the last pose of a face that it has lost.
//!
//! ```
//! use input::decoder::{Actions, Decoder};
//! use input::opentrack::OpentrackDecoder;
//!
//! let mut decoder = OpentrackDecoder::default();
//! let numbers: [f64; 6] = [-10.0, 0.0, -20.0, 0.0, 0.0, 0.0]; // to the right, and closer to the screen
//! let datagram: Vec<u8> = numbers.iter().flat_map(|number| number.to_le_bytes()).collect();
//! decoder.bytes(0, &datagram, &mut Actions::default());
//! assert_eq!(decoder.take_poses()[0].position_m.to_array(), [0.1, 0.0, -0.2]);
//! ```

use glam::{DQuat, DVec3};
use thiserror::Error;

use crate::clock::Nanos;
use crate::decoder::{Actions, Decoder};
use crate::faults::Faults;
use crate::head::flip::FlipAxis;
use crate::head::heard::{HeardKind, HeardSensor, HeardSensors};
use crate::head::tracked_pose::TrackedPose;

/// Usual port of opentrack's output "UDP over network".
pub const PORT: u16 = 4242;
/// Length of a datagram, bytes.
pub const DATAGRAM_LENGTH: usize = 48;
/// Length of opentrack's unit, metres.
pub(crate) const UNIT_M: f64 = 0.01;
/// Largest coordinate, in the sender's unit, far beyond any head in any unit.
const FARTHEST: f64 = 1e6;
/// Largest angle, degrees: senders that count whole turns stay far below.
const LARGEST_ANGLE_DEG: f64 = 1e4;

/// Reason for skipping a datagram.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum OpentrackError {
    /// A datagram of another length.
    #[error(
        "a datagram of {0} bytes: opentrack sends {DATAGRAM_LENGTH}; choose its output \"UDP over network\", and send nothing else to this port"
    )]
    Length(usize),
    /// A number that no head has.
    #[error("{name} is {value}, which no head has; does something else than opentrack send to this port?")]
    Number {
        /// Name of the number.
        name: &'static str,
        /// Number that came.
        value: f64,
    },
}

/// Decoder of [`SampleSource::Opentrack`](crate::SampleSource::Opentrack): a datagram a sample.
#[derive(Debug)]
pub struct OpentrackDecoder {
    /// Signs of yaw, pitch and roll, each 1 or −1.
    signs: [f64; 3],
    poses: Vec<TrackedPose>,
    heard: HeardSensors,
    faults: Faults,
}

impl Default for OpentrackDecoder {
    /// Decoder of opentrack's own directions.
    fn default() -> Self {
        Self::new(&[])
    }
}

impl OpentrackDecoder {
    /// Decoder for a sender that counts the angles among `flipped` the other way than opentrack does.
    pub fn new(flipped: &[FlipAxis]) -> Self {
        let angles = [FlipAxis::Yaw, FlipAxis::Pitch, FlipAxis::Roll];
        let signs = angles.map(|angle| if flipped.contains(&angle) { -1.0 } else { 1.0 });
        Self { signs, poses: Vec::new(), heard: HeardSensors::default(), faults: Faults::default() }
    }

    /// Pose of the datagram fed last.
    pub fn take_poses(&mut self) -> Vec<TrackedPose> {
        std::mem::take(&mut self.poses)
    }

    /// Head that has been heard of since the socket was opened.
    pub fn heard(&self) -> &[HeardSensor] {
        self.heard.sensors()
    }

    fn pose(&self, at: Nanos, datagram: &[u8]) -> Result<TrackedPose, OpentrackError> {
        let [x, y, z, yaw, pitch, roll] = numbers(datagram)?;
        let [yaw, pitch, roll] = [(yaw, 0), (pitch, 1), (roll, 2)]
            .map(|(degrees, index)| (self.signs[index] * degrees).to_radians())
            .map(turns_less_than_once);
        let orientation = about(DVec3::Y, -yaw) * about(DVec3::X, pitch) * about(DVec3::Z, roll);
        Ok(TrackedPose {
            sensor: 0,
            at,
            measured_s: None,
            latency_s: None,
            position_m: DVec3::new(-x, y, z) * UNIT_M,
            orientation: orientation.normalize(),
            velocity_m_s: None,
        })
    }
}

/// Numbers of a datagram, as they were sent.
fn numbers(datagram: &[u8]) -> Result<[f64; 6], OpentrackError> {
    const NAMES: [&str; 6] = ["x", "y", "z", "yaw", "pitch", "roll"];
    let bytes: &[u8; DATAGRAM_LENGTH] = datagram.try_into().map_err(|_| OpentrackError::Length(datagram.len()))?;
    let mut numbers = [0.0; 6];
    for (number, (bytes, name)) in numbers.iter_mut().zip(bytes.as_chunks::<8>().0.iter().zip(NAMES)) {
        let value = f64::from_le_bytes(*bytes);
        let largest = if name.len() == 1 { FARTHEST } else { LARGEST_ANGLE_DEG };
        if !(-largest..=largest).contains(&value) {
            return Err(OpentrackError::Number { name, value });
        }
        *number = value;
    }
    Ok(numbers)
}

/// Angle less whole turns, radians.
fn turns_less_than_once(angle: f64) -> f64 {
    angle % std::f64::consts::TAU
}

/// Turn about an axis, radians, right-handed. Its sine and cosine are the same on every machine.
fn about(axis: DVec3, angle: f64) -> DQuat {
    let (sine, cosine) = libm::sincos(0.5 * angle);
    let [x, y, z] = (axis * sine).to_array();
    DQuat::from_xyzw(x, y, z, cosine)
}

impl Decoder for OpentrackDecoder {
    fn reset(&mut self, _at: Nanos) {
        self.heard.forget();
    }

    fn bytes(&mut self, at: Nanos, bytes: &[u8], _actions: &mut Actions) {
        match self.pose(at, bytes) {
            Ok(pose) => {
                if let Some(heard) = self.heard.report(at, HeardKind::Sensor, "opentrack", pose.sensor) {
                    heard.see(at, Some((pose.position_m, pose.orientation)));
                }
                self.poses.push(pose);
            }
            Err(error) => self.faults.count(error.to_string()),
        }
    }

    fn faults(&self) -> &Faults {
        &self.faults
    }
}

#[cfg(test)]
mod tests {
    //! Law: each of the six numbers moves or turns the head in opentrack's own direction, by the right amount; a
    //! mirrored axis would move the picture against the head. What is no pose is counted with a reason.
    use super::*;

    /// Rounding of three turns one after the other.
    const ROUNDING: f64 = 1e-14;

    fn datagram(numbers: [f64; 6]) -> Vec<u8> {
        numbers.iter().flat_map(|number| number.to_le_bytes()).collect()
    }

    fn decode(decoder: &mut OpentrackDecoder, bytes: &[u8]) -> Option<TrackedPose> {
        decoder.bytes(7, bytes, &mut Actions::default());
        decoder.take_poses().pop()
    }

    fn pose(numbers: [f64; 6]) -> TrackedPose {
        decode(&mut OpentrackDecoder::default(), &datagram(numbers)).unwrap()
    }

    #[test]
    fn x_is_to_the_left_y_up_and_z_back_in_centimetres() {
        let pose = pose([-10.0, 20.0, 30.0, 0.0, 0.0, 0.0]);
        assert_eq!(pose.position_m, DVec3::new(10.0, 20.0, 30.0) * 0.01);
        assert_eq!((pose.orientation, pose.at, pose.sensor), (DQuat::IDENTITY, 7, 0));
    }

    #[test]
    fn yaw_is_to_the_right_pitch_up_and_roll_to_the_left() {
        for (angles, direction, expected) in [
            ([90.0, 0.0, 0.0], DVec3::NEG_Z, DVec3::X),
            ([0.0, 90.0, 0.0], DVec3::NEG_Z, DVec3::Y),
            ([0.0, 0.0, 90.0], DVec3::Y, DVec3::NEG_X),
            // Yaw comes last: the head that looks up by 45° and turns to the right looks to the right and up.
            ([90.0, 45.0, 0.0], DVec3::NEG_Z, DVec3::new(0.5, 0.5, 0.0) * 2_f64.sqrt()),
            // Roll comes first: the crown of a head that lies on its left side points to the left, wherever it looks.
            ([90.0, 0.0, 90.0], DVec3::Y, DVec3::NEG_Z),
            ([450.0, 0.0, 0.0], DVec3::NEG_Z, DVec3::X),
        ] {
            let [yaw, pitch, roll] = angles;
            let seen = pose([0.0, 0.0, 0.0, yaw, pitch, roll]).orientation * direction;
            assert!((seen - expected).length() < ROUNDING, "{angles:?}: {seen} for {expected}");
        }
    }

    #[test]
    fn an_angle_that_is_flipped_turns_the_other_way_alone() {
        let angles = [[30.0, 0.0, 0.0], [0.0, 30.0, 0.0], [0.0, 0.0, 30.0]];
        for (number, flip) in [FlipAxis::Yaw, FlipAxis::Pitch, FlipAxis::Roll].into_iter().enumerate() {
            for (other, [yaw, pitch, roll]) in angles.into_iter().enumerate() {
                let bytes = datagram([1.0, 2.0, 3.0, yaw, pitch, roll]);
                let [plain, flipped] =
                    [&[][..], &[flip]].map(|flips| decode(&mut OpentrackDecoder::new(flips), &bytes).unwrap());
                let expected = if number == other { plain.orientation.conjugate() } else { plain.orientation };
                assert_eq!((flipped.orientation, flipped.position_m), (expected, plain.position_m));
            }
        }
    }

    #[test]
    fn what_is_no_pose_is_counted_with_a_reason() {
        let good = datagram([0.0; 6]);
        let number = |index: usize, value: f64| {
            let mut numbers = [0.0; 6];
            numbers[index] = value;
            datagram(numbers)
        };
        for (bytes, reason) in [
            (good[..47].to_vec(), "a datagram of 47 bytes: opentrack sends 48"),
            ([&good[..], &[0]].concat(), "a datagram of 49 bytes"),
            (b"6d 1".to_vec(), "a datagram of 4 bytes"),
            (number(0, f64::NAN), "x is NaN"),
            (number(2, f64::INFINITY), "z is inf"),
            (number(1, 1e300), "y is 1"),
            (number(3, -1e5), "yaw is -100000"),
            (number(5, f64::NEG_INFINITY), "roll is -inf"),
            // Six numbers in the order of other machines.
            (good.iter().enumerate().map(|(n, _)| if n % 8 == 0 { 0x7f } else { 0xf0 }).collect(), "which no head has"),
        ] {
            let mut decoder = OpentrackDecoder::default();
            assert_eq!(decode(&mut decoder, &bytes), None);
            let told = decoder.faults().last().unwrap();
            assert!(decoder.faults().number() == 1 && told.contains(reason), "{told} for {reason}");
            assert!(decode(&mut decoder, &good).is_some());
        }
    }
}
