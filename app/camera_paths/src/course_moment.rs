//! Camera at one moment of a course.

use glam::DQuat;
use physics::Observer;

/// Camera at one moment of its own time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct CourseMoment {
    /// Event and celerity of the eye.
    pub(crate) observer: Observer,
    /// Rotation from the eye's axes to the observer's.
    pub(crate) turn: DQuat,
    /// Vertical field of view, degrees, if the path gives one.
    pub(crate) fov_deg: Option<f64>,
}
