//! State of the head at one moment.

use glam::{DQuat, DVec3};
use serde::{Deserialize, Serialize};

/// Reliability of a head's state.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Tracking {
    /// The tracker has not seen the head yet.
    #[default]
    Never,
    /// The tracker sees the head.
    Tracked,
    /// The head has just been lost: its velocity fades.
    Fading,
    /// The head has been lost: it rests at its last place.
    Lost,
}

/// State of the head at one moment.
///
/// *Frames, units*: the room's axes: x right, y up, z backward; metres.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct HeadState {
    /// Point midway between the eyes, metres.
    pub position_m: DVec3,
    /// Turn `room_from_head`: the head looks along its −z, and its right ear is at +x.
    pub orientation: DQuat,
    /// Velocity in the room, metres per second of the user's own clock. Distance in the vehicle's frame over proper
    /// time is c times the celerity; the crate that knows c divides by it.
    pub velocity_m_s: DVec3,
    /// Turn in the room, radians per second of the user's own clock, right-handed; 0 in recordings of edition 1.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub turn_rad_s: DVec3,
    /// Reliability of this state.
    pub tracked: Tracking,
}

fn is_zero(turn: &DVec3) -> bool {
    *turn == DVec3::ZERO
}
