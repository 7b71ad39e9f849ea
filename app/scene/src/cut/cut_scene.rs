//! Cut triangles of a scene, as data.

use std::collections::HashSet;
use std::hash::{BuildHasher, BuildHasherDefault, DefaultHasher};

use glam::{DVec3, Vec2, Vec3};

use crate::mesh::Mesh;

/// Vertex that a cut adds.
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
    /// Number of triangles of all meshes.
    pub triangles: usize,
    /// Number of vertices of all meshes, those that no triangle uses as well.
    pub vertices: usize,
    /// Edges that were cut, by their keys. The next cut keeps them cut until their error is below half the allowed
    /// one.
    pub split: HashSet<u64, FixedHasher>,
}

/// Cut triangles of a mesh. The vertices are the mesh's own, then those that were added.
///
/// A triangle with a corner that is not finite is left out.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CutMesh {
    /// Added vertices, numbered after the mesh's own.
    pub added: Vec<CutVertex>,
    /// Indices of vertices, three per triangle; `None` if they are the mesh's own, since nothing of it was cut.
    pub changed: Option<Vec<u32>>,
}

impl CutMesh {
    /// Indices of vertices, three per triangle. `mesh` is the mesh that was cut.
    pub fn indices<'a>(&'a self, mesh: &'a Mesh) -> &'a [u32] {
        self.changed.as_deref().unwrap_or(&mesh.indices)
    }

    /// Position of a vertex, metres, relative to the scene's origin. `mesh` is the mesh that was cut.
    pub fn place(&self, mesh: &Mesh, vertex: usize) -> DVec3 {
        match mesh.positions.get(vertex) {
            Some(position) => position.as_dvec3(),
            None => self.added[vertex - mesh.positions.len()].place,
        }
    }

    /// Positions of all vertices, metres, relative to the scene's origin. `mesh` is the mesh that was cut.
    pub fn places<'a>(&'a self, mesh: &'a Mesh) -> impl Iterator<Item = DVec3> + use<'a> {
        let own = mesh.positions.iter().map(|position| position.as_dvec3());
        own.chain(self.added.iter().map(|vertex| vertex.place))
    }
}

/// Hasher without a random seed: a key has the same hash in every run.
pub type FixedHasher = BuildHasherDefault<DefaultHasher>;

/// Key of an edge, the same from either end.
pub fn edge_key(a: DVec3, b: DVec3) -> u64 {
    let end = |at: DVec3| FixedHasher::default().hash_one(at.to_array().map(f64::to_bits));
    end(a).wrapping_add(end(b))
}
