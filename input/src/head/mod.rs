//! The head: from a tracker's poses to the place and velocity of the eyes.
//!
//! A tracker gives the pose of its sensor in its own axes. With the two transforms that the laboratory has measured,
//!
//! room_from_head = room_from_tracker · tracker_from_sensor · sensor_from_head,
//!
//! where the head's origin is midway between the eyes. What the tracker sends is first made right-handed and metric
//! ([`FlipAxis`], [`LengthUnit`]). At a desk, where nobody measures, the rider declares a pose to be the straight one
//! instead ([`Recentring`]): room_from_head is then home · straight⁻¹ times the above.
//!
//! A rider may also turn in steps about the vertical through the head, which turns these axes and moves nothing in
//! them: place stays, and orientation and velocities turn.
//!
//! The velocity is made from differences of that origin's places,
//! so it is the velocity of the eyes, not of the sensor: when the head turns, the two differ.
//!
//! A velocity uses the times at which the tracker *measured*, where it gives them, because these do not jitter with
//! the network. The age of a pose is counted from its arrival.
//!
//! Impossible poses are rejected and counted ([`PoseError`]): numbers that are not finite, quaternions that are not
//! of length one, poses that are older than the last, and leaps faster than any person moves, unless the next pose
//! confirms the leap. A head that is lost keeps its place, and its velocity fades. It is never moved to the origin.

pub(crate) mod config;
pub(crate) mod flip;
pub(crate) mod heard;
pub(crate) mod mouse;
pub(crate) mod mouse_event;
pub(crate) mod placement;
pub(crate) mod rigid;
mod seen;
pub(crate) mod snap_step;
pub(crate) mod stance;
pub(crate) mod state;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod tests_of_comfort;
#[cfg(test)]
mod tests_of_desks;
pub(crate) mod tracked_head;
pub(crate) mod tracked_pose;
pub(crate) mod tracking_mode;
mod unit;
pub(crate) mod url;
mod velocity;

pub use config::{HEAD_EDITION, HeadConfig, Recentring, VelocityFilter};
pub use flip::FlipAxis;
pub use heard::{HeardKind, HeardSensor, MOST_HEARD};
pub use mouse::MouseDecoder;
pub use mouse_event::{MouseButton, MouseEvent};
pub use placement::AxesPlacement;
pub use rigid::Rigid;
pub use seen::PoseError;
pub use stance::{Stance, StanceError};
pub use state::{HeadState, Tracking};
pub use tracked_head::TrackedHead;
pub use tracked_pose::TrackedPose;
pub use tracking_mode::TrackingMode;
pub use unit::{LengthUnit, LengthUnitError};
pub use url::{TrackerUrl, TrackerUrlError};
pub use velocity::TrackVelocity;
