//! The head: from a tracker's poses to where the eyes are and how fast they go.
//!
//! A tracker says how its sensor stands in its own axes. With the two transforms that the laboratory
//! has measured,
//!
//! room_from_head = room_from_tracker · tracker_from_sensor · sensor_from_head,
//!
//! where the head's origin is midway between the eyes, so the velocity, made of differences of that
//! origin's places, is the eyes' and not the sensor's: when the head turns, the two differ.
//!
//! Times: a velocity is a difference of the times at which the tracker *measured*, where it says so,
//! for those do not jitter with the network; how old a pose is goes by its arrival.
//!
//! What cannot be is rejected and counted ([`PoseError`]): numbers that are none, quaternions that are
//! none, poses that are older than the last, and leaps faster than anybody moves, unless the next pose
//! says the same. A head that is lost keeps its place, and its velocity fades. Nothing ever takes it
//! to the origin.

pub(crate) mod config;
pub(crate) mod mouse;
pub(crate) mod mouse_event;
mod placement;
mod rigid;
mod seen;
pub(crate) mod state;
#[cfg(test)]
mod tests;
pub(crate) mod tracked_head;
pub(crate) mod tracked_pose;
pub(crate) mod url;
mod velocity;

pub use config::{HeadConfig, TrackingMode, VelocityFilter};
pub use mouse::MouseDecoder;
pub use mouse_event::{MouseButton, MouseEvent};
pub use placement::AxesPlacement;
pub use rigid::Rigid;
pub use seen::PoseError;
pub use state::{HeadState, Tracking};
pub use tracked_head::TrackedHead;
pub use tracked_pose::TrackedPose;
pub use url::{TrackerUrl, TrackerUrlError};
pub use velocity::TrackVelocity;

pub use tracked_head::TrackedHead as Head; // until app is moved
