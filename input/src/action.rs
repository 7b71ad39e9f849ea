//! Actions: commands that take effect once, at a press.
//!
//! Buttons of any device and the program's own panels end in the same list. A panel sends a small JSON text
//! (`"step"`, `{"time_scale":0.5}`), which passes through the recording like any other device's bytes.

use serde::{Deserialize, Serialize};

/// Vehicle that the controls drive.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum VehicleKind {
    /// Bicycle: wheel speed, handlebar and brake (B 5.6.1).
    #[default]
    Bicycle,
    /// Thrust in the horizontal plane.
    Drive,
    /// Thrust in three directions, and roll.
    Fly,
}

/// Command that takes effect once.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Action {
    /// Stops the clock, or lets it run.
    TogglePause,
    /// Advances by one step while paused.
    Step,
    /// Proper time per real time; finite, not negative.
    TimeScale(f64),
    /// Factor on the time scale; finite, positive.
    ScaleTime(f64),
    /// Speed of light in the world, m/s; finite, positive.
    SpeedOfLight(f64),
    /// Change of the vehicle.
    Vehicle(VehicleKind),
    /// Look along the nose again.
    LookAhead,
    /// Makes the present pose of a tracked head the straight one.
    Recentre,
    /// Return to the start.
    Restart,
    /// Request for a picture.
    Photo,
    /// Starts or stops recording.
    ToggleRecording,
    /// Shows or hides the help.
    ToggleHelp,
}

impl Action {
    /// JSON text of the action, as the settings' decoder reads it.
    pub fn to_bytes(&self) -> Box<[u8]> {
        serde_json::to_vec(self).expect("an action is always representable as JSON").into_boxed_slice()
    }

    /// True if the numbers of the action are in their ranges.
    pub(crate) fn is_sound(self) -> bool {
        match self {
            Self::TimeScale(scale) => scale.is_finite() && scale >= 0.0,
            Self::ScaleTime(factor) | Self::SpeedOfLight(factor) => factor.is_finite() && factor > 0.0,
            _ => true,
        }
    }
}
