//! Triangles of one material.

use glam::{Vec2, Vec3};

/// Mesh of triangles that have one material.
///
/// All vertex arrays have the same length; those that have a default may be empty (`uvs`, `emissive_uvs`, `colours`).
/// `indices` has a multiple of three entries, each below that length.
/// Front faces are counter-clockwise.
#[derive(Clone, Debug, Default)]
pub struct Mesh {
    /// Name from the file's node and mesh, for messages.
    pub name: String,
    /// Index into [`Scene::materials`](crate::Scene::materials).
    pub material: usize,
    /// Positions of the vertices, metres, relative to [`Scene::origin`](crate::Scene::origin).
    /// Uniformly moving meshes have them in their own frame; animated meshes in their body's frame, without that
    /// origin (see [`crate::motion`]).
    pub positions: Vec<Vec3>,
    /// Normals of the vertices, unit vectors, world axes.
    pub normals: Vec<Vec3>,
    /// Texture coordinates, origin at the picture's upper left (glTF); empty if they are 0.
    pub uvs: Vec<Vec2>,
    /// Texture coordinates of the emissive texture; empty if they are `uvs`.
    pub emissive_uvs: Vec<Vec2>,
    /// Linear colours and opacities of the vertices, multiplied into the base colour; empty if they are 1.
    pub colours: Vec<[f32; 4]>,
    /// Indices of vertices, three per triangle.
    pub indices: Vec<u32>,
    /// True if a vehicle collides with the mesh and rides on it; false for foliage and signs.
    pub solid: bool,
    /// Index into [`Scene::motions`](crate::Scene::motions); `None` if the mesh rests in the world.
    pub motion: Option<usize>,
}

impl PartialEq for Mesh {
    /// True if all vertices and triangles are the same; defaults that are written out equal those that are not.
    fn eq(&self, other: &Self) -> bool {
        let head = |mesh: &Self| (mesh.material, mesh.solid, mesh.motion);
        let of_vertex = |mesh: &Self, vertex| (mesh.uv(vertex), mesh.emissive_uv(vertex), mesh.colour(vertex));
        head(self) == head(other)
            && self.name == other.name
            && self.positions == other.positions
            && self.normals == other.normals
            && self.indices == other.indices
            && (0..self.positions.len()).all(|vertex| of_vertex(self, vertex) == of_vertex(other, vertex))
    }
}

impl Mesh {
    /// Texture coordinates of a vertex.
    pub fn uv(&self, vertex: usize) -> Vec2 {
        self.uvs.get(vertex).copied().unwrap_or(Vec2::ZERO)
    }

    /// Linear colour and opacity of a vertex.
    pub fn colour(&self, vertex: usize) -> [f32; 4] {
        self.colours.get(vertex).copied().unwrap_or([1.0; 4])
    }

    /// Texture coordinates of a vertex for the emissive texture.
    pub fn emissive_uv(&self, vertex: usize) -> Vec2 {
        self.emissive_uvs.get(vertex).copied().unwrap_or_else(|| self.uv(vertex))
    }
}
