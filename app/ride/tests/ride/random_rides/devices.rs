//! Devices gone mad: plausible bytes of every device, damaged ones, and bytes of no sense.

use glam::{DQuat, EulerRot};
use input::dtrack::LONGEST_DATAGRAM;
use input::gamepad::GamepadItem;
use input::openxr::{XrHand, XrPose, XrReport};
use input::trainer::wire as trainer;
use input::vrpn::wire as vrpn;
use input::{KeyboardKey, MouseButton, MouseEvent, Nanos, Sample, SampleSource};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

/// Numbers with which a device lies.
const LIES: [f64; 12] =
    [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 0.0, -0.0, -1.0, 1e-300, 1e300, -1e12, 4_294_967_295.0, 0.5, 1e9];

/// Texts of actions, sound and unsound, as the program's own interface and a hostile one would send them.
const ACTIONS: [&str; 24] = [
    "\"toggle_pause\"",
    "\"step\"",
    "\"restart\"",
    "\"look_ahead\"",
    "\"recentre\"",
    "\"photo\"",
    "\"toggle_recording\"",
    "\"toggle_help\"",
    "{\"vehicle\":\"bicycle\"}",
    "{\"vehicle\":\"drive\"}",
    "{\"vehicle\":\"fly\"}",
    "{\"time_scale\":1}",
    "{\"time_scale\":0}",
    "{\"time_scale\":2}",
    "{\"time_scale\":1e400}",
    "{\"time_scale\":-1}",
    "{\"scale_time\":0.5}",
    "{\"scale_time\":1e-300}",
    "{\"speed_of_light\":1}",
    "{\"speed_of_light\":27.8}",
    "{\"speed_of_light\":299792458}",
    "{\"speed_of_light\":0.8}",
    "{\"speed_of_light\":1e300}",
    "{\"vehicle\":7}",
];

/// Rider's devices in the hands of chance.
pub struct MadDevices<'a> {
    /// Source of chance.
    pub random: &'a mut ChaCha8Rng,
    /// True if actions may change the vehicle.
    pub changes_vehicle: bool,
}

impl MadDevices<'_> {
    /// Samples of all devices at the real time `at`.
    pub fn samples(&mut self, at: Nanos) -> Vec<Sample> {
        let number = self.random.random_range(0..6);
        (0..number).map(|_| self.sample(at)).collect()
    }

    fn sample(&mut self, at: Nanos) -> Sample {
        let source = SampleSource::ALL[self.below(SampleSource::ALL.len())];
        match self.below(24) {
            0 => return Sample::opened(at, source),
            1 => return Sample::closed(at, source),
            _ => {}
        }
        let mut bytes = match self.below(8) {
            0 => (0..self.below(64)).map(|_| self.random.random()).collect(),
            _ => self.plausible(source, at),
        };
        if self.below(12) == 0 {
            self.damage(&mut bytes);
        }
        if !self.changes_vehicle && changes_vehicle(source, &bytes) {
            bytes.clear();
        }
        Sample::bytes(at, source, bytes)
    }

    fn below(&mut self, end: usize) -> usize {
        self.random.random_range(0..end)
    }

    /// Number of usual size, or a lie.
    fn number(&mut self, size: f64) -> f64 {
        if self.below(16) == 0 { LIES[self.below(LIES.len())] } else { self.random.random_range(-size..size) }
    }

    fn whole(&mut self, size: i32) -> i32 {
        if self.below(16) == 0 { self.random.random() } else { self.random.random_range(-size..=size) }
    }

    fn damage(&mut self, bytes: &mut Vec<u8>) {
        for _ in 0..1 + self.below(4) {
            let length = bytes.len();
            match self.below(3) {
                _ if length == 0 => bytes.push(self.random.random()),
                0 => bytes.truncate(self.random.random_range(0..length)),
                1 => bytes.push(self.random.random()),
                _ => bytes[self.random.random_range(0..length)] = self.random.random(),
            }
        }
    }

    /// Bytes as a sound device sends them, with a lie now and then.
    fn plausible(&mut self, source: SampleSource, at: Nanos) -> Vec<u8> {
        match source {
            SampleSource::Keyboard => self.keys(),
            SampleSource::Gamepad => self.gamepad(),
            SampleSource::SpaceMouse => self.space_mouse(),
            SampleSource::Spacenavd => self.spacenavd(),
            SampleSource::Bicycle => self.bicycle(at),
            SampleSource::Trainer => self.trainer(),
            SampleSource::Vrpn => self.vrpn(at),
            SampleSource::Dtrack => self.dtrack(at),
            SampleSource::Opentrack => (0..6).flat_map(|_| self.number(60.0).to_le_bytes()).collect(),
            SampleSource::Openxr => self.headset().to_bytes(),
            SampleSource::Mouse => self.mouse(),
            SampleSource::Settings => ACTIONS[self.below(ACTIONS.len())].as_bytes().to_vec(),
        }
    }

    fn headset(&mut self) -> XrReport {
        let poses = [self.headset_pose(), self.headset_pose(), self.headset_pose()];
        let hands = [poses[1], poses[2]].map(|pose| XrHand {
            pose,
            buttons: if self.below(4) == 0 { self.below(16) as u32 } else { 0 },
            axes: [0; 4].map(|_| self.number(1.0) as f32),
        });
        let stage_moves = u8::from(self.random.random_bool(0.05));
        XrReport { time_ns: self.random.random_range(0..1 << 40), head: poses[0], hands, stage_moves }
    }

    fn headset_pose(&mut self) -> XrPose {
        let [place, moves, turns] = [2.0, 3.0, 6.0].map(|size| [0; 3].map(|_| self.number(size) as f32));
        let turn = DQuat::from_euler(EulerRot::YXZ, self.number(3.0), self.number(1.5), self.number(0.5));
        let [turned, placed, moved, turning] = [0; 4].map(|_| self.below(8) > 0);
        XrPose {
            position_m: placed.then_some(place),
            orientation: turned.then_some(turn.to_array().map(|part| part as f32)),
            velocity_m_s: moved.then_some(moves),
            turning_rad_s: turning.then_some(turns),
        }
    }

    fn keys(&mut self) -> Vec<u8> {
        let mut bytes = Vec::new();
        for _ in 0..1 + self.below(3) {
            let key = KeyboardKey::ALL[self.below(KeyboardKey::ALL.len())];
            bytes.extend(key.to_bytes(self.below(3) > 0));
        }
        bytes
    }

    fn gamepad(&mut self) -> Vec<u8> {
        let mut bytes = Vec::new();
        match self.below(12) {
            0 => GamepadItem::Gamepad.encode(&mut bytes),
            1 => GamepadItem::Joystick.encode(&mut bytes),
            _ => {}
        }
        for _ in 0..1 + self.below(3) {
            let item = match self.below(3) {
                0 => GamepadItem::Axis {
                    code: self.below(18) as u16,
                    value: self.whole(32767),
                    least: self.whole(32767),
                    most: self.whole(32767),
                },
                1 => GamepadItem::Event { kind: 3, code: self.below(18) as u16, value: self.whole(32767) },
                _ => {
                    let code = if self.below(2) == 0 { 0x120 } else { 0x130 } + self.below(16) as u16;
                    GamepadItem::Event { kind: 1, code, value: self.below(3) as i32 }
                }
            };
            item.encode(&mut bytes);
        }
        bytes
    }

    fn space_mouse(&mut self) -> Vec<u8> {
        if self.below(8) == 0 {
            return vec![3, self.random.random(), 0];
        }
        let (number, axes) = [(1, 6), (1, 3), (2, 3)][self.below(3)];
        let numbers = (0..axes).flat_map(|_| (self.whole(400) as i16).to_le_bytes());
        std::iter::once(number).chain(numbers.collect::<Vec<u8>>()).collect()
    }

    fn spacenavd(&mut self) -> Vec<u8> {
        let kind = if self.below(8) == 0 { self.random.random_range(1..8) } else { 0 };
        let mut words = [kind; 8];
        words[1..7].fill_with(|| self.whole(550));
        words.iter().flat_map(|word| word.to_le_bytes()).collect()
    }

    fn bicycle(&mut self, at: Nanos) -> Vec<u8> {
        let (speed, steer, brake) = (self.number(40.0), self.number(1024.0), self.number(1024.0));
        let now_us = at / 1000 % (1 << 32);
        match self.below(4) {
            0 => format!("{speed}\n"),
            1 => format!("{},{},{steer},{brake}\n", self.below(1_000_000), self.below(1_000_000)),
            _ => {
                let (turns, ago_us) = (self.below(100), self.below(1_000_000) as u64);
                let last_us = now_us.saturating_sub(ago_us);
                let line = format!("B1,1,{now_us},{turns},{last_us},{turns},{last_us},{steer},{brake}");
                input::line::sealed(&line)
            }
        }
        .into_bytes()
    }

    fn trainer(&mut self) -> Vec<u8> {
        let characteristic = [trainer::INDOOR_BIKE_DATA, trainer::POWER_MEASUREMENT, trainer::SPEED_MEASUREMENT];
        let uuid = trainer::uuid(characteristic[self.below(3)]);
        let flags = if self.below(2) == 0 { 0x44_u16 } else { self.random.random_range(0..0x2000) };
        let value: Vec<u8> = (0..self.below(30)).map(|_| self.random.random()).collect();
        let data = [&uuid[..], &flags.to_le_bytes(), &value].concat();
        trainer::DirectConnectMessage { kind: trainer::NOTIFICATION, sequence: 0, response: 0, data: &data }.to_bytes()
    }

    fn vrpn(&mut self, at: Nanos) -> Vec<u8> {
        /// Types of message, by their numbers.
        const KINDS: [&str; 5] = [
            input::vrpn::POSE,
            input::vrpn::VELOCITY,
            input::vrpn::BUTTON,
            input::vrpn::CHANNELS,
            input::vrpn::BUTTONS,
        ];
        if self.below(4) == 0 {
            let mut bytes = vrpn::COOKIE.to_vec();
            bytes.extend(vrpn::description(vrpn::DESCRIBES_SENDER, 1, "Head"));
            for (number, name) in (1..).zip(KINDS) {
                bytes.extend(vrpn::description(vrpn::DESCRIBES_TYPE, number, name));
            }
            return bytes;
        }
        let kind = 1 + self.below(KINDS.len());
        let mut payload = [0_u8; 8].to_vec();
        payload[3] = self.below(2) as u8;
        payload[7] = self.below(2) as u8;
        match kind {
            1 => {
                (0..3).for_each(|_| payload.extend(self.number(2.0).to_be_bytes()));
                (0..4).for_each(|_| payload.extend(self.number(1.0).to_be_bytes()));
            }
            2 => (0..8).for_each(|_| payload.extend(self.number(20.0).to_be_bytes())),
            4 => {
                payload = 3.0_f64.to_be_bytes().to_vec();
                (0..3).for_each(|_| payload.extend(self.number(1.0).to_be_bytes()));
            }
            _ => {}
        }
        let (seconds, microseconds) = (1 + (at / 1_000_000_000) as u32, (at / 1000 % 1_000_000) as u32);
        vrpn::VrpnMessage { seconds, microseconds, sender: 1, kind: kind as i32, payload: &payload }.to_bytes()
    }

    fn dtrack(&mut self, at: Nanos) -> Vec<u8> {
        let mut three = || format!("[{} {} {}]", self.number(3000.0), self.number(3000.0), self.number(3000.0));
        let (body, stick) = (three(), three());
        let mut turn: Vec<f64> = vec![1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
        if self.below(2) == 0 {
            turn.fill_with(|| self.number(1.0));
        }
        let turn = turn.iter().map(f64::to_string).collect::<Vec<_>>().join(" ");
        let (held, x, y) = (self.below(256), self.number(1.0), self.number(1.0));
        let text = format!(
            "fr {}\r\nts {:.6}\r\n6d 1 [0 1.000]{body}[{turn}]\r\n6df2 1 1 [0 1.000 8 2]{stick}[{turn}][{held} {x} {y}]\r\n",
            at / 4_000_000,
            at as f64 * 1e-9
        );
        let mut bytes = text.into_bytes();
        bytes.truncate(LONGEST_DATAGRAM);
        bytes
    }

    fn mouse(&mut self) -> Vec<u8> {
        const BUTTONS: [MouseButton; 3] = [MouseButton::Left, MouseButton::Right, MouseButton::Middle];
        match self.below(5) {
            0 => MouseEvent::Button { button: BUTTONS[self.below(3)], pressed: self.below(2) == 0 },
            1 => MouseEvent::Shift(self.below(2) == 0),
            2 => MouseEvent::Wheel(self.number(3.0) as f32),
            3 if self.below(8) == 0 => MouseEvent::Reset,
            _ => MouseEvent::Moved { right: self.number(50.0) as f32, down: self.number(50.0) as f32 },
        }
        .to_bytes()
    }
}

/// True if bytes hold something that changes the vehicle.
fn changes_vehicle(source: SampleSource, bytes: &[u8]) -> bool {
    const KEYS: [KeyboardKey; 3] = [KeyboardKey::One, KeyboardKey::Two, KeyboardKey::Three];
    match source {
        SampleSource::Keyboard => bytes.iter().any(|byte| KEYS.iter().any(|key| *key as u8 == *byte)),
        SampleSource::Settings => bytes.windows(7).any(|text| text == b"vehicle"),
        _ => false,
    }
}
