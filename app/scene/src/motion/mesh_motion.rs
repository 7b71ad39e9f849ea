//! Ways in which meshes move.

use super::animated::Animated;
use super::uniform::Uniform;
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
