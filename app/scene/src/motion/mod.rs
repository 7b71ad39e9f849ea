//! Motions of meshes: uniform motion and keyed animation.
//!
//! Uniform motion (`uniform`): the body has a frame of its own, in which it rests. Animation: keys (`track`) move a
//! chain of transforms (`animated`); then each point has a worldline, and an observer sees each at its own retarded
//! event (`observed_body`). Keys give the position of every point at each moment of the world; no length contraction is
//! added.

mod animated;
mod camera_motion;
mod mesh_motion;
mod observed_body;
mod track;
mod uniform;

pub use animated::{Animated, Ball, ChainLink, Keyed, Pose};
pub use camera_motion::{CameraMotion, CameraPose};
pub use mesh_motion::Motion;
pub use observed_body::{ObservedBody, SeenPoint};
pub use track::{KeyFault, Track, TrackKeys};
pub use uniform::{SeenBy, Uniform};
