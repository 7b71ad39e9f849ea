//! Geometry of the scene on the GPU: static attributes, indices, and the list of draws.
//!
//! Nothing is copied on the way: the arrays of the scene and of its cut are written to the device piece by piece.
//! Attributes that no mesh has take one vertex, which all share.

use super::buffer_fill::{BufferFill, filled};
use super::draw_list::{DrawList, corners};
use crate::gpu::Gpu;
use bytemuck::{Pod, Zeroable};
use scene::cut::{Cut, CutMesh, CutVertex};
use scene::motion::Motion;
use scene::{Mesh, Scene};

/// Place of a vertex and direction of its surface.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct VertexSurface {
    /// Position in metres relative to the scene's origin.
    pub world: [f32; 3],
    /// Normal, unit vector, world axes.
    pub normal: [f32; 3],
}

/// Attributes with a default that meshes of a scene have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OwnAttributes {
    /// True if a mesh has texture coordinates.
    pub uvs: bool,
    /// True if a mesh has other texture coordinates for its emissive texture.
    pub emissive_uvs: bool,
    /// True if a mesh has colours.
    pub colours: bool,
}

impl OwnAttributes {
    /// Attributes that meshes of `scene` have.
    pub fn of(scene: &Scene) -> Self {
        Self {
            uvs: scene.meshes.iter().any(|mesh| !mesh.uvs.is_empty() || !mesh.emissive_uvs.is_empty()),
            emissive_uvs: scene.meshes.iter().any(|mesh| !mesh.emissive_uvs.is_empty()),
            colours: scene.meshes.iter().any(|mesh| !mesh.colours.is_empty()),
        }
    }
}

/// Buffers of a scene or of one of its cuts.
pub struct Geometry {
    /// [`VertexSurface`] of every vertex.
    pub surface: wgpu::Buffer,
    /// Texture coordinates of every vertex, two f32 each; of one vertex if no mesh has any.
    pub uvs: wgpu::Buffer,
    /// Texture coordinates of every vertex for the emissive texture; `uvs` if no mesh has any.
    pub emissive_uvs: wgpu::Buffer,
    /// Linear colour and opacity of every vertex, four f32 each; of one vertex if no mesh has any.
    pub colours: wgpu::Buffer,
    /// Indices, three u32 for each triangle.
    pub indices: wgpu::Buffer,
    /// Draws of the triangles.
    pub list: DrawList,
    /// Bytes from one stream of apparent positions to the next.
    pub stream_stride: u64,
}

/// Bytes of one f32 stream of `count` vertices, rounded up so that streams stay aligned for copies and wide stores.
pub fn stream_stride(count: usize) -> u64 {
    (count as u64 * 4).next_multiple_of(256).max(256)
}

/// Number of streams of apparent positions: x, y and z, and log2 D if anything is animated.
pub fn stream_count(motions: &[Motion]) -> u64 {
    if motions.iter().any(|motion| motion.animated().is_some()) { 4 } else { 3 }
}

impl Geometry {
    /// Uploads a scene, or one of its cuts, with its draws.
    pub fn new(gpu: &Gpu, scene: &Scene, own: OwnAttributes, cut: Option<&Cut>, list: DrawList) -> Self {
        let uncut = CutMesh::default();
        let cut_of = |mesh: usize| cut.map_or(&uncut, |cut| &cut.meshes[mesh]);
        let parts = || scene.meshes.iter().enumerate().map(|(number, mesh)| (mesh, cut_of(number)));
        let count = cut.map_or_else(|| scene.vertex_count(), |cut| cut.vertices);
        let vertices = wgpu::BufferUsages::VERTEX;

        // Write the attributes that there are.
        let of_mesh = |mesh: &Mesh, vertex: usize| VertexSurface {
            world: mesh.positions[vertex].to_array(),
            normal: mesh.normals[vertex].to_array(),
        };
        let of_added = |vertex: &CutVertex| VertexSurface {
            world: vertex.place.as_vec3().to_array(),
            normal: vertex.normal.to_array(),
        };
        let mut fill = BufferFill::new(gpu, "surfaces", count.max(1) * size_of::<VertexSurface>(), vertices);
        for (mesh, cut) in parts() {
            fill.extend((0..mesh.positions.len()).map(|vertex| of_mesh(mesh, vertex)));
            fill.extend(cut.added.iter().map(of_added));
        }
        let surface = fill.finish();
        let uvs = if own.uvs {
            let mut fill = BufferFill::new(gpu, "texture coordinates", count * 8, vertices);
            for (mesh, cut) in parts() {
                fill.extend((0..mesh.positions.len()).map(|vertex| mesh.uv(vertex)));
                fill.extend(cut.added.iter().map(|vertex| vertex.uv));
            }
            fill.finish()
        } else {
            filled(gpu, "texture coordinates of all", &[0.0_f32; 2], vertices)
        };
        let emissive_uvs = if own.emissive_uvs {
            let mut fill = BufferFill::new(gpu, "emissive texture coordinates", count * 8, vertices);
            for (mesh, cut) in parts() {
                fill.extend((0..mesh.positions.len()).map(|vertex| mesh.emissive_uv(vertex)));
                fill.extend(cut.added.iter().map(|vertex| vertex.emissive_uv));
            }
            fill.finish()
        } else {
            uvs.clone()
        };
        let colours = if own.colours {
            let mut fill = BufferFill::new(gpu, "colours", count * 16, vertices);
            for (mesh, cut) in parts() {
                fill.extend((0..mesh.positions.len()).map(|vertex| mesh.colour(vertex)));
                fill.extend(cut.added.iter().map(|vertex| vertex.colour));
            }
            fill.finish()
        } else {
            filled(gpu, "colour of all", &[1.0_f32; 4], vertices)
        };

        // Join the indices.
        let mut base = 0;
        let bases: Vec<u32> = parts()
            .map(|(mesh, cut)| {
                let first = base;
                base += (mesh.positions.len() + cut.added.len()) as u32;
                first
            })
            .collect();
        let count_of_corners = 3 * list.triangle_count() as usize;
        let mut fill = BufferFill::new(gpu, "indices", count_of_corners.max(1) * 4, wgpu::BufferUsages::INDEX);
        for &mesh in &list.order {
            let corners = corners(&scene.meshes[mesh], cut.map(|cut| &cut.meshes[mesh]));
            fill.extend(corners.iter().map(|corner| corner + bases[mesh]));
        }
        let (indices, stream_stride) = (fill.finish(), stream_stride(count));
        Self { surface, uvs, emissive_uvs, colours, indices, list, stream_stride }
    }
}
