//! Actions: things that happen once, at a press, and the decoder of those that the interface sends.
//!
//! Buttons of any device and the program's own panels end in the same list. What a panel sends is a
//! small JSON text (`"step"`, `{"time_scale":0.5}`) that passes through the recording like any
//! other device's bytes.

use serde::{Deserialize, Serialize};

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
    pub(crate) fn is_sound(self) -> bool {
        match self {
            Self::TimeScale(scale) => scale.is_finite() && scale >= 0.0,
            Self::ScaleTime(factor) | Self::SpeedOfLight(factor) => factor.is_finite() && factor > 0.0,
            _ => true,
        }
    }
}
