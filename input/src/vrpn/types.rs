//! Names of the types of message that are read.

/// Type of a pose.
pub const POSE: &str = "vrpn_Tracker Pos_Quat";
/// Type of a velocity.
pub const VELOCITY: &str = "vrpn_Tracker Velocity";
/// Type of a ping, which asks for an answer.
pub const PING: &str = "vrpn_Base ping_message";
/// Type of the answer to a ping.
pub const PONG: &str = "vrpn_Base pong_message";
/// Type of a button that was pressed or released.
pub const BUTTON: &str = "vrpn_Button Change";
/// Type of the state of all buttons.
pub const BUTTONS: &str = "vrpn_Button States";
/// Type of the values of all analog channels.
pub const CHANNELS: &str = "vrpn_Analog Channel";
