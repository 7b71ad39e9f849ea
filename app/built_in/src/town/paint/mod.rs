//! Painters of the town's pictures, one module for each craft.

pub(crate) mod dial;
pub(super) mod ground_floors;
pub(super) mod masonry;
pub(super) mod nature;
mod openings;
pub(super) mod signs;
pub(super) mod timber;
pub(super) mod tracery;
