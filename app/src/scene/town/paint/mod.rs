//! The town's painters: each paints pictures of one craft.

pub(super) mod masonry;
pub(super) mod nature;
pub(super) mod openings;
pub(super) mod timber;
