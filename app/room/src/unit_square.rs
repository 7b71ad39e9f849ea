//! Unit square, in which places of pictures, viewports and surfaces lie.

use glam::DVec2;

/// Largest distance by which rounding may put a place of the edge beyond it.
pub(crate) const EDGE: f64 = 1e-9;

/// True inside the square or on its edge, up to rounding. A place that is not a number is outside.
pub(crate) fn inside(place: DVec2) -> bool {
    place.cmpge(DVec2::splat(-EDGE)).all() && place.cmple(DVec2::splat(1.0 + EDGE)).all()
}
