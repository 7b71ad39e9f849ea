//! Decoder of the window's keys: riding, driving and flying without any device.
//!
//! A sample holds key events of two bytes each, as [`KeyboardKey::to_bytes`] writes them. Controls move to the goals
//! of the held keys on ramps, as legs and hands do.
//!
//! | keys | bicycle | drive, fly |
//! |---|---|---|
//! | W, S | pedal, push backward | thrust forward, backward |
//! | A, D | steer | thrust left, right |
//! | arrows | pedal, push backward, steer | turn the nose that way |
//! | Shift | sprint | |
//! | Space | brake | brake |
//! | R, F | | thrust up, down |
//! | Q, E | | roll left, right |
//! | J, L, I, K | look left, right, up, down | the same |
//! | M | look back | the same |
//!
//! All other keys are actions, as the function `action` lists them.

use crate::action::{Action, Setting, Switch, VehicleKind};
use crate::clock::Nanos;
use crate::decoder::{Actions, Decoder};
use crate::faults::Faults;
use crate::key::KeyboardKey;
use crate::key_map::KeyMap;
use crate::ramp::Ramp;
use crate::rider_config::RiderConfig;

/// Rate of a control whose key is pressed, full deflections a second.
const PRESS_RATE: f64 = 3.0;
/// Rate of a control whose key is released, full deflections a second.
const RELEASE_RATE: f64 = 5.0;
/// Stops by which a key changes the exposure.
const STOPS_PER_PRESS: f64 = 0.5;

/// Action of a key when pressed; `None` for keys that are held.
fn action(key: KeyboardKey) -> Option<Action> {
    Some(match key {
        KeyboardKey::P => Action::TogglePause,
        KeyboardKey::Period => Action::Step,
        KeyboardKey::Minus => Action::ScaleTime(0.5),
        KeyboardKey::Equal => Action::ScaleTime(2.0),
        KeyboardKey::One => Action::Vehicle(VehicleKind::Bicycle),
        KeyboardKey::Two => Action::Vehicle(VehicleKind::Drive),
        KeyboardKey::Three => Action::Vehicle(VehicleKind::Fly),
        KeyboardKey::Backspace => Action::Restart,
        KeyboardKey::O => Action::LookAhead,
        KeyboardKey::U => Action::Recentre,
        KeyboardKey::C => Action::Photo,
        KeyboardKey::V => Action::ToggleRecording,
        KeyboardKey::H | KeyboardKey::F1 => Action::ToggleHelp,
        KeyboardKey::G => Action::Toggle(Switch::Geometry),
        KeyboardKey::B => Action::Toggle(Switch::Doppler),
        KeyboardKey::N => Action::Toggle(Switch::Searchlight),
        KeyboardKey::T => Action::Next(Setting::Tone),
        KeyboardKey::BracketLeft => Action::Expose(-STOPS_PER_PRESS),
        KeyboardKey::BracketRight => Action::Expose(STOPS_PER_PRESS),
        KeyboardKey::X => Action::NextView,
        KeyboardKey::Y => Action::Toggle(Switch::Outside),
        KeyboardKey::Z => Action::Toggle(Switch::Diagram),
        KeyboardKey::Tab => Action::Toggle(Switch::Miniature),
        KeyboardKey::Enter => Action::Choose,
        KeyboardKey::F2 => Action::Toggle(Switch::Readings),
        KeyboardKey::F3 => Action::Toggle(Switch::Menu),
        KeyboardKey::F4 => Action::ToggleCalibration,
        KeyboardKey::F5 => Action::Toggle(Switch::Frozen),
        KeyboardKey::F6 => Action::Toggle(Switch::DiagramOfVehicle),
        KeyboardKey::F7 => Action::NextTracking,
        KeyboardKey::F8 => Action::PhotoSphere,
        KeyboardKey::F9 => Action::Next(Setting::Colouring),
        KeyboardKey::F11 => Action::ToggleFullScreen,
        KeyboardKey::Escape => Action::Leave,
        _ => return None,
    })
}

/// True for a key whose action has always been the ride's.
fn is_of_ride(key: KeyboardKey) -> bool {
    use KeyboardKey::{Backspace, C, Equal, F1, H, Minus, O, One, P, Period, Three, Two, U, V};
    [P, Period, Minus, Equal, One, Two, Three, Backspace, O, U, C, V, H, F1].contains(&key)
}

/// True for the number of a key that turns the look or the head and nothing else.
fn looks(code: u8) -> bool {
    use KeyboardKey::{I, J, K, L, M, O, U};
    [I, J, K, L, M, O, U].iter().any(|&key| key as u8 == code)
}

/// Keys that are down.
#[derive(Clone, Copy, Debug)]
struct HeldKeys([bool; 256]);

impl HeldKeys {
    fn any(&self, keys: &[KeyboardKey]) -> bool {
        keys.iter().any(|&key| self.0[usize::from(key as u8)])
    }

    /// Direction of a pair of opposite keys: −1, 0 or 1.
    fn between(&self, negative: &[KeyboardKey], positive: &[KeyboardKey]) -> f64 {
        f64::from(i8::from(self.any(positive)) - i8::from(self.any(negative)))
    }
}

/// Decoder of [`SampleSource::Keyboard`](crate::SampleSource::Keyboard).
#[derive(Debug)]
pub struct KeyboardDecoder {
    rider: RiderConfig,
    /// Key whose work each key does, by their numbers.
    works: [u8; 256],
    /// Keys that do no key's work: their numbers, their actions, and true while they are held.
    actions: Vec<(u8, Action, bool)>,
    /// True if keys that change the picture alone act, too.
    all_keys_act: bool,
    held: HeldKeys,
    pedalled: bool,
    wheel: Ramp,
    steer: Ramp,
    brake: Ramp,
    thrust: [Ramp; 3],
    turn: [Ramp; 3],
    faults: Faults,
}

impl KeyboardDecoder {
    /// Keyboard without a pressed key.
    ///
    /// `all_keys_act`: false as in rides in which the window itself carried out the keys that change the picture alone.
    pub fn new(rider: RiderConfig, keys: &KeyMap, all_keys_act: bool) -> Self {
        Self {
            rider,
            works: keys.works(),
            actions: keys.actions().into_iter().map(|(key, action)| (key, action, false)).collect(),
            all_keys_act,
            held: HeldKeys([false; 256]),
            pedalled: false,
            wheel: Ramp::default(),
            steer: Ramp::default(),
            brake: Ramp::default(),
            thrust: [Ramp::default(); 3],
            turn: [Ramp::default(); 3],
            faults: Faults::default(),
        }
    }

    /// Speed that the keys pedal, m/s; `None` before the first pedalling.
    pub fn wheel_speed(&self, at: Nanos) -> Option<f64> {
        self.pedalled.then(|| self.wheel.value(at))
    }

    /// Turn of the handlebar, −1 right to 1 left.
    pub fn steer(&self, at: Nanos) -> f64 {
        self.steer.value(at)
    }

    /// Brake lever, 0 to 1.
    pub fn brake(&self, at: Nanos) -> f64 {
        self.brake.value(at)
    }

    /// Thrust right, up, backward and turn nose up, nose left, roll left, each −1 to 1.
    pub fn deflection(&self, at: Nanos) -> [f64; 6] {
        let [right, up, back] = self.thrust.map(|ramp| ramp.value(at));
        let [nose_up, nose_left, roll_left] = self.turn.map(|ramp| ramp.value(at));
        [right, up, back, nose_up, nose_left, roll_left]
    }

    /// Directions in which the held keys turn the look: to the left and up, each −1, 0 or 1.
    pub fn look(&self) -> [f64; 2] {
        [
            self.held.between(&[KeyboardKey::L], &[KeyboardKey::J]),
            self.held.between(&[KeyboardKey::K], &[KeyboardKey::I]),
        ]
    }

    /// True while the key to look back is held.
    pub fn looks_back(&self) -> bool {
        self.held.any(&[KeyboardKey::M])
    }

    /// Aims every ramp at the goal of the held keys.
    fn aim(&mut self, at: Nanos) {
        let held = self.held;
        let lean = |ramp: &mut Ramp, target: f64| {
            ramp.aim(at, target, if target == 0.0 { RELEASE_RATE } else { PRESS_RATE });
        };

        // Aim the controls of drive and fly.
        let thrust = [
            held.between(&[KeyboardKey::A], &[KeyboardKey::D]),
            held.between(&[KeyboardKey::F], &[KeyboardKey::R]),
            held.between(&[KeyboardKey::W], &[KeyboardKey::S]),
        ];
        let turn = [
            held.between(&[KeyboardKey::Down], &[KeyboardKey::Up]),
            held.between(&[KeyboardKey::Right], &[KeyboardKey::Left]),
            held.between(&[KeyboardKey::E], &[KeyboardKey::Q]),
        ];
        self.thrust.iter_mut().zip(thrust).for_each(|(ramp, target)| lean(ramp, target));
        self.turn.iter_mut().zip(turn).for_each(|(ramp, target)| lean(ramp, target));

        // Aim the controls of the bicycle.
        lean(
            &mut self.steer,
            held.between(&[KeyboardKey::D, KeyboardKey::Right], &[KeyboardKey::A, KeyboardKey::Left]),
        );
        lean(&mut self.brake, held.between(&[], &[KeyboardKey::Space]));
        let rider = &self.rider;
        let forward = held.between(&[KeyboardKey::S, KeyboardKey::Down], &[KeyboardKey::W, KeyboardKey::Up]);
        let (speed, rate) = if held.any(&[KeyboardKey::Space]) {
            (0.0, rider.brake_m_s2)
        } else if forward > 0.0 {
            (if held.any(&[KeyboardKey::Shift]) { rider.sprint_m_s } else { rider.cruise_m_s }, rider.pedal_m_s2)
        } else if forward < 0.0 {
            // The wheel slows to a stop first, then turns backward.
            (-rider.reverse_m_s, rider.pedal_m_s2)
        } else {
            (0.0, rider.coast_m_s2)
        };
        self.pedalled |= forward != 0.0;
        self.wheel.aim(at, speed, rate);
    }
}

impl Decoder for KeyboardDecoder {
    /// Releases every key: the window lost the focus. The bicycle coasts.
    fn reset(&mut self, at: Nanos) {
        self.held = HeldKeys([false; 256]);
        self.actions.iter_mut().for_each(|(.., held)| *held = false);
        self.aim(at);
    }

    fn bytes(&mut self, at: Nanos, bytes: &[u8], actions: &mut Actions) {
        let (events, rest) = bytes.as_chunks::<2>();
        let works = self.works;
        for &[code, state] in events {
            if let (Some((_, action, held)), 0 | 1) = (self.actions.iter_mut().find(|(key, ..)| *key == code), state) {
                if state == 1 && !std::mem::replace(held, state == 1) {
                    actions.push(action.clone());
                }
                *held = state == 1;
                continue;
            }
            let code = works[usize::from(code)];
            match (KeyboardKey::from_code(code), state) {
                (Some(key), 0 | 1) => {
                    let held = &mut self.held.0[usize::from(code)];
                    let pressed = state == 1 && !*held;
                    *held = state == 1;
                    if pressed && let Some(action) = action(key).filter(|_| self.all_keys_act || is_of_ride(key)) {
                        actions.push(action);
                    }
                }
                _ => self.faults.count(format!("key event {code:02x} {state:02x}")),
            }
        }
        if !rest.is_empty() {
            self.faults.count("half a key event");
        }
        // A ramp that is aimed again goes the same way but for rounding: whoever looks round leaves the ride its bits.
        if events.is_empty() || !events.iter().all(|[code, _]| looks(works[usize::from(*code)])) {
            self.aim(at);
        }
    }

    fn faults(&self) -> &Faults {
        &self.faults
    }
}

#[cfg(test)]
mod tests {
    //! A held key must move its control smoothly to its end and a released one back; the order of asking may not
    //! matter.
    use super::*;
    use crate::clock::SECOND;

    fn keyboard() -> (KeyboardDecoder, Actions) {
        (KeyboardDecoder::new(RiderConfig::default(), &KeyMap::default(), true), Actions::default())
    }

    #[test]
    fn pedalling_rises_to_the_cruise_and_coasts_down() {
        let (mut keys, mut actions) = keyboard();
        assert_eq!(keys.wheel_speed(0), None);
        keys.bytes(SECOND, &KeyboardKey::W.to_bytes(true), &mut actions);
        assert_eq!(keys.wheel_speed(SECOND), Some(0.0));
        assert_eq!(keys.wheel_speed(2 * SECOND), Some(2.0));
        assert_eq!(keys.wheel_speed(60 * SECOND), Some(10.0));
        keys.bytes(60 * SECOND, &KeyboardKey::W.to_bytes(false), &mut actions);
        assert_eq!(keys.wheel_speed(64 * SECOND), Some(8.0));
        assert_eq!(keys.wheel_speed(99 * SECOND), Some(0.0));
    }

    #[test]
    fn braking_wins_over_pedalling() {
        let (mut keys, mut actions) = keyboard();
        keys.bytes(0, &KeyboardKey::Up.to_bytes(true), &mut actions);
        keys.bytes(10 * SECOND, &KeyboardKey::Space.to_bytes(true), &mut actions);
        assert_eq!(keys.wheel_speed(11 * SECOND), Some(4.0));
        assert_eq!(keys.brake(11 * SECOND), 1.0);
        assert_eq!(keys.wheel_speed(12 * SECOND), Some(0.0));
    }

    #[test]
    fn opposite_keys_cancel() {
        let (mut keys, mut actions) = keyboard();
        keys.bytes(0, &KeyboardKey::A.to_bytes(true), &mut actions);
        assert_eq!((keys.steer(SECOND), keys.deflection(SECOND)[0]), (1.0, -1.0));
        keys.bytes(SECOND, &KeyboardKey::D.to_bytes(true), &mut actions);
        assert_eq!((keys.steer(2 * SECOND), keys.deflection(2 * SECOND)[0]), (0.0, 0.0));
    }

    #[test]
    fn losing_the_focus_lets_everything_go() {
        let (mut keys, mut actions) = keyboard();
        for key in [KeyboardKey::W, KeyboardKey::A, KeyboardKey::Space, KeyboardKey::Q] {
            keys.bytes(0, &key.to_bytes(true), &mut actions);
        }
        keys.reset(SECOND);
        let later = 30 * SECOND;
        assert_eq!((keys.steer(later), keys.brake(later), keys.wheel_speed(later)), (0.0, 0.0, Some(0.0)));
        assert_eq!(keys.deflection(later), [0.0; 6]);
    }

    #[test]
    fn a_repeated_press_acts_once() {
        let (mut keys, mut actions) = keyboard();
        for state in [true, true, false, true] {
            keys.bytes(0, &KeyboardKey::P.to_bytes(state), &mut actions);
        }
        assert_eq!(actions.take(), [Action::TogglePause, Action::TogglePause]);
    }

    #[test]
    fn a_key_does_the_work_that_it_is_given() {
        let swapped = [("a", "D"), ("D", "A"), ("Enter", "W"), ("X", "P"), ("W", "{\"time_scale\":0.5}")];
        let map = KeyMap(swapped.map(|(key, work)| (key.to_owned(), work.to_owned())).into());
        assert_eq!(map.check(), Ok(()));
        let mut keys = KeyboardDecoder::new(RiderConfig::default(), &map, true);
        let mut actions = Actions::default();
        for key in [KeyboardKey::A, KeyboardKey::Enter, KeyboardKey::X, KeyboardKey::W] {
            keys.bytes(0, &key.to_bytes(true), &mut actions);
        }
        assert_eq!((keys.steer(SECOND), keys.wheel_speed(SECOND)), (-1.0, Some(2.0)));
        assert_eq!(actions.take(), [Action::TogglePause, Action::TimeScale(0.5)]);
        // A key that has an action pedals no longer.
        keys.bytes(0, &KeyboardKey::Enter.to_bytes(false), &mut actions);
        assert_eq!(keys.wheel_speed(99 * SECOND), Some(0.0));
        let bad = KeyMap([("Enter".to_owned(), "pedal".to_owned())].into());
        assert!(
            bad.check()
                .unwrap_err()
                .to_string()
                .contains("keys is \"pedal\": expected the name of a key, or an action")
        );
    }

    #[test]
    fn keys_of_the_picture_do_nothing_in_rides_whose_window_carried_them_out() {
        for (all_keys_act, expected) in [(true, vec![Action::NextView, Action::Photo]), (false, vec![Action::Photo])] {
            let mut keys = KeyboardDecoder::new(RiderConfig::default(), &KeyMap::default(), all_keys_act);
            let mut actions = Actions::default();
            keys.bytes(0, &KeyboardKey::X.to_bytes(true), &mut actions);
            keys.bytes(0, &KeyboardKey::C.to_bytes(true), &mut actions);
            assert_eq!(actions.take(), expected);
        }
    }

    #[test]
    fn unknown_keys_are_counted() {
        let (mut keys, mut actions) = keyboard();
        keys.bytes(0, &[0xff, 1, 0x1a, 2, 0x1a], &mut actions);
        assert_eq!(keys.faults().number(), 3);
        assert_eq!(keys.wheel_speed(SECOND), None);
    }
}
