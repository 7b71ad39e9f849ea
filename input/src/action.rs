//! Actions: things that happen once, at a press, and the decoder of those that the interface sends.
//!
//! Buttons of any device and the program's own panels end in the same list. What a panel sends is a
//! small JSON text (`"step"`, `{"time_scale":0.5}`) that passes through the recording like any
//! other device's bytes.

use serde::{Deserialize, Serialize};

use crate::decoder::{Actions, Decoder, Faults};
use crate::sample::Nanos;

/// How the controls drive the observer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum VehicleKind {
    /// Wheel speed, handlebar and brake (B 5.6.1).
    #[default]
    Bicycle,
    /// Thrust in the horizontal plane.
    Drive,
    /// Thrust in three directions, and roll.
    Fly,
}

/// Something that happens once.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Action {
    /// Stop the clock, or let it run.
    TogglePause,
    /// Advance by one step while paused.
    Step,
    /// Proper time per real time; finite, not negative.
    TimeScale(f64),
    /// Multiply the time scale; finite, positive.
    ScaleTime(f64),
    /// The world's speed of light in m/s; finite, positive.
    SpeedOfLight(f64),
    /// Change the vehicle.
    Vehicle(VehicleKind),
    /// Go back to the start.
    Restart,
    /// Take a picture.
    Photo,
    /// Start or stop recording.
    ToggleRecording,
    /// Show or hide the help.
    ToggleHelp,
}

impl Action {
    /// The text that the settings' decoder reads.
    pub fn to_bytes(&self) -> Box<[u8]> {
        serde_json::to_vec(self).expect("an action is always representable as JSON").into_boxed_slice()
    }

    /// Whether the numbers are of use.
    fn is_sound(self) -> bool {
        match self {
            Self::TimeScale(scale) => scale.is_finite() && scale >= 0.0,
            Self::ScaleTime(factor) | Self::SpeedOfLight(factor) => factor.is_finite() && factor > 0.0,
            _ => true,
        }
    }
}

/// Decoder of [`Source::Settings`](crate::Source::Settings): one JSON action a sample.
#[derive(Debug, Default)]
pub struct Settings {
    faults: Faults,
}

impl Decoder for Settings {
    fn reset(&mut self, _at: Nanos) {}

    fn bytes(&mut self, _at: Nanos, bytes: &[u8], actions: &mut Actions) {
        match serde_json::from_slice::<Action>(bytes) {
            Ok(action) if action.is_sound() => actions.push(action),
            Ok(action) => self.faults.count(format!("{action:?} is out of range")),
            Err(error) => self.faults.count(format!("not an action: {error}")),
        }
    }

    fn faults(&self) -> &Faults {
        &self.faults
    }
}

#[cfg(test)]
mod tests {
    //! An action must survive its own text, and a text that is none must not act.
    use super::*;

    fn decode(bytes: &[u8]) -> (Vec<Action>, u64) {
        let mut actions = Actions::default();
        let mut settings = Settings::default();
        settings.bytes(0, bytes, &mut actions);
        (actions.take(), settings.faults().number())
    }

    #[test]
    fn actions_survive_their_text() {
        for action in [
            Action::TogglePause,
            Action::Step,
            Action::TimeScale(0.1),
            Action::ScaleTime(0.5),
            Action::SpeedOfLight(30.0 / 3.6),
            Action::Vehicle(VehicleKind::Fly),
            Action::Restart,
        ] {
            assert_eq!(decode(&action.to_bytes()), (vec![action], 0));
        }
    }

    #[test]
    fn texts_that_are_no_action_are_counted_and_do_nothing() {
        let bad: [&[u8]; 6] =
            [b"", b"\"fly\"", b"{\"time_scale\":-1}", b"{\"scale_time\":0}", b"{\"time_scale\":1e999}", b"\xff\xfe"];
        for bytes in bad {
            assert_eq!(decode(bytes), (vec![], 1), "{bytes:?}");
        }
    }
}
