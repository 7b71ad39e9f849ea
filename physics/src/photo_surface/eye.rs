//! The eye that a photo-surface is seen by.

use glam::DVec3;

use super::error::PhotoSurfaceError;
use crate::celerity::Celerity;
use crate::observer::Observer;

/// Place at which light is received, and celerity of the observer there. An [`Observer`] without its time, which a
/// photo-surface of things at rest does not depend on.
///
/// The celerity is always finite. The position is finite if the eye comes from [`PhotoSurfaceEye::new`]; an eye made
/// from an observer has the observer's position, whatever it is. Nothing has a finite place relative to a position that
/// is not finite: the kernel then writes every vertex as zeros with D = 0 and counts it in [`Stats`](super::Stats).
///
/// # Example
/// ```
/// use physics::photo_surface::PhotoSurfaceEye;
/// use physics::{Celerity, Event, Observer, glam::DVec3};
///
/// let celerity = Celerity::new(DVec3::NEG_Z * 0.75)?;
/// let observer = Observer { event: Event { ct: 3.0, position: DVec3::Y }, celerity };
/// let eye = PhotoSurfaceEye::from(&observer);
/// assert_eq!((eye.position(), eye.celerity()), (DVec3::Y, celerity));
/// # Ok::<(), physics::CelerityError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PhotoSurfaceEye {
    position: DVec3,
    celerity: Celerity,
}

impl PhotoSurfaceEye {
    /// An eye at `position` (world frame, metres) that moves with `celerity` u = γβ (world axes).
    ///
    /// [`PhotoSurfaceEye::from`] makes an eye from an [`Observer`] without a check.
    ///
    /// # Errors
    /// [`PhotoSurfaceError::Eye`] if either is not finite, or the celerity is beyond [`Celerity::LIMIT`].
    pub fn new(position: DVec3, celerity: DVec3) -> Result<Self, PhotoSurfaceError> {
        match Celerity::new(celerity) {
            Ok(celerity) if position.is_finite() => Ok(Self { position, celerity }),
            _ => Err(PhotoSurfaceError::Eye { position, celerity }),
        }
    }

    /// Position of the eye when it receives the light; world frame, metres.
    pub fn position(&self) -> DVec3 {
        self.position
    }

    /// Celerity of the eye; world axes.
    pub fn celerity(&self) -> Celerity {
        self.celerity
    }
}

impl From<&Observer> for PhotoSurfaceEye {
    fn from(observer: &Observer) -> Self {
        Self { position: observer.event.position, celerity: observer.celerity }
    }
}

impl From<&Self> for PhotoSurfaceEye {
    fn from(eye: &Self) -> Self {
        *eye
    }
}
