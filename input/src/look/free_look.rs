//! Turn of the gaze against the nose.

use glam::{DQuat, EulerRot};
use serde::{Deserialize, Serialize};

/// Largest pitch of the look, up or down, radians: 85 degrees.
pub const STEEPEST_LOOK_RAD: f64 = 85.0 * std::f64::consts::PI / 180.0;

/// Turn of the gaze against the nose.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FreeLook {
    /// Angle to the left of the nose, radians, −π to π.
    pub yaw_rad: f64,
    /// Angle above the nose, after the turn to the side, radians.
    pub pitch_rad: f64,
}

impl FreeLook {
    /// True if the look goes along the nose.
    pub fn is_ahead(&self) -> bool {
        self.yaw_rad == 0.0 && self.pitch_rad == 0.0
    }

    /// Rotation from the axes of the turned gaze to those along the nose (x right, y up, −z ahead).
    pub fn nose_from_gaze(&self) -> DQuat {
        DQuat::from_euler(EulerRot::YXZ, self.yaw_rad, self.pitch_rad, 0.0)
    }
}
