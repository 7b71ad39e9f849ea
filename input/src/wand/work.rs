//! Work of a wand: how it flies, and what its buttons do (W 6.3).
//!
//! The stick thrusts ahead and turns the nose; on the bicycle it pedals and steers. A turn of the wand about its own
//! axis rolls. Buttons are actions.

use std::collections::BTreeMap;

use super::held_buttons::HeldButtons;
use super::state::WandState;
use crate::action::{Action, Switch};
use crate::config_error::ConfigError;
use crate::filters::with_dead_zone;
use crate::head::state::Tracking;
use glam::DVec3;

/// Turn of the wand about its axis that rolls at the full rate, radians: 60°.
const FULL_ROLL_RAD: f64 = std::f64::consts::FRAC_PI_3;
/// Share of it that counts as level, since a hand is never quite: 20°.
const LEVEL: f64 = 1.0 / 3.0;
/// Share of the stick's range that counts as centred.
const CENTRED: f64 = 0.12;
/// Pulls of the trigger's axis at which it counts as pressed, and as released again.
const PRESSED: f64 = 0.6;
const RELEASED: f64 = 0.4;

/// Actions of the first buttons, unless the set-up says otherwise.
const BUTTONS: [Action; 5] = [
    Action::Choose,
    Action::Toggle(Switch::Menu),
    Action::TogglePause,
    Action::NextView,
    Action::Toggle(Switch::Outside),
];

/// Actions of a wand's buttons: the number of the button, and the text of its action.
#[derive(Clone, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(transparent)]
pub struct WandButtons(pub BTreeMap<String, String>);

impl WandButtons {
    /// True if every button has its usual action.
    pub(crate) fn are_usual(&self) -> bool {
        self.0.is_empty()
    }

    /// Action of a button.
    fn action(&self, button: u32) -> Option<Action> {
        match self.0.get(&button.to_string()) {
            Some(text) => Action::named(text),
            None => BUTTONS.get(button as usize).cloned(),
        }
    }

    /// True if a button chooses what the pointer shows.
    pub fn chooses(&self, button: u32) -> bool {
        self.action(button) == Some(Action::Choose)
    }

    pub(crate) fn check(&self) -> Result<(), ConfigError> {
        let key = "tracker.wand.actions";
        for (button, text) in &self.0 {
            if button.parse::<u32>().is_ok_and(|number| number < HeldButtons::MOST) {
                if Action::named(text).is_none() {
                    let expected = "an action such as \"photo\" or '{\"toggle\":\"menu\"}'";
                    return Err(ConfigError { key, value: format!("{text:?}"), expected });
                }
            } else {
                let expected = "numbers of buttons from 0 to 63";
                return Err(ConfigError { key, value: format!("{button:?}"), expected });
            }
        }
        Ok(())
    }
}

/// What a wand's rider has pressed so far.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct WandPresses {
    held: HeldButtons,
    pulled: bool,
    pedalled: bool,
}

impl WandPresses {
    /// Takes the newest state, and returns the actions of what has been pressed since the one before.
    pub(crate) fn take(&mut self, state: &WandState, buttons: &WandButtons) -> Vec<Action> {
        let before = std::mem::replace(&mut self.held, state.buttons);
        let pressed = state.buttons.numbers().filter(|number| !before.holds(*number));
        let mut actions: Vec<Action> = pressed.filter_map(|number| buttons.action(number)).collect();
        let pulled = state.trigger > if self.pulled { RELEASED } else { PRESSED };
        if pulled && !std::mem::replace(&mut self.pulled, pulled) {
            actions.push(Action::Choose);
        }
        self.pulled = pulled;
        self.pedalled |= pedal(state) > 0.0;
        actions
    }

    /// Strength of pedalling, 0 to 1; `None` before the first.
    pub(crate) fn pedal(&self, state: &WandState) -> Option<f64> {
        self.pedalled.then(|| pedal(state))
    }
}

fn pedal(state: &WandState) -> f64 {
    with_dead_zone(state.stick[1], CENTRED).max(0.0)
}

/// Turn of the handlebar, −1 right to 1 left.
pub(crate) fn steer(state: &WandState) -> f64 {
    -with_dead_zone(state.stick[0], CENTRED)
}

/// Brake lever, 0 to 1.
pub(crate) fn brake(state: &WandState) -> f64 {
    (-with_dead_zone(state.stick[1], CENTRED)).max(0.0)
}

/// Thrust right, up, backward and turn nose up, nose left, roll left, each −1 to 1.
pub(crate) fn deflection(state: &WandState) -> [f64; 6] {
    let back = -with_dead_zone(state.stick[1], CENTRED);
    [0.0, 0.0, back, 0.0, steer(state), roll_left(state)]
}

/// Rate of roll to the left, −1 to 1, by the turn of the wand about its own axis against the room.
fn roll_left(state: &WandState) -> f64 {
    if state.tracked != Tracking::Tracked {
        return 0.0;
    }
    let [right, top] = [DVec3::X, DVec3::Y].map(|axis| state.orientation * axis);
    let turn_rad = libm::atan2(right.y, top.y);
    // A wand that points straight up or down has no such turn.
    if libm::hypot(right.y, top.y) < 0.3 { 0.0 } else { with_dead_zone(turn_rad / FULL_ROLL_RAD, LEVEL) }
}

#[cfg(test)]
mod tests {
    //! Laws: the stick goes where it is pushed, a hand that is nearly level does not roll, a turn to the left rolls to
    //! the left; a press acts once, a trigger near its threshold does not chatter.
    use super::*;
    use glam::DQuat;

    fn wand(stick: [f64; 2], roll_deg: f64) -> WandState {
        WandState {
            position_m: DVec3::ZERO,
            orientation: DQuat::from_rotation_y(0.7) * DQuat::from_rotation_z(roll_deg.to_radians()),
            tracked: Tracking::Tracked,
            buttons: HeldButtons::default(),
            stick,
            trigger: 0.0,
        }
    }

    #[test]
    fn the_stick_goes_where_it_is_pushed() {
        assert_eq!(deflection(&wand([0.0, 1.0], 0.0)), [0.0, 0.0, -1.0, 0.0, 0.0, 0.0]);
        assert_eq!(deflection(&wand([1.0, 0.0], 0.0))[4], -1.0);
        assert_eq!((brake(&wand([0.0, -1.0], 0.0)), brake(&wand([0.0, 1.0], 0.0))), (1.0, 0.0));
        assert_eq!(deflection(&wand([0.1, -0.1], 0.0)), [0.0; 6]);
    }

    #[test]
    fn a_turn_about_its_axis_rolls_that_way() {
        let roll = |degrees| deflection(&wand([0.0; 2], degrees))[5];
        assert_eq!(roll(19.0), 0.0);
        assert!((roll(40.0) - 0.5).abs() < 1e-12 && (roll(-40.0) + 0.5).abs() < 1e-12);
        assert_eq!(roll(80.0), 1.0);
        let lost = WandState { tracked: Tracking::Lost, ..wand([0.0; 2], 80.0) };
        assert_eq!(deflection(&lost)[5], 0.0);
        let straight_up = WandState { orientation: DQuat::from_rotation_x(1.57), ..wand([0.0; 2], 0.0) };
        assert_eq!(deflection(&straight_up)[5], 0.0);
    }

    #[test]
    fn a_press_acts_once() {
        let mut presses = WandPresses::default();
        let own = WandButtons([("2".to_owned(), "photo".to_owned())].into());
        let with = |held: u64, trigger: f64| WandState { buttons: HeldButtons(held), trigger, ..wand([0.0; 2], 0.0) };
        assert_eq!(presses.take(&with(0b101, 0.0), &own), [Action::Choose, Action::Photo]);
        assert_eq!(presses.take(&with(0b101, 0.5), &own), []);
        assert_eq!(presses.take(&with(0b110, 0.7), &own), [Action::Toggle(Switch::Menu), Action::Choose]);
        for trigger in [0.55, 0.65, 0.45] {
            assert_eq!(presses.take(&with(0, trigger), &own), []);
        }
        assert_eq!(presses.take(&with(0, 0.1), &own), []);
        assert_eq!(presses.take(&with(0, 0.9), &own), [Action::Choose]);
        assert_eq!(presses.pedal(&wand([0.0; 2], 0.0)), None);
        presses.take(&wand([0.0, 0.5], 0.0), &own);
        assert_eq!(presses.pedal(&wand([0.0; 2], 0.0)), Some(0.0));
    }

    #[test]
    fn what_is_no_button_or_action_is_told() {
        for (button, action, told) in [("64", "photo", "buttons from 0 to 63"), ("1", "jump high", "an action such as")]
        {
            let buttons = WandButtons([(button.to_owned(), action.to_owned())].into());
            assert!(buttons.check().unwrap_err().to_string().contains(told), "{button}");
        }
    }
}
