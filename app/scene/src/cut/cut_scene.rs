//! Cut triangles of a scene, as data.

use std::collections::HashSet;
use std::hash::{BuildHasher, BuildHasherDefault, DefaultHasher};

use glam::{DVec3, Vec2, Vec3};

/// Vertex of a cut.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CutVertex {
    /// Position, metres, relative to the scene's origin.
    pub place: DVec3,
    /// Normal, unit vector, world axes.
    pub normal: Vec3,
    /// Texture coordinates.
    pub uv: Vec2,
    /// Texture coordinates of the emissive texture.
    pub emissive_uv: Vec2,
    /// Linear colour and opacity of the vertex.
    pub colour: [f32; 4],
}

/// Cut triangles of a scene.
#[derive(Clone, Debug, Default)]
pub struct Cut {
    /// Cut meshes, one for each mesh of the scene, in the same order.
    pub meshes: Vec<CutMesh>,
    /// Tolerance that was kept, pixels: the requested one, unless that would have made too many triangles.
    pub tolerance_px: f64,
    /// Edges that were cut, by their keys. The next cut keeps them cut until their error is below half the allowed
    /// one.
    pub split: HashSet<u64, FixedHasher>,
}

/// Cut triangles of a mesh.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CutMesh {
    /// Vertices that triangles use.
    pub vertices: Vec<CutVertex>,
    /// Indices of vertices, three per triangle.
    pub indices: Vec<u32>,
}

/// Hasher without a random seed: a key has the same hash in every run.
pub type FixedHasher = BuildHasherDefault<DefaultHasher>;

impl Cut {
    /// Number of triangles of all meshes.
    pub fn triangle_count(&self) -> usize {
        self.meshes.iter().map(|mesh| mesh.indices.len() / 3).sum()
    }

    /// Number of vertices of all meshes.
    pub fn vertex_count(&self) -> usize {
        self.meshes.iter().map(|mesh| mesh.vertices.len()).sum()
    }
}

/// Key of an edge, the same from either end.
pub fn edge_key(a: DVec3, b: DVec3) -> u64 {
    let end = |at: DVec3| FixedHasher::default().hash_one(at.to_array().map(f64::to_bits));
    end(a).wrapping_add(end(b))
}
