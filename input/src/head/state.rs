//! The head at one moment, as the rest of the program sees it.

use glam::{DQuat, DVec3};
use serde::{Deserialize, Serialize};

/// How far a head is to be believed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Tracking {
    /// The tracker has not seen it yet.
    #[default]
    Never,
    /// The tracker sees it.
    Tracked,
    /// It has just been lost: its velocity fades.
    Fading,
    /// It has been lost: it is where it was, at rest.
    Lost,
}

/// The head at one moment.
///
/// *Frames, units*: the room's axes: x right, y up, z backward; metres.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct HeadState {
    /// Midway between the eyes.
    pub position_m: DVec3,
    /// `room_from_head`: the head looks along its −z, its right ear is at +x.
    pub orientation: DQuat,
    /// Velocity in the room, metres per second of the user's own clock. Way in the vehicle's frame over proper time is
    /// c times the celerity; the crate that knows c divides by it.
    pub velocity_m_s: DVec3,
    /// How far this is to be believed.
    pub tracked: Tracking,
}
