//! Decoder of a VRPN server's stream: the poses of one device, the wand's poses, buttons and axes, and a list of all
//! that the server sends.

use glam::DVec3;

use super::numbers::VrpnNumbers;
use super::payload::{button, buttons, channels, pose, velocity};
use super::types::{BUTTON, BUTTONS, CHANNELS, POSE, VELOCITY};
use super::wire::{VrpnMessage, VrpnPiece, VrpnPieces};
use crate::clock::{Nanos, seconds_between};
use crate::decoder::{Actions, Decoder};
use crate::faults::Faults;
use crate::head::config::HeadConfig;
use crate::head::heard::{HeardKind, HeardSensor, HeardSensors, enumerated};
use crate::head::tracked_pose::TrackedPose;
use crate::wand::config::{WandConfig, WandDevices};
use crate::wand::signal::WandSignal;

/// Number of sensors whose velocities are remembered.
const MOST_SENSORS: usize = 64;
/// Time in which a device answers a ping, seconds, as in VRPN itself.
const ANSWER_S: f64 = 3.0;

/// Decoder of [`SampleSource::Vrpn`](crate::SampleSource::Vrpn): the server's side of a direct connection.
#[derive(Debug)]
pub struct VrpnDecoder {
    pieces: VrpnPieces,
    numbers: VrpnNumbers,
    /// Device of the head.
    device: String,
    wand: Option<WandDevices>,
    velocities: Vec<(i32, DVec3)>,
    poses: Vec<TrackedPose>,
    wand_signals: Vec<WandSignal>,
    heard: HeardSensors,
    /// Time of the connection's first bytes.
    opened_at: Option<Nanos>,
    faults: Faults,
}

impl VrpnDecoder {
    /// Decoder for this device of the server.
    pub fn new(device: &str) -> Self {
        Self::with_wand(device, None)
    }

    /// Decoder for this device of the server, and for those of a wand.
    pub fn with_wand(device: &str, wand: Option<&WandConfig>) -> Self {
        let wand = wand.map(|wand| wand.devices(device));
        let others = wand.iter().flat_map(|wand| [&wand.pose, &wand.buttons, &wand.axes]).map(String::as_str);
        Self {
            pieces: VrpnPieces::default(),
            numbers: VrpnNumbers::of_devices([device].into_iter().chain(others)),
            device: device.to_owned(),
            wand,
            velocities: Vec::new(),
            poses: Vec::new(),
            wand_signals: Vec::new(),
            heard: HeardSensors::default(),
            opened_at: None,
            faults: Faults::default(),
        }
    }

    /// Descriptions by the server.
    pub fn numbers(&self) -> &VrpnNumbers {
        &self.numbers
    }

    /// Sensors, buttons and axes of all devices that the server has sent since the connection was opened.
    pub fn heard(&self) -> &[HeardSensor] {
        self.heard.sensors()
    }

    /// Poses of the bytes fed last, in their order.
    pub fn take_poses(&mut self) -> Vec<TrackedPose> {
        std::mem::take(&mut self.poses)
    }

    /// Signals of the wand in the bytes fed last, in their order.
    pub fn take_wand_signals(&mut self) -> Vec<WandSignal> {
        std::mem::take(&mut self.wand_signals)
    }

    /// Sentence for a device or a sensor that the server does not have, naming what it has; `None` while all is well,
    /// and in the first seconds of a connection.
    pub fn advice(&self, at: Nanos, config: &HeadConfig) -> Option<String> {
        if seconds_between(self.opened_at?, at) < ANSWER_S {
            return None;
        }
        let missing: Vec<String> = self.numbers.missing().map(|name| format!("{name:?}")).collect();
        let fault = if missing.is_empty() {
            let head = Some((self.device.as_str(), config.sensor));
            let wand = self.wand.as_ref().zip(config.wand.as_ref());
            let wand = wand.map(|(devices, wand)| (devices.pose.as_str(), wand.sensor));
            let comes = |device: &str, sensor| {
                let known = |heard: &HeardSensor| heard.is(HeardKind::Sensor, device, sensor);
                self.heard.sensors().iter().any(known)
            };
            let (device, sensor) = head.into_iter().chain(wand).find(|(device, sensor)| !comes(device, *sensor))?;
            format!("no pose comes from sensor {sensor} of {device}")
        } else {
            let devices = if missing.len() == 1 { "device" } else { "devices" };
            format!("the server has no {devices} {}: a ping is not answered", enumerated(&missing))
        };
        let names: Vec<String> = self.heard.sensors().iter().map(HeardSensor::to_string).collect();
        let names = if names.is_empty() { "nothing".to_owned() } else { enumerated(&names) };
        Some(format!("{fault}; the server sends {names}"))
    }

    fn forget(&mut self) {
        self.numbers.forget();
        self.velocities.clear();
        self.heard.forget();
        self.opened_at = None;
    }

    fn message(&mut self, at: Nanos, message: &VrpnMessage<'_>) {
        match self.numbers.describe(message) {
            Ok(true) => return,
            Ok(false) => {}
            Err(error) => return self.faults.count(error.to_string()),
        }
        let (Some(kind), Some(device)) = (self.numbers.kind(message), self.numbers.sender(message)) else {
            return;
        };
        let is_head = device == self.device;
        let wand = self.wand.as_ref();
        let is_sound = match kind {
            POSE => pose(at, message).map(|pose| {
                hear_pose(&mut self.heard, device, &pose);
                if wand.is_some_and(|wand| wand.pose == device) {
                    self.wand_signals.push(WandSignal::Pose(pose));
                }
                if is_head {
                    let velocity = self.velocities.iter().find(|(sensor, _)| *sensor == pose.sensor);
                    self.poses.push(TrackedPose { velocity_m_s: velocity.map(|(_, velocity)| *velocity), ..pose });
                }
            }),
            VELOCITY => velocity(message).map(|(sensor, velocity)| {
                if is_head {
                    remember(&mut self.velocities, sensor, velocity);
                }
            }),
            BUTTON => button(message).map(|(button, held)| {
                if let Some(heard) = self.heard.report(at, HeardKind::Buttons, device, 0) {
                    heard.buttons.get_or_insert_default().set(button, held);
                }
                if wand.is_some_and(|wand| wand.buttons == device) {
                    self.wand_signals.push(WandSignal::Button { button, held });
                }
            }),
            BUTTONS => buttons(message).map(|buttons| {
                if let Some(heard) = self.heard.report(at, HeardKind::Buttons, device, 0) {
                    heard.buttons = Some(buttons);
                }
                if wand.is_some_and(|wand| wand.buttons == device) {
                    self.wand_signals.push(WandSignal::Buttons(buttons));
                }
            }),
            CHANNELS => channels(message).map(|axes| {
                if let Some(heard) = self.heard.report(at, HeardKind::Axes, device, 0) {
                    heard.axes.clone_from(&axes);
                }
                if wand.is_some_and(|wand| wand.axes == device) {
                    self.wand_signals.push(WandSignal::Axes(axes));
                }
            }),
            _ => Some(()),
        };
        // Of devices that nobody listens to, nothing is a fault.
        if is_sound.is_none() && self.numbers.is_listened(message) {
            let what = format!("a `{kind}` of {device} of {} bytes", message.payload.len());
            self.faults.count(what);
        }
    }
}

/// Lists a pose. The zero pose and numbers that are no pose are those of a sensor that is not seen.
fn hear_pose(heard: &mut HeardSensors, device: &str, pose: &TrackedPose) {
    let Some(heard) = heard.report(pose.at, HeardKind::Sensor, device, pose.sensor) else {
        return;
    };
    let is_zero = pose.position_m == DVec3::ZERO && pose.orientation.xyz() == DVec3::ZERO;
    let is_seen = !is_zero && pose.position_m.is_finite() && pose.orientation.is_finite();
    heard.see(pose.at, is_seen.then_some((pose.position_m, pose.orientation)));
}

fn remember(velocities: &mut Vec<(i32, DVec3)>, sensor: i32, velocity: DVec3) {
    if let Some((_, known)) = velocities.iter_mut().find(|(known, _)| *known == sensor) {
        *known = velocity;
    } else if velocities.len() < MOST_SENSORS {
        velocities.push((sensor, velocity));
    }
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
        self.opened_at.get_or_insert(at);
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
    use crate::vrpn::payload::VELOCITY_LENGTH;
    use crate::vrpn::types::PONG;
    use crate::vrpn::wire::{DESCRIBES_SENDER, DESCRIBES_TYPE, description};
    use crate::wand::held_buttons::HeldButtons;
    use glam::DQuat;

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
    fn a_name_that_gets_another_number_leaves_the_old_one_to_nobody() {
        let (mut decoder, mut actions) = (VrpnDecoder::new("Head"), Actions::default());
        decoder.bytes(0, &golden::session(), &mut actions);
        assert_eq!(decoder.take_poses().len(), 1);
        decoder.bytes(0, &description(DESCRIBES_SENDER, 9, "Head"), &mut actions);
        decoder.bytes(0, &golden::bytes(golden::IDENTITY), &mut actions);
        assert_eq!(decoder.take_poses(), []);
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

    fn message(sender: i32, kind: i32, payload: &[u8]) -> Vec<u8> {
        VrpnMessage { seconds: 0, microseconds: 0, sender, kind, payload }.to_bytes()
    }

    /// Descriptions of the sender 7 "Wand" and the types 10 to 13: buttons, their states, channels, the pong.
    fn wand_descriptions() -> Vec<u8> {
        let types = [BUTTON, BUTTONS, CHANNELS, PONG];
        let types = (10..).zip(types).map(|(number, name)| description(DESCRIBES_TYPE, number, name));
        [description(DESCRIBES_SENDER, 7, "Wand"), types.collect::<Vec<_>>().concat()].concat()
    }

    #[test]
    fn a_wands_signals_come_from_its_devices_alone() {
        let config = WandConfig { buttons: Some("Wand".to_owned()), ..Default::default() };
        let (mut decoder, mut actions) = (VrpnDecoder::with_wand("Head", Some(&config)), Actions::default());
        let mut stream = [golden::session(), wand_descriptions()].concat();
        for sender in [7, 1] {
            stream.extend(message(sender, 10, &[0, 0, 0, 2, 0, 0, 0, 1]));
            stream.extend(message(sender, 11, &[0, 0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 1]));
            stream.extend(message(sender, 12, &[2.0, 0.25, -1.0].map(f64::to_be_bytes).concat()));
        }
        decoder.bytes(SECOND, &stream, &mut actions);
        let mut seen = decoder.take_wand_signals();
        assert_eq!(seen.remove(0), WandSignal::Pose(identity()));
        let expected = [
            WandSignal::Button { button: 2, held: true },
            WandSignal::Buttons(HeldButtons(0b10)),
            WandSignal::Axes(vec![0.25, -1.0]),
        ];
        assert_eq!(seen, expected);
        // The listing names all of them.
        let names: Vec<String> = decoder.heard().iter().map(HeardSensor::to_string).collect();
        let expected = ["sensor 0 of Head", "sensor 0 of Spin0", "buttons of Wand", "axes of Wand", "buttons of Head"];
        assert_eq!(names[..5], expected);
        assert_eq!(decoder.heard()[2].buttons, Some(HeldButtons(0b10)));
        assert_eq!(decoder.heard()[3].axes, [0.25, -1.0]);
        assert_eq!((decoder.heard()[2].count, decoder.faults().number()), (2, 0));
    }

    #[test]
    fn only_an_answer_proves_a_device() {
        let config = |name: &str| HeadConfig::new(format!("vrpn://x/{name}").parse().unwrap());
        let (mut decoder, mut actions) = (VrpnDecoder::new("Tail"), Actions::default());
        // The stock server repeats the description that this side has made.
        let echo = description(DESCRIBES_SENDER, 9, "Tail");
        decoder.bytes(SECOND, &[golden::session(), wand_descriptions(), echo].concat(), &mut actions);
        assert_eq!(decoder.advice(3 * SECOND, &config("Tail")), None);
        let told = decoder.advice(4 * SECOND, &config("Tail")).unwrap();
        let expected = "the server has no device \"Tail\": a ping is not answered; \
                        the server sends sensor 0 of Head and sensor 0 of Spin0";
        assert_eq!(told, expected);
        // Its answer proves it; then the sensor is missing.
        decoder.bytes(5 * SECOND, &message(9, 13, &[]), &mut actions);
        let told = decoder.advice(5 * SECOND, &config("Tail")).unwrap();
        assert!(told.starts_with("no pose comes from sensor 0 of Tail; the server sends sensor 0 of Head"), "{told}");

        let mut decoder = VrpnDecoder::new("Head");
        decoder.bytes(0, &golden::session(), &mut actions);
        assert_eq!(decoder.advice(9 * SECOND, &config("Head")), None);
        let told = decoder.advice(9 * SECOND, &HeadConfig { sensor: 4, ..config("Head") }).unwrap();
        assert!(told.starts_with("no pose comes from sensor 4 of Head; "), "{told}");
        // A new connection is given time.
        decoder.reset(10 * SECOND);
        assert_eq!(decoder.advice(11 * SECOND, &config("Head")), None);
        assert_eq!(decoder.heard(), []);
    }

    #[test]
    fn the_reason_of_the_last_bad_message_is_kept() {
        let (mut decoder, mut actions) = (VrpnDecoder::new("Head"), Actions::default());
        decoder.bytes(0, &[golden::session(), message(1, 4, &[0; 9])].concat(), &mut actions);
        let expected = "a `vrpn_Tracker Pos_Quat` of Head of 9 bytes";
        assert_eq!((decoder.faults().number(), decoder.faults().last()), (1, Some(expected)));
        // What other devices say wrong is none of a rider's business.
        decoder.bytes(0, &message(2, 4, &[0; 9]), &mut actions);
        assert_eq!(decoder.faults().number(), 1);
        decoder.bytes(0, &[0xff; 24], &mut actions);
        let expected = "a message of 4294967295 bytes; the stream is damaged";
        assert_eq!((decoder.faults().number(), decoder.faults().last()), (2, Some(expected)));
    }

    #[test]
    fn a_pose_that_is_none_is_heard_as_unseen() {
        let (mut decoder, mut actions) = (VrpnDecoder::new("Head"), Actions::default());
        decoder.bytes(0, &golden::session(), &mut actions);
        let [zero, turned] = decoder.heard() else { panic!("{:?}", decoder.heard()) };
        assert_eq!((zero.is_tracked(0), zero.pose), (false, None));
        assert!(turned.is_tracked(0) && turned.pose.is_some());
    }

    #[test]
    fn a_stream_with_any_byte_changed_harms_nothing_but_itself() {
        let config = WandConfig { buttons: Some("Wand".to_owned()), ..Default::default() };
        let button = message(7, 10, &[0, 0, 0, 2, 0, 0, 0, 1]);
        let channels = message(7, 12, &[2.0, 0.25, -1.0].map(f64::to_be_bytes).concat());
        let stream = [golden::session(), wand_descriptions(), button, channels].concat();
        for at in 0..stream.len() {
            for byte in [0, 1, 0x7f, 0x80, 0xff] {
                let (mut decoder, mut actions) = (VrpnDecoder::with_wand("Head", Some(&config)), Actions::default());
                let mut changed = stream.clone();
                changed[at] = byte;
                decoder.bytes(0, &changed, &mut actions);
                assert!(decoder.take_poses().len() <= 3 && decoder.take_wand_signals().len() <= 5);
                // The next connection is as good as ever.
                decoder.reset(0);
                decoder.bytes(0, &stream, &mut actions);
                assert_eq!((decoder.take_poses().len(), decoder.take_wand_signals().len()), (1, 3), "{byte} at {at}");
            }
        }
    }
}
