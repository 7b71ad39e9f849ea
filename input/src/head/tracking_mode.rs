//! Use that is made of a tracked head.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::state::HeadState;

/// Parts of the tracked head that are used (W 6.4).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum TrackingMode {
    /// Place, turn and velocity of the head.
    #[default]
    PositionAndVelocity,
    /// Place and turn of the head; it counts as resting in the vehicle.
    Position,
    /// Tracking switched off.
    None,
}

impl TrackingMode {
    /// Next use in order; the first one follows the last.
    pub fn next(self) -> Self {
        match self {
            Self::PositionAndVelocity => Self::Position,
            Self::Position => Self::None,
            Self::None => Self::PositionAndVelocity,
        }
    }

    /// Part of a head's state that this mode uses; `None` without tracking.
    pub fn of(self, state: HeadState) -> Option<HeadState> {
        match self {
            Self::PositionAndVelocity => Some(state),
            Self::Position => Some(HeadState { velocity_m_s: DVec3::ZERO, turn_rad_s: DVec3::ZERO, ..state }),
            Self::None => None,
        }
    }
}
