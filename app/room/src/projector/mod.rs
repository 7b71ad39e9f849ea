//! Projectors: where they stand, what their lens does, and how much of their light arrives (B 4.1, 4.2).

mod lens;

pub use lens::{Lens, Table};

use super::Surface;
use glam::{DMat3, DVec2, DVec3};

/// A projector.
#[derive(Clone, Debug, PartialEq)]
pub struct Projector {
    /// Unique among the projectors.
    pub name: String,
    /// Where its lens is, room axes, metres: R_p.
    pub position_m: DVec3,
    /// From its axes (x right, y up in its picture, −z along its optical axis) to the room's: M_p.
    pub room_from_projector: DMat3,
    /// φ_p.
    pub lens: Lens,
    /// Light that leaves it when all is white, relative to the others'.
    pub light: f64,
    /// Its light is the signal to this power, for those that do not follow sRGB; `None`: sRGB.
    pub gamma: Option<f64>,
    /// Whether the screen is made evenly bright (B 4.2).
    pub even: bool,
    /// Whether it fades out where others' pictures reach (B 5.1.6).
    pub blend: bool,
}

impl Projector {
    /// Unit vector along which the light of a place in its picture leaves, room axes.
    pub fn ray(&self, place: DVec2) -> Option<DVec3> {
        Some(self.room_from_projector * self.lens.direction(place)?)
    }

    /// The place of its picture whose light would pass through a point, if that is in the picture.
    pub fn place(&self, point: DVec3) -> Option<DVec2> {
        let place = self.lens.place(self.room_from_projector.transpose() * (point - self.position_m))?;
        inside(place).then_some(place)
    }

    /// As [`place`](Self::place), and nothing of the surface is in the way.
    pub fn lit_place(&self, surface: &Surface, point: DVec3) -> Option<DVec2> {
        let place = self.place(point)?;
        let hit = surface.hit(self.position_m, point - self.position_m)?;
        (hit.distance > 1.0 - 1e-6).then_some(place)
    }

    /// Illuminance that white of a place brings to a surface point with a normal, in units of the projector's light per square metre.
    ///
    /// *Equation.* cos θ_P · I_P / r² of B eq. 4.5. Each pixel has the same share of the light, so that the radiant intensity I_P is that share over the
    /// pixel's solid angle: a pinhole's picture is evenly bright on a wall that it stands square to, as real ones are.
    pub fn illuminance(&self, place: DVec2, point: DVec3, normal: DVec3) -> Option<f64> {
        let way = point - self.position_m;
        let r = way.length();
        let intensity = self.light / self.lens.solid_angle(place)?;
        Some(intensity * (way.dot(normal) / r).abs() / (r * r))
    }
}

/// In the picture, or on its edge but for rounding.
pub(super) fn inside(place: DVec2) -> bool {
    place.min_element() >= -1e-9 && place.max_element() <= 1.0 + 1e-9
}
