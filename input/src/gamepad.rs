//! Decoder of a gamepad or joystick.
//!
//! The bytes are a plain encoding of Linux's evdev events, made here, so that a recording does not depend on the
//! system:
//!
//! | first byte | then, little-endian | meaning |
//! |---|---|---|
//! | `G` or `J` | | it is a gamepad, or a joystick; nothing is held but what follows |
//! | `A` | code u16, value i32, least i32, most i32 | an axis: where it is, how far it goes |
//! | `E` | type u16, code u16, value i32 | an event |
//!
//! | | gamepad | joystick |
//! |---|---|---|
//! | steer; nose left, right | left stick; right stick | stick left, right |
//! | pedal, brake | right and left trigger | trigger, thumb button |
//! | thrust | left stick, triggers, cross up and down | trigger forward, thumb backward, hat |
//! | nose up, down; roll | right stick; shoulder buttons | stick back, forward; twist |
//!
//! On the bicycle a gamepad's right stick turns the look. In the other vehicles, where it turns the nose, it does so as
//! long as it is pressed down.
//!
//! On a gamepad Start pauses, Select shows the help, the upper button returns to the start and the left one takes a
//! picture. The right button opens the menu, in which the cross moves and the lower button chooses.

use crate::action::{Action, FocusStep, Switch};
use crate::clock::Nanos;
use crate::decoder::{Actions, Decoder};
use crate::faults::Faults;
use crate::filters::with_dead_zone;
use crate::gamepad_codes::{self as codes, AXES};
use crate::gamepad_map::GamepadMap;

/// Item of a gamepad's bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GamepadItem {
    /// Layout of a gamepad.
    Gamepad,
    /// Layout of a joystick.
    Joystick,
    /// Axis with its number, value and range.
    Axis {
        /// Number of the axis in evdev.
        code: u16,
        /// Value of the axis.
        value: i32,
        /// Smallest value of the axis.
        least: i32,
        /// Largest value of the axis.
        most: i32,
    },
    /// Event of evdev.
    Event {
        /// Type of the event: [`codes::KEY`], [`codes::ABSOLUTE`] or another.
        kind: u16,
        /// Number of the button or axis.
        code: u16,
        /// New value of the button or axis.
        value: i32,
    },
}

impl GamepadItem {
    /// Appends the item to the bytes.
    pub fn encode(self, bytes: &mut Vec<u8>) {
        match self {
            Self::Gamepad => bytes.push(b'G'),
            Self::Joystick => bytes.push(b'J'),
            Self::Axis { code, value, least, most } => {
                bytes.push(b'A');
                bytes.extend_from_slice(&code.to_le_bytes());
                [value, least, most].iter().for_each(|number| bytes.extend_from_slice(&number.to_le_bytes()));
            }
            Self::Event { kind, code, value } => {
                bytes.push(b'E');
                bytes.extend_from_slice(&kind.to_le_bytes());
                bytes.extend_from_slice(&code.to_le_bytes());
                bytes.extend_from_slice(&value.to_le_bytes());
            }
        }
    }

    /// First item of the bytes, and the rest.
    fn split(bytes: &[u8]) -> Option<(Self, &[u8])> {
        let (&kind, rest) = bytes.split_first()?;
        match kind {
            b'G' => Some((Self::Gamepad, rest)),
            b'J' => Some((Self::Joystick, rest)),
            b'A' => {
                let (code, rest) = rest.split_first_chunk()?;
                let (value, rest) = rest.split_first_chunk()?;
                let (least, rest) = rest.split_first_chunk()?;
                let (most, rest) = rest.split_first_chunk()?;
                let item = Self::Axis {
                    code: u16::from_le_bytes(*code),
                    value: i32::from_le_bytes(*value),
                    least: i32::from_le_bytes(*least),
                    most: i32::from_le_bytes(*most),
                };
                Some((item, rest))
            }
            b'E' => {
                let (kind, rest) = rest.split_first_chunk()?;
                let (code, rest) = rest.split_first_chunk()?;
                let (value, rest) = rest.split_first_chunk()?;
                let item = Self::Event {
                    kind: u16::from_le_bytes(*kind),
                    code: u16::from_le_bytes(*code),
                    value: i32::from_le_bytes(*value),
                };
                Some((item, rest))
            }
            _ => None,
        }
    }
}

/// Axes of the cross, with the steps of the menu's focus to their ends.
const FOCUS: [(u16, FocusStep, FocusStep); 2] =
    [(codes::HAT_X, FocusStep::Left, FocusStep::Right), (codes::HAT_Y, FocusStep::Up, FocusStep::Down)];

/// Axis that has been announced.
#[derive(Clone, Copy, Debug)]
struct GamepadAxis {
    value: f64,
    least: f64,
    most: f64,
    /// True if the axis counts the other way.
    reversed: bool,
}

impl GamepadAxis {
    /// Deflection of a stick, −1 to 1 about the middle of its range.
    fn stick(self, dead_zone: f64) -> f64 {
        let deflection = (2.0 * self.value - self.least - self.most) / (self.most - self.least);
        with_dead_zone(if self.reversed { -deflection } else { deflection }, dead_zone)
    }

    /// Deflection of a trigger, 0 to 1 from its lower end.
    fn trigger(self, dead_zone: f64) -> f64 {
        let share = (self.value - self.least) / (self.most - self.least);
        with_dead_zone((if self.reversed { 1.0 - share } else { share }).max(0.0), dead_zone)
    }
}

/// Decoder of [`SampleSource::Gamepad`](crate::SampleSource::Gamepad).
#[derive(Debug)]
pub struct GamepadDecoder {
    is_joystick: bool,
    axes: [Option<GamepadAxis>; AXES],
    held: Vec<u16>,
    pedalled: bool,
    /// True if the second stick, pressed down, turns the look.
    looks_round: bool,
    /// True if the cross and all buttons act in the menu.
    all_act: bool,
    /// Work of the axes and buttons.
    map: GamepadMap,
    faults: Faults,
}

impl Default for GamepadDecoder {
    fn default() -> Self {
        Self {
            is_joystick: false,
            axes: [None; AXES],
            held: Vec::new(),
            pedalled: false,
            looks_round: false,
            all_act: false,
            map: GamepadMap::default(),
            faults: Faults::default(),
        }
    }
}

impl GamepadDecoder {
    /// Most buttons remembered, more than any pad has.
    const MOST_HELD: usize = 64;

    /// Gamepad at rest; `looks_round`: its second stick, pressed down, turns the look; `all_act`: its cross and all its
    /// buttons act in the menu.
    pub fn new(looks_round: bool, all_act: bool, map: GamepadMap) -> Self {
        Self { looks_round, all_act, map, ..Self::default() }
    }

    /// Strength of pedalling, 0 to 1; `None` before the first.
    pub fn pedal(&self) -> Option<f64> {
        self.pedalled.then(|| self.forward())
    }

    /// Brake lever, 0 to 1.
    pub fn brake(&self) -> f64 {
        if self.is_joystick { self.button(codes::THUMB) } else { self.trigger(codes::Z) }
    }

    /// Turn of the handlebar, −1 right to 1 left.
    pub fn steer(&self) -> f64 {
        -self.stick(codes::X)
    }

    /// Thrust right, up, backward and turn nose up, nose left, roll left, each −1 to 1.
    pub fn deflection(&self) -> [f64; 6] {
        let back = self.brake() - self.forward();
        if self.is_joystick {
            let [right, up] = [self.stick(codes::HAT_X), -self.stick(codes::HAT_Y)];
            [right, up, back, self.stick(codes::Y), -self.stick(codes::X), -self.stick(codes::RZ)]
        } else {
            let back = (self.stick(codes::Y) + back).clamp(-1.0, 1.0);
            let roll_left = self.button(codes::LEFT_SHOULDER) - self.button(codes::RIGHT_SHOULDER);
            let [right, up] = [self.stick(codes::X), -self.stick(codes::HAT_Y)];
            let [nose_left, nose_up] = if self.looks() { [0.0; 2] } else { self.second_stick() };
            [right, up, back, nose_up, nose_left, roll_left]
        }
    }

    /// Deflection of the second stick where it turns the look: to the left and up, each −1 to 1. `always`: even if
    /// the stick is not pressed down.
    pub fn look(&self, always: bool) -> [f64; 2] {
        if !self.is_joystick && (always || self.looks()) { self.second_stick() } else { [0.0; 2] }
    }

    /// True while the second stick is pressed down, which turns the look.
    fn looks(&self) -> bool {
        self.looks_round && self.button(codes::RIGHT_STICK) > 0.0
    }

    /// Deflection of the second stick: to the left and up, each −1 to 1.
    fn second_stick(&self) -> [f64; 2] {
        [-self.stick(codes::RX), -self.stick(codes::RY)]
    }

    fn forward(&self) -> f64 {
        if self.is_joystick { self.button(codes::TRIGGER) } else { self.trigger(codes::RZ) }
    }

    fn stick(&self, code: u16) -> f64 {
        self.axes[usize::from(code)].map_or(0.0, |axis| axis.stick(self.map.stick_dead_zone))
    }

    fn trigger(&self, code: u16) -> f64 {
        self.axes[usize::from(code)].map_or(0.0, |axis| axis.trigger(self.map.trigger_dead_zone))
    }

    fn button(&self, code: u16) -> f64 {
        f64::from(u8::from(self.held.contains(&code)))
    }

    fn press(&mut self, code: u16, pressed: bool, actions: &mut Actions) {
        let own = self.map.action(code).filter(|_| self.all_act);
        let code = self.map.button(code);
        let was_held = self.held.contains(&code);
        if pressed && !was_held && self.held.len() < Self::MOST_HELD {
            self.held.push(code);
            match code {
                _ if own.is_some() => own.into_iter().for_each(|action| actions.push(action)),
                codes::SOUTH if self.all_act => actions.push(Action::Choose),
                codes::EAST if self.all_act => actions.push(Action::Toggle(Switch::Menu)),
                codes::START => actions.push(Action::TogglePause),
                codes::SELECT => actions.push(Action::ToggleHelp),
                codes::NORTH => actions.push(Action::Restart),
                codes::WEST => actions.push(Action::Photo),
                _ => {}
            }
        } else if !pressed {
            self.held.retain(|&held| held != code);
        }
    }

    fn item(&mut self, item: GamepadItem, actions: &mut Actions) {
        match item {
            // A description begins: the held buttons follow.
            GamepadItem::Gamepad | GamepadItem::Joystick => {
                self.is_joystick = item == GamepadItem::Joystick;
                self.held.clear();
            }
            GamepadItem::Axis { code, value, least, most } if usize::from(code) < AXES && least < most => {
                let [value, least, most] = [value, least, most].map(f64::from);
                let work = self.map.axis(code);
                let axis = GamepadAxis { value, least, most, reversed: work.reversed };
                self.axes[usize::from(work.code)] = Some(axis);
            }
            GamepadItem::Axis { code, least, most, .. } => {
                self.faults.count(format!("axis {code} that goes from {least} to {most}"));
            }
            GamepadItem::Event { kind: codes::ABSOLUTE, code, value } => {
                match self.axes.get_mut(usize::from(self.map.axis(code).code)) {
                    Some(Some(axis)) => {
                        let before = std::mem::replace(&mut axis.value, f64::from(value));
                        let focus = FOCUS.iter().find(|(axis, ..)| *axis == code);
                        if let (Some((_, less, more)), true, true) = (focus, self.all_act, before == 0.0 && value != 0)
                        {
                            actions.push(Action::Focus(if value < 0 { *less } else { *more }));
                        }
                    }
                    _ => self.faults.count(format!("axis {code}, which was not announced")),
                }
            }
            // The value 2 is a repetition.
            GamepadItem::Event { kind: codes::KEY, code, value } => self.press(code, value != 0, actions),
            GamepadItem::Event { .. } => {}
        }
        self.pedalled |= self.forward() > 0.0;
    }
}

impl Decoder for GamepadDecoder {
    fn reset(&mut self, _at: Nanos) {
        let (faults, map) = (std::mem::take(&mut self.faults), std::mem::take(&mut self.map));
        *self = Self { faults, ..Self::new(self.looks_round, self.all_act, map) };
    }

    fn bytes(&mut self, _at: Nanos, mut bytes: &[u8], actions: &mut Actions) {
        while let Some((item, rest)) = GamepadItem::split(bytes) {
            self.item(item, actions);
            bytes = rest;
        }
        if let Some(first) = bytes.first() {
            self.faults.count(format!("{} bytes that begin with {first:02x}", bytes.len()));
        }
    }

    fn faults(&self) -> &Faults {
        &self.faults
    }
}

#[cfg(test)]
mod tests {
    //! A stick must read zero at rest and one at its end; a pad that is unplugged must release everything it held.
    use super::*;

    fn pad(items: &[GamepadItem]) -> (GamepadDecoder, Vec<Action>) {
        let (mut pad, mut actions) = (GamepadDecoder::default(), Actions::default());
        feed(&mut pad, items, &mut actions);
        (pad, actions.take())
    }

    fn feed(pad: &mut GamepadDecoder, items: &[GamepadItem], actions: &mut Actions) {
        let mut bytes = Vec::new();
        items.iter().for_each(|item| item.encode(&mut bytes));
        pad.bytes(0, &bytes, actions);
    }

    #[test]
    fn the_menu_is_opened_walked_through_and_chosen_in() {
        let map = GamepadMap { actions: [("west".to_owned(), "photo_sphere".to_owned())].into(), ..Default::default() };
        let mut pad = GamepadDecoder::new(true, true, map);
        let mut actions = Actions::default();
        let hat = GamepadItem::Axis { code: codes::HAT_Y, value: 0, least: -1, most: 1 };
        let key = |code, value| event(codes::KEY, code, value);
        let cross = |value| event(codes::ABSOLUTE, codes::HAT_Y, value);
        let items = [
            GamepadItem::Gamepad,
            hat,
            key(codes::EAST, 1),
            cross(1),
            cross(1),
            cross(0),
            cross(-1),
            key(codes::SOUTH, 1),
            key(codes::WEST, 1),
        ];
        feed(&mut pad, &items, &mut actions);
        let chosen = [
            Action::Toggle(Switch::Menu),
            Action::Focus(FocusStep::Down),
            Action::Focus(FocusStep::Up),
            Action::Choose,
            Action::PhotoSphere,
        ];
        assert_eq!(actions.take(), chosen);
        // In rides without a menu only the old buttons act.
        let mut pad = GamepadDecoder::new(true, false, GamepadMap::default());
        feed(&mut pad, &items, &mut actions);
        assert_eq!(actions.take(), [Action::Photo]);
    }

    fn axis(code: u16, value: i32) -> GamepadItem {
        GamepadItem::Axis { code, value, least: -32768, most: 32767 }
    }

    fn event(kind: u16, code: u16, value: i32) -> GamepadItem {
        GamepadItem::Event { kind, code, value }
    }

    #[test]
    fn a_resting_pad_wants_nothing() {
        let trigger = GamepadItem::Axis { code: codes::RZ, value: 0, least: 0, most: 255 };
        let (pad, actions) = pad(&[GamepadItem::Gamepad, axis(codes::X, -2000), axis(codes::Y, 1500), trigger]);
        assert_eq!((pad.deflection(), pad.brake(), pad.pedal()), ([0.0; 6].map(|zero: f64| zero), 0.0, None));
        assert!(actions.is_empty());
    }

    #[test]
    fn sticks_and_triggers_reach_their_ends() {
        let (mut pad, _) = pad(&[GamepadItem::Gamepad, axis(codes::X, 0), axis(codes::Y, 0), axis(codes::RX, 0)]);
        let mut actions = Actions::default();
        let trigger = GamepadItem::Axis { code: codes::RZ, value: 255, least: 0, most: 255 };
        let pushed = [event(codes::ABSOLUTE, codes::X, -32768), event(codes::ABSOLUTE, codes::RX, 32767), trigger];
        feed(&mut pad, &pushed, &mut actions);
        assert_eq!(pad.steer(), 1.0);
        assert_eq!(pad.pedal(), Some(1.0));
        assert_eq!(pad.deflection(), [-1.0, -0.0, -1.0, -0.0, -1.0, 0.0]);
        feed(&mut pad, &[event(codes::ABSOLUTE, codes::RZ, 0)], &mut actions);
        assert_eq!(pad.pedal(), Some(0.0));
    }

    #[test]
    fn the_second_stick_looks_where_it_is_free_or_pressed_down() {
        let mut pad = GamepadDecoder::new(true, false, GamepadMap::default());
        let mut actions = Actions::default();
        let pushed = [GamepadItem::Gamepad, axis(codes::RX, -32768), axis(codes::RY, 32767)];
        feed(&mut pad, &pushed, &mut actions);
        assert_eq!((pad.look(true), pad.look(false)), ([1.0, -1.0], [0.0; 2]));
        assert_eq!(pad.deflection()[3..5], [-1.0, 1.0]);
        feed(&mut pad, &[event(codes::KEY, codes::RIGHT_STICK, 1)], &mut actions);
        assert_eq!((pad.look(false), pad.deflection()), ([1.0, -1.0], [0.0; 6]));
        // Recordings made before one could look round know no such button.
        let mut before = GamepadDecoder::default();
        feed(&mut before, &pushed, &mut actions);
        feed(&mut before, &[event(codes::KEY, codes::RIGHT_STICK, 1)], &mut actions);
        assert_eq!(before.deflection()[3..5], [-1.0, 1.0]);
    }

    #[test]
    fn a_joystick_is_flown_by_stick_and_twist() {
        let (pad, _) = pad(&[
            GamepadItem::Joystick,
            GamepadItem::Axis { code: codes::Y, value: 255, least: 0, most: 255 },
            GamepadItem::Axis { code: codes::RZ, value: 0, least: 0, most: 255 },
            event(codes::KEY, codes::TRIGGER, 1),
        ]);
        let [_, _, back, nose_up, _, roll_left] = pad.deflection();
        assert_eq!([back, nose_up, roll_left], [-1.0, 1.0, 1.0]);
    }

    #[test]
    fn axes_and_buttons_do_the_work_that_they_are_given() {
        let named =
            |pairs: &[(&str, &str)]| pairs.iter().map(|(from, to)| ((*from).to_owned(), (*to).to_owned())).collect();
        let map = GamepadMap {
            axes: named(&[("z", "-x"), ("9", "rz")]),
            buttons: named(&[("south", "start"), ("300", "select")]),
            stick_dead_zone: 0.5,
            ..GamepadMap::default()
        };
        assert_eq!(map.check(), Ok(()));
        let mut pad = GamepadDecoder::new(false, false, map);
        let mut actions = Actions::default();
        let axis = |code, value| GamepadItem::Axis { code, value, least: -100, most: 100 };
        feed(&mut pad, &[GamepadItem::Gamepad, axis(2, 75), axis(9, -100)], &mut actions);
        assert_eq!((pad.steer(), pad.pedal()), (0.5, None));
        let pressed = [event(codes::ABSOLUTE, 2, -100), event(codes::ABSOLUTE, 9, 100)];
        feed(&mut pad, &pressed, &mut actions);
        assert_eq!((pad.steer(), pad.pedal()), (-1.0, Some(1.0)));
        feed(&mut pad, &[event(codes::KEY, codes::SOUTH, 1), event(codes::KEY, 300, 1)], &mut actions);
        assert_eq!(actions.take(), [Action::TogglePause, Action::ToggleHelp]);
        // The pad comes back with the same map.
        pad.reset(0);
        feed(&mut pad, &[GamepadItem::Gamepad, axis(2, 100)], &mut actions);
        assert_eq!(pad.steer(), 1.0);
    }

    #[test]
    fn buttons_act_once() {
        let presses = [1, 2, 0, 1].map(|value| event(codes::KEY, codes::START, value));
        let (_, actions) = pad(&presses);
        assert_eq!(actions, [Action::TogglePause, Action::TogglePause]);
    }

    #[test]
    fn unplugging_lets_everything_go() {
        let (mut pad, _) = pad(&[axis(codes::Y, -32768), event(codes::KEY, codes::LEFT_SHOULDER, 1)]);
        assert_eq!(pad.deflection()[2], -1.0);
        pad.reset(0);
        assert_eq!(pad.deflection(), GamepadDecoder::default().deflection());
        assert_eq!(pad.deflection().map(f64::abs), [0.0; 6]);
    }

    #[test]
    fn a_new_description_lets_go_of_what_it_does_not_name() {
        let left = event(codes::KEY, codes::LEFT_SHOULDER, 1);
        let right = event(codes::KEY, codes::RIGHT_SHOULDER, 1);
        let (mut pad, _) = pad(&[left, right]);
        assert_eq!(pad.deflection()[5], 0.0);
        feed(&mut pad, &[GamepadItem::Gamepad, right], &mut Actions::default());
        assert_eq!(pad.deflection()[5], -1.0);
    }

    #[test]
    fn nonsense_is_counted_and_bounded() {
        let (mut pad, _) = pad(&[
            GamepadItem::Axis { code: 64, value: 0, least: 0, most: 1 },
            GamepadItem::Axis { code: 0, value: 0, least: 1, most: 1 },
            event(codes::ABSOLUTE, 5, 1),
            event(codes::ABSOLUTE, 999, 1),
        ]);
        assert_eq!(pad.faults().number(), 4);
        let mut actions = Actions::default();
        for bytes in [&b"Z"[..], b"A\x00", b"E\x01\x00\x02"] {
            pad.bytes(0, bytes, &mut actions);
        }
        assert_eq!(pad.faults().number(), 7);
        let flood: Vec<GamepadItem> = (0..5000).map(|code| event(codes::KEY, code, 1)).collect();
        feed(&mut pad, &flood, &mut actions);
        assert_eq!(pad.held.len(), GamepadDecoder::MOST_HELD);
    }
}
