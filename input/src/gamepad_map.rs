//! Work of a gamepad's axes and buttons: the table `[gamepad]` of a set-up file.
//!
//! ```
//! # let text = r#"
//! axes = { z = "rx", rx = "z", y = "-y" }   # the second stick sends z; the first is upside down
//! buttons = { south = "start" }
//! stick_dead_zone = 0.2
//! # "#;
//! # let map: input::GamepadMap = toml::from_str(text).unwrap();
//! # assert_eq!(map.check(), Ok(()));
//! ```

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::action::Action;
use crate::config_error::ConfigError;
use crate::gamepad_codes::{self as codes, AXES};

/// Names of axes.
const AXIS_NAMES: [(&str, u16); 8] = [
    ("x", codes::X),
    ("y", codes::Y),
    ("z", codes::Z),
    ("rx", codes::RX),
    ("ry", codes::RY),
    ("rz", codes::RZ),
    ("hat_x", codes::HAT_X),
    ("hat_y", codes::HAT_Y),
];

/// Names of buttons.
const BUTTON_NAMES: [(&str, u16); 14] = [
    ("south", codes::SOUTH),
    ("east", codes::EAST),
    ("north", codes::NORTH),
    ("west", codes::WEST),
    ("left_shoulder", codes::LEFT_SHOULDER),
    ("right_shoulder", codes::RIGHT_SHOULDER),
    ("left_trigger", 0x138),
    ("right_trigger", 0x139),
    ("select", codes::SELECT),
    ("start", codes::START),
    ("left_stick", 0x13d),
    ("right_stick", codes::RIGHT_STICK),
    ("trigger", codes::TRIGGER),
    ("thumb", codes::THUMB),
];

/// Work of a gamepad's axes and buttons, and the dead zones of its sticks.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct GamepadMap {
    /// Axes that do the work of others: name or number of the axis, and that of the one whose work it does, with a
    /// minus where it counts the other way. All other axes keep their own.
    pub axes: BTreeMap<String, String>,
    /// Buttons that do the work of others: name or number of the button, and that of the one whose work it does.
    pub buttons: BTreeMap<String, String>,
    /// Actions of buttons that have not their usual work: name or number of the button, and the text of its action.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub actions: BTreeMap<String, String>,
    /// Share of the range within which a stick counts as centred.
    pub stick_dead_zone: f64,
    /// Share of the range within which a trigger counts as released.
    pub trigger_dead_zone: f64,
}

impl Default for GamepadMap {
    /// Dead zones of worn sticks, which rest off centre.
    fn default() -> Self {
        Self {
            axes: BTreeMap::new(),
            buttons: BTreeMap::new(),
            actions: BTreeMap::new(),
            stick_dead_zone: 0.12,
            trigger_dead_zone: 0.04,
        }
    }
}

/// Axis whose work another one does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct AxisWork {
    /// Number of the axis in evdev.
    pub(crate) code: u16,
    /// True if the axis counts the other way.
    pub(crate) reversed: bool,
}

impl GamepadMap {
    /// True if everything does its own work.
    pub fn is_usual(&self) -> bool {
        *self == Self::default()
    }

    /// Work of an axis.
    pub(crate) fn axis(&self, code: u16) -> AxisWork {
        let own = AxisWork { code, reversed: false };
        let found = self.axes.iter().find(|(axis, _)| number(axis, &AXIS_NAMES) == Some(code));
        found.and_then(|(_, work)| axis_work(work)).unwrap_or(own)
    }

    /// Button whose work a button does.
    pub(crate) fn button(&self, code: u16) -> u16 {
        let found = self.buttons.iter().find(|(button, _)| number(button, &BUTTON_NAMES) == Some(code));
        found.and_then(|(_, work)| number(work, &BUTTON_NAMES)).unwrap_or(code)
    }

    /// Action of a button, if it has one of its own.
    pub(crate) fn action(&self, code: u16) -> Option<Action> {
        let found = self.actions.iter().find(|(button, _)| number(button, &BUTTON_NAMES) == Some(code));
        found.and_then(|(_, text)| Action::named(text))
    }

    /// Checks the names and the dead zones.
    ///
    /// # Errors
    /// The first setting that cannot be used.
    pub fn check(&self) -> Result<(), ConfigError> {
        let bad = |key, name: &str, expected| Err(ConfigError { key, value: format!("{name:?}"), expected });
        let no_axis = |name: &str| number(name, &AXIS_NAMES).is_none_or(|code| usize::from(code) >= AXES);
        for (axis, work) in &self.axes {
            let plain = work.strip_prefix('-').unwrap_or(work);
            if let Some(name) = [axis.as_str(), plain].into_iter().find(|name| no_axis(name)) {
                let expected = "an axis: x, y, z, rx, ry, rz, hat_x, hat_y or a number from 0 to 63";
                return bad("gamepad.axes", name, expected);
            }
        }
        let mut buttons = self.buttons.iter().flat_map(|(button, work)| [button, work]).chain(self.actions.keys());
        if let Some(name) = buttons.find(|name| number(name, &BUTTON_NAMES).is_none()) {
            let expected = "a button: south, east, north, west, left_shoulder, right_shoulder, left_trigger, \
                            right_trigger, select, start, left_stick, right_stick, trigger, thumb or a number";
            return bad("gamepad.buttons", name, expected);
        }
        if let Some(text) = self.actions.values().find(|text| Action::named(text).is_none()) {
            return bad("gamepad.actions", text, "an action such as \"photo\" or '{\"toggle\":\"outside\"}'");
        }
        for (key, zone) in
            [("gamepad.stick_dead_zone", self.stick_dead_zone), ("gamepad.trigger_dead_zone", self.trigger_dead_zone)]
        {
            if !(0.0..=0.9).contains(&zone) {
                return Err(ConfigError { key, value: zone.to_string(), expected: "a share from 0 to 0.9" });
            }
        }
        Ok(())
    }
}

/// Number of an axis or a button by its name, or by the number itself.
fn number(name: &str, names: &[(&str, u16)]) -> Option<u16> {
    let known = names.iter().find(|(known, _)| *known == name);
    known.map_or_else(|| name.parse().ok(), |(_, code)| Some(*code))
}

/// Work that a text names: an axis, with a minus where it counts the other way.
fn axis_work(text: &str) -> Option<AxisWork> {
    let plain = text.strip_prefix('-');
    number(plain.unwrap_or(text), &AXIS_NAMES).map(|code| AxisWork { code, reversed: plain.is_some() })
}

#[cfg(test)]
mod tests {
    //! A name that is no axis or button must be refused, with the names that are.
    use super::*;

    #[test]
    fn what_is_no_axis_or_button_is_told() {
        for (axis, work, told) in
            [("q", "x", "gamepad.axes is \"q\""), ("x", "--y", "\"-y\""), ("64", "x", "\"64\""), ("x", "-", "\"\"")]
        {
            let map =
                GamepadMap { axes: BTreeMap::from([(axis.to_owned(), work.to_owned())]), ..GamepadMap::default() };
            let error = map.check().unwrap_err().to_string();
            assert!(error.contains(told), "{axis}: {error}");
        }
        let buttons = BTreeMap::from([("south".to_owned(), "jump".to_owned())]);
        let map = GamepadMap { buttons, ..GamepadMap::default() };
        assert!(map.check().unwrap_err().to_string().contains("gamepad.buttons is \"jump\""));
        let actions = BTreeMap::from([("south".to_owned(), "jump".to_owned())]);
        let map = GamepadMap { actions, ..GamepadMap::default() };
        assert!(map.check().unwrap_err().to_string().contains("gamepad.actions is \"jump\""));
        let map = GamepadMap { stick_dead_zone: 1.0, ..GamepadMap::default() };
        assert_eq!(map.check().unwrap_err().key, "gamepad.stick_dead_zone");
    }
}
