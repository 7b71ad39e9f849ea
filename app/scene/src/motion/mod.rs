//! What of a scene moves, and how.
//!
//! Uniformly: then it has a frame of its own, in which it rests (`uniform`). Or as keys say (`track`) that a chain of transforms holds
//! (`animated`): then each of its points has a worldline, and an observer sees each at its own retarded event (`course`). What keys say is where
//! every point is at each moment of the world; no contraction is added.

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
