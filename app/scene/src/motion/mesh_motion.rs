//! Ways in which meshes move.

use super::animated::Animated;
use super::uniform::Uniform;
use std::sync::Arc;

/// Motion of meshes.
#[derive(Clone, Debug, PartialEq)]
pub enum Motion {
    /// Uniform motion at one celerity.
    Uniform(Uniform),
    /// Motion given by keys.
    Animated(Arc<Animated>),
}

impl Motion {
    /// Animated body, if the motion is given by keys.
    pub fn animated(&self) -> Option<&Arc<Animated>> {
        match self {
            Self::Uniform(_) => None,
            Self::Animated(animated) => Some(animated),
        }
    }
}
