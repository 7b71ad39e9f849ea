//! Projectors: their place, their lens, and the share of their light that arrives (B 4.1, 4.2).

use crate::lens::ProjectorLens;
use crate::surface::shape::ScreenSurface;
use crate::unit_square::inside;
use glam::{DMat3, DVec2, DVec3};

/// Projector in the room.
#[derive(Clone, Debug, PartialEq)]
pub struct Projector {
    /// Name, unique among the projectors.
    pub name: String,
    /// Position of the lens, room axes, metres: R_p.
    pub position_m: DVec3,
    /// Rotation from the projector's axes (x right, y up in its picture, −z along its optical axis) to the room's:
    /// M_p.
    pub room_from_projector: DMat3,
    /// Lens: φ_p.
    pub lens: ProjectorLens,
    /// Light of a fully white picture, relative to the other projectors.
    pub light: f64,
    /// Exponent of the signal that gives the light, for projectors that do not follow sRGB; `None` for sRGB.
    pub gamma: Option<f64>,
    /// True if the projector's picture is made evenly bright on the screen (B 4.2).
    pub even: bool,
    /// True if the picture fades out where other projectors' pictures reach (B 5.1.6).
    pub blend: bool,
}

impl Projector {
    /// Unit vector along which the light of a place in the picture leaves, room axes.
    pub fn ray(&self, place: DVec2) -> Option<DVec3> {
        Some(self.room_from_projector * self.lens.direction(place)?)
    }

    /// Place of the picture whose light would pass through a point; `None` if it is outside the picture.
    pub fn place(&self, point: DVec3) -> Option<DVec2> {
        let place = self.lens.place(self.room_from_projector.transpose() * (point - self.position_m))?;
        inside(place).then_some(place)
    }

    /// Place of the picture whose light reaches a point, as in [`place`](Self::place); `None` if the surface itself
    /// is in the way.
    pub fn lit_place(&self, surface: &ScreenSurface, point: DVec3) -> Option<DVec2> {
        let place = self.place(point)?;
        let hit = surface.hit(self.position_m, point - self.position_m)?;
        (hit.distance > 1.0 - 1e-6).then_some(place)
    }

    /// Illuminance of a surface point by a white picture at a place, in units of the projector's light per square
    /// metre.
    ///
    /// *Equation.* cos θ_P · I_P / r² of B eq. 4.5. Each pixel has the same share of the light, so the radiant
    /// intensity I_P is that share divided by the pixel's solid angle. A pinhole's picture is then evenly bright on a
    /// wall that is perpendicular to its axis, as a real one is.
    pub fn illuminance(&self, place: DVec2, point: DVec3, normal: DVec3) -> Option<f64> {
        let way = point - self.position_m;
        let r = way.length();
        let intensity = self.light / self.lens.solid_angle(place)?;
        Some(intensity * (way.dot(normal) / r).abs() / (r * r))
    }
}
