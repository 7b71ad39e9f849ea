//! Shifts and turns in the form of the settings: metres and degrees, under the keys of a table.

use std::ops::RangeInclusive;

use glam::{DQuat, DVec3, EulerRot};
use serde::{Deserialize, Serialize};

use super::rigid::Rigid;
use crate::config_error::ConfigError;

/// Largest distance from the room's origin along each axis, metres.
pub(super) const FARTHEST_M: f64 = 1000.0;
/// Lengths of quaternions that count as one.
pub(super) const UNIT_LENGTHS: RangeInclusive<f64> = 1.0 - 1e-2..=1.0 + 1e-2;

/// Placement of one body's axes in another's: turned, then shifted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct AxesPlacement {
    /// Origin of the body in the other's axes, metres.
    pub position: [f64; 3],
    /// Turn about y, to the left, degrees; applied last.
    pub yaw: f64,
    /// Turn about x, nose up, degrees.
    pub pitch: f64,
    /// Turn about z, to the left, degrees; applied first.
    pub roll: f64,
    /// Turn as a quaternion (x, y, z, w), instead of the angles.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub quaternion: Option<[f64; 4]>,
}

impl AxesPlacement {
    /// Transform of this placement.
    pub fn rigid(&self) -> Rigid {
        let angles = [self.yaw, self.pitch, self.roll].map(f64::to_radians);
        let orientation = match self.quaternion {
            Some(quaternion) => DQuat::from_array(quaternion).normalize(),
            None => DQuat::from_euler(EulerRot::YXZ, angles[0], angles[1], angles[2]),
        };
        Rigid { position: DVec3::from_array(self.position), orientation }
    }

    /// Checks the values; `keys` are their names for the error.
    pub(crate) fn check(&self, keys: &PlacementKeys) -> Result<(), ConfigError> {
        within(keys.position, self.position)?;
        for (key, angle) in [(keys.yaw, self.yaw), (keys.pitch, self.pitch), (keys.roll, self.roll)] {
            if !(-360.0..=360.0).contains(&angle) {
                return Err(ConfigError {
                    key,
                    value: angle.to_string(),
                    expected: "an angle from -360 to 360 degrees",
                });
            }
        }
        let Some(quaternion) = self.quaternion else {
            return Ok(());
        };
        let bad = |expected| ConfigError { key: keys.quaternion, value: format!("{quaternion:?}"), expected };
        if !UNIT_LENGTHS.contains(&DQuat::from_array(quaternion).length()) {
            return Err(bad("x, y, z, w of length 1"));
        }
        if [self.yaw, self.pitch, self.roll] != [0.0; 3] {
            return Err(bad("a quaternion or yaw, pitch and roll, not both"));
        }
        Ok(())
    }
}

/// Full names of a placement's keys.
pub(crate) struct PlacementKeys {
    pub(super) position: &'static str,
    yaw: &'static str,
    pitch: &'static str,
    roll: &'static str,
    quaternion: &'static str,
}

macro_rules! placement_keys {
    ($table:literal) => {
        PlacementKeys {
            position: concat!($table, ".position"),
            yaw: concat!($table, ".yaw"),
            pitch: concat!($table, ".pitch"),
            roll: concat!($table, ".roll"),
            quaternion: concat!($table, ".quaternion"),
        }
    };
}

pub(super) const ROOM_FROM_TRACKER: PlacementKeys = placement_keys!("tracker.room_from_tracker");
pub(crate) const WAND_FROM_SENSOR: PlacementKeys = placement_keys!("tracker.wand.wand_from_sensor");
pub(super) const HEAD_FROM_SENSOR: PlacementKeys = placement_keys!("tracker.head_from_sensor");

/// Checks that a place is near the origin.
pub(super) fn within(key: &'static str, position: [f64; 3]) -> Result<(), ConfigError> {
    if position.iter().all(|coordinate| coordinate.abs() <= FARTHEST_M) {
        Ok(())
    } else {
        let value = format!("{position:?}");
        Err(ConfigError { key, value, expected: "three numbers of metres, each from -1000 to 1000" })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn yaw_is_to_the_left_pitch_nose_up_roll_to_the_left() {
        let forward = |placement: AxesPlacement| placement.rigid().orientation * DVec3::NEG_Z;
        let near = |a: DVec3, b: DVec3| assert!((a - b).length() < 1e-15, "{a} for {b}");
        near(forward(AxesPlacement { yaw: 90.0, ..Default::default() }), DVec3::NEG_X);
        near(forward(AxesPlacement { pitch: 90.0, ..Default::default() }), DVec3::Y);
        let rolled = AxesPlacement { roll: 90.0, ..Default::default() }.rigid().orientation;
        near(rolled * DVec3::Y, DVec3::NEG_X);
        // Yaw is applied last.
        near(
            forward(AxesPlacement { yaw: 90.0, pitch: 45.0, ..Default::default() }),
            DVec3::new(-0.5, 0.5, 0.0) * 2_f64.sqrt(),
        );
    }
}
