//! Refinement: cuts triangles, so that straight edges may bend.
//!
//! The photo-surface is exact at vertices only (W 5.1): between them a renderer draws straight lines where light draws
//! hyperbolas. Here every edge longer than a given length is split, again and again, until none is left.
//!
//! The decision to split an edge depends on its two end points and on nothing else, and the midpoint is the same to
//! the last bit from either side. Two triangles that share an edge therefore split it alike even if they belong to
//! different meshes, so no cracks and no T-junctions appear where there were none. A triangle with three split edges
//! becomes four (red), with two three, with one two (green).
//!
//! If a scene has a circuit, observers stay near it, and edges further away than [`NEAR_M`] may be longer in
//! proportion to their distance. The angle under which an edge is seen counts: a hill on the horizon need not be cut
//! as finely as a kerb.
//!
//! Refinement ends: every new edge is half an old one, or at most √3/2 of the longest edge of the triangle it cuts.

mod divide;
mod error;
mod refined;
mod split_rule;

pub(crate) use divide::divide;
pub use error::RefineError;
pub use refined::{cut_beyond, refine};
pub use split_rule::NEAR_M;
