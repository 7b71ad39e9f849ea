//! Decoder of a VRPN server's stream: the poses of one device.

use glam::{DQuat, DVec3};

use super::numbers::VrpnNumbers;
use super::types::{POSE, VELOCITY};
use super::wire::{VrpnMessage, VrpnPiece, VrpnPieces};
use crate::clock::Nanos;
use crate::decoder::{Actions, Decoder};
use crate::faults::Faults;
use crate::head::config::HeadConfig;
use crate::head::heard::{HeardSensor, HeardSensors};
use crate::head::tracked_pose::TrackedPose;

const POSE_LENGTH: usize = 64;
const VELOCITY_LENGTH: usize = 72;
/// Number of sensors whose velocities are remembered.
const MOST_SENSORS: usize = 64;

/// Decoder of [`SampleSource::Vrpn`](crate::SampleSource::Vrpn): the server's side of a direct connection.
#[derive(Debug)]
pub struct VrpnDecoder {
    pieces: VrpnPieces,
    numbers: VrpnNumbers,
    velocities: Vec<(i32, DVec3)>,
    poses: Vec<TrackedPose>,
    heard: HeardSensors,
    faults: Faults,
}

impl VrpnDecoder {
    /// Decoder for this device of the server.
    pub fn new(device: &str) -> Self {
        Self {
            pieces: VrpnPieces::default(),
            numbers: VrpnNumbers::new(device),
            velocities: Vec::new(),
            poses: Vec::new(),
            heard: HeardSensors::default(),
            faults: Faults::default(),
        }
    }

    /// Sensors, buttons and axes of all devices that the server has sent since the connection was opened.
    pub fn heard(&self) -> &[HeardSensor] {
        self.heard.sensors()
    }

    /// Sentence for a device that the server does not have; `None` while it sends or answers.
    pub fn advice(&self, _at: Nanos, _config: &HeadConfig) -> Option<String> {
        None
    }

    /// Descriptions by the server.
    pub fn numbers(&self) -> &VrpnNumbers {
        &self.numbers
    }

    /// Poses of the bytes fed last, in their order.
    pub fn take_poses(&mut self) -> Vec<TrackedPose> {
        std::mem::take(&mut self.poses)
    }

    fn forget(&mut self) {
        self.numbers.forget();
        self.velocities.clear();
    }

    fn message(&mut self, at: Nanos, message: &VrpnMessage<'_>) {
        match self.numbers.describe(message) {
            Ok(true) => return,
            Ok(false) => {}
            Err(error) => return self.faults.count(error.to_string()),
        }
        match self.numbers.of_device(message) {
            Some(POSE) => match pose(at, message) {
                Some(pose) => {
                    let velocity = self.velocities.iter().find(|(sensor, _)| *sensor == pose.sensor);
                    self.poses.push(TrackedPose { velocity_m_s: velocity.map(|(_, velocity)| *velocity), ..pose });
                }
                None => self.bad_length(POSE, message),
            },
            Some(VELOCITY) => match velocity(message) {
                Some((sensor, velocity)) => self.remember(sensor, velocity),
                None => self.bad_length(VELOCITY, message),
            },
            _ => {}
        }
    }

    fn remember(&mut self, sensor: i32, velocity: DVec3) {
        if let Some((_, known)) = self.velocities.iter_mut().find(|(known, _)| *known == sensor) {
            *known = velocity;
        } else if self.velocities.len() < MOST_SENSORS {
            self.velocities.push((sensor, velocity));
        }
    }

    fn bad_length(&mut self, kind: &str, message: &VrpnMessage<'_>) {
        self.faults.count(format!("a `{kind}` of {} bytes", message.payload.len()));
    }
}

/// Pose in a message; `None` if the payload has another length.
fn pose(at: Nanos, message: &VrpnMessage<'_>) -> Option<TrackedPose> {
    let payload: &[u8; POSE_LENGTH] = message.payload.try_into().ok()?;
    let [x, y, z, qx, qy, qz, qw] = numbers(&payload[8..])?;
    // A server without a clock sends a time of zero.
    let measured_s = f64::from(message.seconds) + 1e-6 * f64::from(message.microseconds);
    Some(TrackedPose {
        sensor: sensor(payload)?,
        at,
        measured_s: (measured_s > 0.0).then_some(measured_s),
        latency_s: None,
        position_m: DVec3::new(x, y, z),
        orientation: DQuat::from_xyzw(qx, qy, qz, qw),
        velocity_m_s: None,
    })
}

/// Sensor and velocity in a message, m/s; `None` if the payload has another length.
fn velocity(message: &VrpnMessage<'_>) -> Option<(i32, DVec3)> {
    let payload: &[u8; VELOCITY_LENGTH] = message.payload.try_into().ok()?;
    let velocity = DVec3::from_array(numbers(&payload[8..])?);
    Some((sensor(payload)?, velocity))
}

fn sensor(payload: &[u8]) -> Option<i32> {
    payload.first_chunk().map(|bytes| i32::from_be_bytes(*bytes))
}

/// First `N` big-endian numbers of these bytes.
fn numbers<const N: usize>(bytes: &[u8]) -> Option<[f64; N]> {
    let mut numbers = [0.0; N];
    for (number, bytes) in numbers.iter_mut().zip(bytes.as_chunks::<8>().0.get(..N)?) {
        *number = f64::from_be_bytes(*bytes);
    }
    Some(numbers)
}

impl Decoder for VrpnDecoder {
    fn reset(&mut self, _at: Nanos) {
        self.pieces.reset();
        self.forget();
    }

    fn bytes(&mut self, at: Nanos, bytes: &[u8], _actions: &mut Actions) {
        let mut pieces = std::mem::take(&mut self.pieces);
        pieces.push(bytes, |piece| match piece {
            Ok(VrpnPiece::Cookie(_)) => self.forget(),
            Ok(VrpnPiece::Message(message, _)) => self.message(at, &message),
            Err(error) => self.faults.count(error.to_string()),
        });
        self.pieces = pieces;
    }

    fn faults(&self) -> &Faults {
        &self.faults
    }
}

#[cfg(test)]
mod tests {
    //! The bytes of the stock server must give its poses, whatever numbers it has chosen and however the stream is
    //! cut; messages whose numbers have not been described must be passed over.
    use super::*;
    use crate::clock::SECOND;
    use crate::vrpn::golden;
    use crate::vrpn::numbers::MOST_SENDERS;
    use crate::vrpn::wire::{DESCRIBES_SENDER, DESCRIBES_TYPE, description};

    fn decode(device: &str, chunks: &[&[u8]]) -> (Vec<TrackedPose>, u64) {
        let (mut decoder, mut actions) = (VrpnDecoder::new(device), Actions::default());
        let mut poses = Vec::new();
        for chunk in chunks {
            decoder.bytes(SECOND, chunk, &mut actions);
            poses.extend(decoder.take_poses());
        }
        (poses, decoder.faults().number())
    }

    fn identity() -> TrackedPose {
        TrackedPose {
            sensor: 0,
            at: SECOND,
            measured_s: Some(1_795_325_065.643_615),
            latency_s: None,
            position_m: DVec3::ZERO,
            orientation: DQuat::IDENTITY,
            velocity_m_s: None,
        }
    }

    #[test]
    fn captured_bytes_give_their_poses() {
        let stream = golden::session();
        let (poses, faults) = decode("Head", &[&stream]);
        assert_eq!((poses, faults), (vec![identity()], 0));
        // A pose of Spin0 from before its description belongs to no device.
        let (poses, faults) = decode("Spin0", &[&stream]);
        assert_eq!((poses.len(), faults), (1, 0));
        let turned = DQuat::from_xyzw(0.0, 0.0, 0.977_174_116_055_616_2, 0.212_439_984_256_554_53);
        assert_eq!(poses[0].orientation, turned);
        assert_eq!(decode("Tail", &[&stream]), (vec![], 0));
    }

    #[test]
    fn poses_do_not_depend_on_the_cut() {
        let stream = golden::session();
        for cut in 0..=stream.len() {
            assert_eq!(decode("Head", &[&stream[..cut], &stream[cut..]]), (vec![identity()], 0), "cut at {cut}");
        }
    }

    #[test]
    fn numbers_are_the_servers_and_may_change() {
        let (mut decoder, mut actions) = (VrpnDecoder::new("Head"), Actions::default());
        decoder.bytes(0, &golden::session(), &mut actions);
        assert_eq!(decoder.take_poses().len(), 1);
        // Number 1 goes to another device; the next connection has its own numbers.
        decoder.bytes(0, &description(DESCRIBES_SENDER, 1, "Wand"), &mut actions);
        decoder.bytes(0, &golden::bytes(golden::IDENTITY), &mut actions);
        assert_eq!(decoder.take_poses(), []);
        decoder.bytes(0, &golden::bytes(golden::COOKIE), &mut actions);
        decoder.bytes(0, &golden::bytes(golden::IDENTITY), &mut actions);
        assert_eq!((decoder.take_poses().len(), decoder.faults().number()), (0, 0));
        assert!(!decoder.numbers().has_device());
    }

    #[test]
    fn a_new_connection_begins_anew() {
        let (mut decoder, mut actions) = (VrpnDecoder::new("Head"), Actions::default());
        let stream = golden::session();
        for half in 0..stream.len() {
            decoder.bytes(0, &stream[..half], &mut actions);
            decoder.reset(0);
            decoder.take_poses();
            // Numbers of the last connection mean nothing, and half a message shifts nothing.
            let unnamed = [golden::bytes(golden::COOKIE), golden::bytes(golden::IDENTITY)].concat();
            decoder.bytes(0, &unnamed, &mut actions);
            assert_eq!((decoder.take_poses(), decoder.faults().number()), (vec![], 0), "half {half}");
            decoder.reset(0);
        }
    }

    #[test]
    fn a_velocity_goes_with_the_poses_of_its_sensor() {
        let (mut decoder, mut actions) = (VrpnDecoder::new("Head"), Actions::default());
        let mut payload = [0; VELOCITY_LENGTH];
        payload[8..16].copy_from_slice(&1.25_f64.to_be_bytes());
        payload[64..].copy_from_slice(&golden::bytes("3ffccccccccccccd"));
        let velocity = VrpnMessage { seconds: 1, microseconds: 0, sender: 1, kind: 9, payload: &payload }.to_bytes();
        assert_eq!(velocity[..4], golden::bytes("00000060"));
        let stream =
            [golden::session(), description(DESCRIBES_TYPE, 9, VELOCITY), velocity, golden::bytes(golden::IDENTITY)];
        decoder.bytes(0, &stream.concat(), &mut actions);
        let velocities: Vec<_> = decoder.take_poses().iter().map(|pose| pose.velocity_m_s).collect();
        assert_eq!(velocities, [None, Some(DVec3::X * 1.25)]);
    }

    #[test]
    fn poses_of_a_wrong_length_are_counted() {
        for length in [0, 8, 63, 65, 72] {
            let payload = vec![0; length];
            let short = VrpnMessage { seconds: 0, microseconds: 0, sender: 1, kind: 4, payload: &payload }.to_bytes();
            let (poses, faults) = decode("Head", &[&golden::session(), &short, &golden::bytes(golden::IDENTITY)]);
            assert_eq!((poses.len(), faults), (2, 1), "{length}");
        }
    }

    #[test]
    fn a_flood_of_descriptions_costs_no_memory() {
        let (mut decoder, mut actions) = (VrpnDecoder::new("Head"), Actions::default());
        decoder.bytes(0, &golden::session(), &mut actions);
        for number in 0..100_000 {
            let bytes = description(DESCRIBES_SENDER, 10 + number, &format!("device {number}"));
            decoder.bytes(0, &bytes, &mut actions);
        }
        assert_eq!(decoder.numbers().senders().len(), MOST_SENDERS);
        decoder.take_poses();
        decoder.bytes(0, &golden::bytes(golden::IDENTITY), &mut actions);
        assert_eq!(decoder.take_poses().len(), 1);
    }
}
