//! Motions of meshes: uniform motion and keyed animation.
//!
//! Uniform motion (`uniform`): the body has a frame of its own, in which it rests. Animation: keys (`track`) move a
//! chain of transforms (`animated`); then each point has a worldline, and an observer sees each at its own retarded
//! event (`course`). Keys give the position of every point at each moment of the world; no length contraction is
//! added.

mod animated;
mod course;
mod mesh_motion;
mod track;
mod uniform;

pub use animated::{Animated, Ball, Keyed, Link, Pose};
pub use course::{Course, Seen};
pub use mesh_motion::Motion;
pub use track::{KeyFault, Keys, Track};
pub use uniform::{SeenBy, Uniform};
