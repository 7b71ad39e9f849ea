//! Sides of a picture, as planes through the eye.

use crate::camera::Camera;
use glam::{DMat3, DVec3};
use physics::DirectionCone;

/// Planes through the eye and the left, right, lower and upper side of a picture, as inward unit normals. What they
/// bound is the pyramid of directions that the picture shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sides(pub [DVec3; 4]);

impl Sides {
    /// Sides of a camera's picture of `size` pixels, observer's axes, moved outwards by `margin` pixels.
    pub fn of(camera: &Camera, size: [u32; 2], margin: f64) -> Self {
        let tangents = camera.tangents(size);
        let margin = margin / tangents.focal_length(size);
        let (low, high) = (tangents.low - margin, tangents.high + margin);
        // Inward normal of the side where x or y is that tangent.
        let side = |x: f64, y: f64, tan: f64| camera.observer_from_eye * DVec3::new(x, y, tan).normalize();
        Self([side(1.0, 0.0, low.x), side(-1.0, 0.0, -high.x), side(0.0, 1.0, low.y), side(0.0, -1.0, -high.y)])
    }

    /// The same sides in other axes.
    pub fn turned(self, target_from_source: &DMat3) -> Self {
        Self(self.0.map(|side| target_from_source * side))
    }

    /// Angle between a cone and the pyramid, radians, or less; negative where the cone reaches into it.
    pub fn gap(&self, cone: &DirectionCone) -> f64 {
        let beyond = |side: &DVec3| -side.dot(cone.axis).clamp(-1.0, 1.0).asin();
        self.0.iter().map(beyond).fold(f64::NEG_INFINITY, f64::max) - cone.radius_rad
    }

    /// True if the picture may show some of what is drawn in a cone: flat triangles between directions in it.
    pub fn may_show(&self, cone: &DirectionCone) -> bool {
        if !cone.is_convex() {
            return true;
        }
        let reach = cone.radius_rad.sin();
        self.0.iter().all(|side| side.dot(cone.axis) >= -reach)
    }
}
