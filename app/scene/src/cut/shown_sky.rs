//! Part of the observer's sky that a picture shows, and the error that it allows.

use glam::DVec3;
use physics::DirectionCone;
use view::{Camera, Sides};

use super::fineness::CutFineness;

/// Largest error allowed beside the picture, at any distance from it, radians: with a larger one a thing could be
/// drawn anywhere.
const LARGEST_ERROR_RAD: f64 = 0.5;

/// Part of the observer's sky that a picture shows.
pub struct ShownSky {
    /// Direction straight ahead, unit vector, observer's axes.
    forward: DVec3,
    /// Sides of the picture.
    sides: Sides,
    /// Focal length: pixels per radian straight ahead.
    focal_length: f64,
    /// Cosine of the angle from straight ahead to the farthest corner.
    corner_cosine: f64,
}

impl ShownSky {
    /// Sky of a camera's picture of `size` pixels.
    pub fn new(camera: &Camera, size: [u32; 2]) -> Self {
        let tangents = camera.tangents(size);
        Self {
            forward: camera.observer_from_eye * DVec3::NEG_Z,
            sides: Sides::of(camera, size, 0.0),
            focal_length: tangents.focal_length(size).max_element(),
            corner_cosine: 1.0 / (1.0 + tangents.farthest().length_squared()).sqrt(),
        }
    }

    /// Half the allowed error in a corner of the picture, radians. No place has a smaller limit, not even an edge
    /// that was cut before.
    pub fn least_allowed(&self, fineness: &CutFineness) -> f64 {
        0.5 * fineness.tolerance_px * self.corner_cosine * self.corner_cosine / self.focal_length
    }

    /// Allowed error of things within a cone, radians.
    pub fn allowed(&self, cone: &DirectionCone, fineness: &CutFineness) -> f64 {
        // A flat picture is a tangent of the angle from straight ahead: an angle there is 1/cos² as long.
        let aside = self.forward.dot(cone.axis).clamp(-1.0, 1.0).acos() + cone.radius_rad;
        let cosine = aside.min(0.5 * std::f64::consts::PI).cos().max(self.corner_cosine);
        let allowed = fineness.tolerance_px * cosine * cosine / self.focal_length;
        let gap = self.sides.gap(cone) - fineness.turn_rad;
        allowed.max(gap.min(LARGEST_ERROR_RAD))
    }
}
