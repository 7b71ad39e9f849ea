//! What of a scene moves, and how.
//!
//! Uniformly: then it has a frame of its own, in which it rests (`uniform`). Or as keys say (`track`) that a chain of transforms holds
//! (`animated`): then each of its points has a worldline, and an observer sees each at its own retarded event (`course`). What keys say is where
//! every point is at each moment of the world; no contraction is added.

mod animated;
mod course;
mod limit;
mod track;
mod uniform;

pub use animated::{Animated, Ball, Keyed, Link, Pose};
pub use course::{Course, Seen};
pub use limit::{Fastest, TooFast};
pub use track::{KeyFault, Keys, Track};
pub use uniform::{SeenBy, Uniform};

use std::sync::Arc;

/// How meshes move.
#[derive(Clone, Debug, PartialEq)]
pub enum Motion {
    /// Always at one celerity.
    Uniform(Uniform),
    /// As keys say.
    Animated(Arc<Animated>),
}

impl Motion {
    /// The chain of transforms, if keys say how it moves.
    pub fn animated(&self) -> Option<&Arc<Animated>> {
        match self {
            Self::Uniform(_) => None,
            Self::Animated(animated) => Some(animated),
        }
    }
}
