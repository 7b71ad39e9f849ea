//! Part of the observer's sky that a picture shows, and the error that it allows.

use glam::DVec3;
use view::Camera;

use super::fineness::CutFineness;

/// Largest error allowed beside the picture, at any distance from it, radians: with a larger one a thing could be
/// drawn anywhere.
const LARGEST_ERROR_RAD: f64 = 0.5;

/// Part of the observer's sky that a picture shows.
pub struct ShownSky {
    /// Direction straight ahead, unit vector, observer's axes.
    forward: DVec3,
    /// Inward unit normals of the planes through the eye and the picture's sides.
    planes: [DVec3; 4],
    /// Focal length: pixels per radian straight ahead.
    focal_length: f64,
    /// Cosine of the angle from straight ahead to the farthest corner.
    corner_cosine: f64,
}

impl ShownSky {
    /// Sky of a camera's picture of `size` pixels.
    pub fn new(camera: &Camera, size: [u32; 2]) -> Self {
        let tangents = camera.tangents(size);
        let (low, high, farthest) = (tangents.low, tangents.high, tangents.farthest());
        // Inward normal of the side where x or y is that tangent.
        let side = |x: f64, y: f64, tan: f64| camera.observer_from_eye * DVec3::new(x, y, tan).normalize();
        Self {
            forward: camera.observer_from_eye * DVec3::NEG_Z,
            planes: [side(1.0, 0.0, low.x), side(-1.0, 0.0, -high.x), side(0.0, 1.0, low.y), side(0.0, -1.0, -high.y)],
            focal_length: tangents.focal_length(size).max_element(),
            corner_cosine: 1.0 / (1.0 + farthest.length_squared()).sqrt(),
        }
    }

    /// Half the allowed error in a corner of the picture, radians. No place has a smaller limit, not even an edge
    /// that was cut before.
    pub fn least_allowed(&self, fineness: &CutFineness) -> f64 {
        0.5 * fineness.tolerance_px * self.corner_cosine * self.corner_cosine / self.focal_length
    }

    /// Allowed error of things within a cone, radians.
    pub fn allowed(&self, direction: DVec3, radius: f64, fineness: &CutFineness) -> f64 {
        // A flat picture is a tangent of the angle from straight ahead: an angle there is 1/cos² as long.
        let aside = self.forward.dot(direction).clamp(-1.0, 1.0).acos() + radius;
        let cosine = aside.min(0.5 * std::f64::consts::PI).cos().max(self.corner_cosine);
        let allowed = fineness.tolerance_px * cosine * cosine / self.focal_length;
        let beyond = |plane: &DVec3| -plane.dot(direction).clamp(-1.0, 1.0).asin();
        let gap = self.planes.iter().map(beyond).fold(f64::NEG_INFINITY, f64::max) - radius - fineness.turn_rad;
        allowed.max(gap.min(LARGEST_ERROR_RAD))
    }
}
