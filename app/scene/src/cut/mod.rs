//! A scene cut for one observer: as finely as the observer's pictures need, and no finer.
//!
//! [`crate::refine`] cuts every edge to one length. Here an edge is cut where straight lines would leave the curve that
//! light draws by more than a part of a pixel (W 7.2 left this as future work). The decision depends on the edge and
//! its observer alone: [`physics::interpolation_error::TriangleInterpolation::bound`] of an edge bounds the error of
//! every triangle of which it is the longest edge, inside too. Two triangles that share an edge therefore cut it alike,
//! whatever mesh they belong to, and a triangle with no edge left to cut is accurate everywhere.
//!
//! Beside the picture more error is allowed: as much as the distance from the picture, so that nothing drawn wrongly
//! strays into it.
//!
//! For animated bodies no such bound is known. Their edges are cut where samples at their middles and quarters
//! ([`EdgeChord`]) find an error, each sample a solution for that place's own retarded event. The decision still
//! depends on the edge alone.
//!
//! Midpoints are formed in f64, where halving is exact, and new vertices stay f64: an edge of a micrometre astern,
//! which at γ = 10⁶ is as wide as the picture, needs that.

mod cut_scene;
mod edge_chord;
mod fineness;
mod observer_cut;
mod seen_from;
mod shown_sky;

pub use cut_scene::{Cut, CutMesh, CutVertex, FixedHasher};
pub use edge_chord::EdgeChord;
pub use fineness::{CutFineness, CutViewpoint};
pub use seen_from::SeenFrom;
