//! VRPN: trackers of nearly every make, through a server with one protocol.
//!
//! The server chooses numbers for its senders (devices) and types of messages, and describes each number before it is
//! used. The decoder keeps the numbers of the names that it needs and passes over every message whose numbers have
//! not been described: over other transports such messages come early, so they are no fault.
//!
//! | message | payload |
//! |---|---|
//! | `vrpn_Tracker Pos_Quat` | i32 sensor, i32 filler, f64 × 3 position (m), f64 × 4 quaternion (x, y, z, w) |
//! | `vrpn_Tracker Velocity` | i32 sensor, i32 filler, f64 × 3 velocity (m/s), f64 × 5 of turning |
//! | `vrpn_Button Change` | i32 button, i32 state |
//! | `vrpn_Button States` | i32 number of buttons, i32 state × that |
//! | `vrpn_Analog Channel` | f64 number of channels, f64 value × that |
//!
//! The axes are those that the laboratory has calibrated.

pub(crate) mod decoder;
#[cfg(test)]
pub(crate) mod golden;
pub(crate) mod numbers;
mod payload;
pub(crate) mod types;
pub mod wire;

pub use decoder::VrpnDecoder;
pub use numbers::VrpnNumbers;
pub use types::{BUTTON, BUTTONS, CHANNELS, PING, PONG, POSE, VELOCITY};
