//! Part of a sphere, seen from inside: a dome.

use super::hit::{NEAREST, SurfaceHit};
use super::round::{crossings, share};
use crate::unit_square::EDGE;
use glam::{DVec2, DVec3};

/// Section of a sphere between two yaws and two pitches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SphereSurface {
    /// Centre of the sphere, room axes, metres.
    pub centre: DVec3,
    /// Radius of the sphere, metres.
    pub radius_m: f64,
    /// Yaw of the left edge from −z, radians, positive to the left.
    pub left_rad: f64,
    /// Yaw of the right edge, radians; less than `left_rad`, by at most 2π.
    pub right_rad: f64,
    /// Pitch of the lower edge, radians.
    pub bottom_rad: f64,
    /// Pitch of the upper edge, radians.
    pub top_rad: f64,
}

impl SphereSurface {
    /// Point at a place, uv 0 to 1 from the lower left; room axes, metres.
    pub fn point(&self, uv: DVec2) -> DVec3 {
        self.centre - self.normal(uv) * self.radius_m
    }

    /// Unit vector from the dome to the centre, room axes.
    pub fn normal(&self, uv: DVec2) -> DVec3 {
        let (sin_yaw, cos_yaw) = (self.left_rad + uv.x * (self.right_rad - self.left_rad)).sin_cos();
        let (sin_pitch, cos_pitch) = (self.bottom_rad + uv.y * (self.top_rad - self.bottom_rad)).sin_cos();
        DVec3::new(sin_yaw * cos_pitch, -sin_pitch, cos_yaw * cos_pitch)
    }

    /// Width along the section's widest circle and height up its middle, metres.
    pub fn size_m(&self) -> DVec2 {
        let widest = if self.bottom_rad <= 0.0 && self.top_rad >= 0.0 {
            1.0
        } else {
            self.bottom_rad.cos().max(self.top_rad.cos())
        };
        self.radius_m * DVec2::new(widest * (self.left_rad - self.right_rad), self.top_rad - self.bottom_rad)
    }

    /// First hit of a ray.
    ///
    /// *Equation.* For a ray that starts on the sphere, B eq. 4.8: the second crossing.
    pub(super) fn hit(&self, origin: DVec3, direction: DVec3) -> Option<SurfaceHit> {
        let from = origin - self.centre;
        let nearest = NEAREST * self.radius_m / direction.length();
        let constant = from.length_squared() - self.radius_m * self.radius_m;
        crossings(direction.length_squared(), from.dot(direction), constant)
            .into_iter()
            .filter(|distance| distance.is_finite() && *distance > nearest)
            .find_map(|distance| {
                let offset = from + direction * distance;
                let uv = self.uv(offset)?;
                Some(SurfaceHit { distance, point: self.centre + offset, normal: -offset.normalize(), uv })
            })
    }

    /// Place uv of a point given relative to the centre; `None` outside the section.
    pub(super) fn uv(&self, offset: DVec3) -> Option<DVec2> {
        let u = share(-offset.x.atan2(-offset.z), self.left_rad, self.right_rad)?;
        let pitch = offset.y.atan2(offset.x.hypot(offset.z));
        let v = (pitch - self.bottom_rad) / (self.top_rad - self.bottom_rad);
        (-EDGE..=1.0 + EDGE).contains(&v).then(|| DVec2::new(u, v.clamp(0.0, 1.0)))
    }
}
