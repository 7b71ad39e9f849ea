//! Names of the types of message that matter.

/// Type of a pose.
pub const POSE: &str = "vrpn_Tracker Pos_Quat";
/// Type of a velocity.
pub const VELOCITY: &str = "vrpn_Tracker Velocity";
/// Type of the question whether somebody is there.
pub const PING: &str = "vrpn_Base ping_message";
/// Type of its answer.
pub const PONG: &str = "vrpn_Base pong_message";
