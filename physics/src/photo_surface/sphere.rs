//! The bounding sphere of a chunk.

use glam::DVec3;

/// A sphere around all finite vertices of a chunk, relative to the origin of the vertices; metres.
#[derive(Clone, Copy, Debug)]
pub(super) struct BoundingSphere {
    pub(super) centre: DVec3,
    pub(super) radius: f64,
}
