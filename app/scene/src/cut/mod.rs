//! A scene cut for one observer: as finely as his picture needs, and no finer.
//!
//! [`crate::refine`] cuts every edge to one length; here an edge is cut where straight lines would leave the light's by more than a part of a
//! pixel (W 7.2 left this as future work). What decides is the edge alone, seen by one observer: [`physics::interpolation_error::TriangleInterpolation::bound`] of it bounds every triangle
//! of which it is the longest edge, inside too. So two triangles that share an edge cut it alike, whatever mesh they belong to, and a
//! triangle with no edge left to cut is good everywhere.
//!
//! Beside the picture more error is allowed: as much as its distance from the picture, so that nothing drawn wrongly strays into it.
//!
//! Of what is animated no such bound is known. Its edges are cut where looks at their middles and quarters ([`Chord`]) find them off, each look a
//! solution for that place's own retarded event; still by the edge alone.
//!
//! Midpoints are formed in f64, where halving is exact, and new vertices are kept relative to the observer: an edge of a micrometre astern,
//! which at γ = 10⁶ is as wide as the picture, needs that.

mod observer_cut;
mod sight;

pub use observer_cut::{Cut, Fineness, Viewpoint};
pub use sight::{Chord, Sight};
