//! Hits of rays on surfaces.

use glam::{DVec2, DVec3};

/// Nearest hit of a ray, as a share of the surface's size. Closer to its start a ray hits nothing, so that a
/// projector on the rim of a dome does not light the rim.
pub(super) const NEAREST: f64 = 1e-9;

/// First hit of a ray on a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceHit {
    /// Distance along the ray, in lengths of its direction.
    pub distance: f64,
    /// Point that is hit, room axes, metres.
    pub point: DVec3,
    /// Unit vector to the viewer's side, whichever side the ray came from; room axes.
    pub normal: DVec3,
    /// Place on the surface, 0 to 1 from the lower left as seen by the viewer.
    pub uv: DVec2,
}
