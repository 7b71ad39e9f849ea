//! Surfaces in the room that can show something.
//!
//! Every surface has places uv, 0 to 1 from the lower left as seen by the viewer, a normal that points to the viewer's side, and a first
//! point that a ray hits.

mod flat;

pub use flat::{Flat, NotRectangle};

use glam::{DVec2, DVec3};

/// A ray closer to its start than this share of the surface's size hits nothing: a projector on the rim of a dome does not light
/// the rim.
const NEAREST: f64 = 1e-9;

/// Rounding may put a point on an edge this far (in uv) beyond it.
const EDGE: f64 = 1e-9;

/// Where a ray hits a surface first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// In lengths of the ray's direction.
    pub distance: f64,
    /// Room axes, metres.
    pub point: DVec3,
    /// Unit vector to the viewer's side, whichever side the ray came from.
    pub normal: DVec3,
    /// Place on the surface, 0 to 1 from the lower left as seen by the viewer.
    pub uv: DVec2,
}

/// What a screen is made of.
#[derive(Clone, Debug, PartialEq)]
pub enum Surface {
    /// A rectangle.
    Flat(Flat),
}

impl Surface {
    /// Point at a place on the surface: room axes, metres. Places outside 0 to 1 are those on its nearest edge.
    pub fn point(&self, uv: DVec2) -> DVec3 {
        let uv = uv.clamp(DVec2::ZERO, DVec2::ONE);
        match self {
            Self::Flat(flat) => flat.point(uv),
        }
    }

    /// Unit normal there, to the viewer's side.
    pub fn normal(&self, _uv: DVec2) -> DVec3 {
        match self {
            Self::Flat(flat) => flat.normal(),
        }
    }

    /// Where a ray from `origin` along `direction` (any length but zero) hits the surface first, from either side.
    pub fn hit(&self, origin: DVec3, direction: DVec3) -> Option<Hit> {
        match self {
            Self::Flat(flat) => flat.hit(origin, direction),
        }
    }

    /// What it is called in reports: flat, cylinder, sphere or mesh.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Flat(_) => "flat",
        }
    }
}
