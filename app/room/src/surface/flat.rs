//! Flat screens: rectangles.

use super::hit::{NEAREST, SurfaceHit};
use crate::turning::room_from_turned;
use crate::unit_square::inside;
use glam::{DVec2, DVec3};
use thiserror::Error;

/// Largest error of a rectangle's corners: the cosine of the angle between two sides, and the gap at the fourth
/// corner divided by the sum of the sides. Measured corners are never exact; within this tolerance they are made
/// rectangular.
const TOLERANCE: f64 = 2e-3;

/// Corners that do not form a rectangle.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum NotRectangle {
    /// A side without length, or a corner that is not finite.
    #[error("the sides of the rectangle are {width_m} m and {height_m} m long; each must have a length")]
    NoArea {
        /// Width, metres.
        width_m: f64,
        /// Height, metres.
        height_m: f64,
    },
    /// Two sides that are not at right angles.
    #[error("the sides meet at {angle_deg:.2}°, not at a right angle: the corners are those of no rectangle")]
    Oblique {
        /// Angle between the sides, degrees.
        angle_deg: f64,
    },
    /// A fourth corner that does not close the rectangle.
    #[error("upper_right is {off_m:.4} m from where the other three corners put it; leave it out, or correct it")]
    Open {
        /// Distance of the given corner from the expected one, metres.
        off_m: f64,
    },
}

/// Flat rectangular screen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FlatSurface {
    /// Lower left corner, room axes, metres.
    pub lower_left: DVec3,
    /// Vector from the lower left to the lower right corner, room axes, metres.
    pub right: DVec3,
    /// Vector from the lower left to the upper left corner, room axes, metres; at right angles to `right`.
    pub up: DVec3,
}

impl FlatSurface {
    /// Creates a screen from its lower left, lower right and upper left corners, as seen by the viewer.
    ///
    /// # Errors
    /// [`NotRectangle`] if the corners are off by more than 2 parts in 1000. Within that, `up` is made perpendicular.
    pub fn from_corners(lower_left: DVec3, lower_right: DVec3, upper_left: DVec3) -> Result<Self, NotRectangle> {
        let (right, up) = (lower_right - lower_left, upper_left - lower_left);
        let (width_m, height_m) = (right.length(), up.length());
        if !(width_m > 0.0 && height_m > 0.0 && width_m.is_finite() && height_m.is_finite()) {
            return Err(NotRectangle::NoArea { width_m, height_m });
        }
        let cosine = right.dot(up) / (width_m * height_m);
        if cosine.abs() > TOLERANCE {
            return Err(NotRectangle::Oblique { angle_deg: cosine.clamp(-1.0, 1.0).acos().to_degrees() });
        }
        Ok(Self { lower_left, right, up: up - right * (right.dot(up) / (width_m * width_m)) })
    }

    /// Checks that a fourth corner, the upper right, closes the rectangle.
    ///
    /// # Errors
    /// [`NotRectangle::Open`].
    pub fn closes(&self, upper_right: DVec3) -> Result<(), NotRectangle> {
        let off_m = (self.point(DVec2::ONE) - upper_right).length();
        let allowed = TOLERANCE * (self.right.length() + self.up.length());
        if off_m <= allowed { Ok(()) } else { Err(NotRectangle::Open { off_m }) }
    }

    /// Creates a screen from its centre, its width and height in metres, and its rotation from facing +z (degrees,
    /// see [`room_from_turned`]).
    ///
    /// # Errors
    /// [`NotRectangle::NoArea`].
    pub fn from_centre(centre: DVec3, size_m: DVec2, yaw_pitch_roll_deg: DVec3) -> Result<Self, NotRectangle> {
        let [yaw, pitch, roll] = yaw_pitch_roll_deg.to_array();
        let turned = room_from_turned(yaw, pitch, roll);
        let (right, up) = (turned.x_axis * size_m.x, turned.y_axis * size_m.y);
        let corner = centre - 0.5 * (right + up);
        if size_m.min_element() <= 0.0 {
            return Err(NotRectangle::NoArea { width_m: size_m.x, height_m: size_m.y });
        }
        Self::from_corners(corner, corner + right, corner + up)
    }

    /// Part of the screen between `from`, its lower left, and `to`, its upper right, both in uv.
    pub fn part(&self, from: DVec2, to: DVec2) -> Self {
        let size = to - from;
        Self { lower_left: self.point(from), right: self.right * size.x, up: self.up * size.y }
    }

    /// Point at a place, uv 0 to 1 from the lower left; room axes, metres.
    pub fn point(&self, uv: DVec2) -> DVec3 {
        self.lower_left + self.right * uv.x + self.up * uv.y
    }

    /// Unit vector towards the viewer's side, room axes.
    pub fn normal(&self) -> DVec3 {
        self.right.cross(self.up).normalize()
    }

    /// Width and height, metres.
    pub fn size_m(&self) -> DVec2 {
        DVec2::new(self.right.length(), self.up.length())
    }

    pub(super) fn hit(&self, origin: DVec3, direction: DVec3) -> Option<SurfaceHit> {
        let normal = self.normal();
        let distance = (self.lower_left - origin).dot(normal) / direction.dot(normal);
        let nearest = NEAREST * self.size_m().max_element() / direction.length();
        if !(distance.is_finite() && distance > nearest) {
            return None;
        }
        let offset = origin + direction * distance - self.lower_left;
        Some(SurfaceHit { distance, point: self.lower_left + offset, normal, uv: self.uv(offset)? })
    }

    /// Place uv of a point given relative to the lower left corner; `None` outside the screen.
    pub(super) fn uv(&self, offset: DVec3) -> Option<DVec2> {
        let (right, up) = (self.right.length_squared(), self.up.length_squared());
        let uv = DVec2::new(offset.dot(self.right) / right, offset.dot(self.up) / up);
        inside(uv).then(|| uv.clamp(DVec2::ZERO, DVec2::ONE))
    }
}
