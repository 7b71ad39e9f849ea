//! The eye that a photo-surface is seen by.

use glam::DVec3;

use super::error::PhotoSurfaceError;

/// Where the light is received: a point of the world and the velocity of whoever looks from there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Eye {
    position: DVec3,
    celerity: DVec3,
}

impl Eye {
    /// An eye at `position` (world frame, metres) that moves with `celerity` u = γβ (world axes).
    ///
    /// # Errors
    /// [`PhotoSurfaceError::Eye`] if either is not finite.
    pub fn new(position: DVec3, celerity: DVec3) -> Result<Self, PhotoSurfaceError> {
        if position.is_finite() && celerity.is_finite() {
            Ok(Self { position, celerity })
        } else {
            Err(PhotoSurfaceError::Eye { position, celerity })
        }
    }

    /// Where the eye is when it receives the light; world frame, metres.
    pub fn position(&self) -> DVec3 {
        self.position
    }

    /// The eye's celerity in the world frame.
    pub fn celerity(&self) -> DVec3 {
        self.celerity
    }
}
