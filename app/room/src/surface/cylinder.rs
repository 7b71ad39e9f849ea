//! Part of an upright cylinder, seen from inside.

use super::hit::{NEAREST, SurfaceHit};
use super::round::{crossings, share};
use crate::unit_square::EDGE;
use glam::{DVec2, DVec3, Vec3Swizzles};

/// Curved wall around a vertical axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CylinderSurface {
    /// Point of the axis from which `bottom_m` and `top_m` are counted, room axes, metres.
    pub centre: DVec3,
    /// Radius of the cylinder, metres.
    pub radius_m: f64,
    /// Yaw of the left edge from −z, radians, positive to the left.
    pub left_rad: f64,
    /// Yaw of the right edge, radians; less than `left_rad`, by at most 2π.
    pub right_rad: f64,
    /// Height of the lower edge above `centre`, metres.
    pub bottom_m: f64,
    /// Height of the upper edge above `centre`, metres.
    pub top_m: f64,
}

impl CylinderSurface {
    /// Point at a place, uv 0 to 1 from the lower left; room axes, metres.
    pub fn point(&self, uv: DVec2) -> DVec3 {
        let height = self.bottom_m + uv.y * (self.top_m - self.bottom_m);
        self.centre - self.normal(uv) * self.radius_m + DVec3::Y * height
    }

    /// Unit vector from the wall to the axis, room axes.
    pub fn normal(&self, uv: DVec2) -> DVec3 {
        let (sin, cos) = (self.left_rad + uv.x * (self.right_rad - self.left_rad)).sin_cos();
        DVec3::new(sin, 0.0, cos)
    }

    /// Width along the arc and height, metres.
    pub fn size_m(&self) -> DVec2 {
        DVec2::new(self.radius_m * (self.left_rad - self.right_rad), self.top_m - self.bottom_m)
    }

    pub(super) fn hit(&self, origin: DVec3, direction: DVec3) -> Option<SurfaceHit> {
        let from = origin - self.centre;
        let (o, d) = (from.xz(), direction.xz());
        let nearest = NEAREST * self.radius_m / direction.length();
        crossings(d.length_squared(), o.dot(d), o.length_squared() - self.radius_m * self.radius_m)
            .into_iter()
            .filter(|distance| distance.is_finite() && *distance > nearest)
            .find_map(|distance| {
                let offset = from + direction * distance;
                let uv = self.uv(offset)?;
                Some(SurfaceHit { distance, point: self.centre + offset, normal: self.normal(uv), uv })
            })
    }

    /// Place uv of a point given relative to the centre; `None` outside the wall.
    pub(super) fn uv(&self, offset: DVec3) -> Option<DVec2> {
        let u = share(-offset.x.atan2(-offset.z), self.left_rad, self.right_rad)?;
        let v = (offset.y - self.bottom_m) / (self.top_m - self.bottom_m);
        (-EDGE..=1.0 + EDGE).contains(&v).then(|| DVec2::new(u, v.clamp(0.0, 1.0)))
    }
}
