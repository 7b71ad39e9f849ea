//! Triangles of one material.

use glam::{Vec2, Vec3};

/// Triangles of one material.
///
/// All vertex arrays have the same length; `indices` has a multiple of three entries, each below that length.
/// Front faces are counter-clockwise.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// From the file's node and mesh, for messages.
    pub name: String,
    /// Index into [`Scene::materials`].
    pub material: usize,
    /// Metres, relative to [`Scene::origin`]; of what moves, in its own frame, and of what is animated without that origin (see [`motion`]).
    pub positions: Vec<Vec3>,
    /// Unit vectors, world axes.
    pub normals: Vec<Vec3>,
    /// Texture coordinates, origin at the picture's upper left (glTF).
    pub uvs: Vec<Vec2>,
    /// Linear colour and opacity, multiplied into the base colour.
    pub colours: Vec<[f32; 4]>,
    /// Three per triangle.
    pub indices: Vec<u32>,
    /// Whether a vehicle collides with it and rides on it; foliage and signs do not count.
    pub solid: bool,
    /// Index into [`Scene::motions`]; `None`: it rests in the world.
    pub motion: Option<usize>,
}
