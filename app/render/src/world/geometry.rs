//! Geometry of the scene on the GPU: static attributes, indices, and the list of draws.
//!
//! Nothing is copied on the way: the arrays of the scene and of its cut are written to the device piece by piece.
//! Attributes that no mesh has take one vertex, which all share.

use super::buffer_fill::{BufferFill, filled};
use super::draw_list::{Draw, centre, groups_of, order, push_draw};
use crate::gpu::Gpu;
use bytemuck::{Pod, Zeroable};
use scene::cut::{Cut, CutMesh, CutVertex};
use scene::motion::Motion;
use scene::{Alpha, Mesh, Scene};
use std::borrow::Cow;

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
    /// Opaque draws, in any order before the sky: one for each material and motion.
    pub opaque: Vec<Draw>,
    /// Blended draws, from far to near after the sky: one for each mesh.
    pub blended: Vec<Draw>,
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

/// Order of a scene's triangles on the device.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sorting {
    /// Order of the scene, for views that see much of the world.
    AsTheyCome,
    /// Groups of triangles that lie close together, for views that see little of the world.
    InGroups,
}

impl Geometry {
    /// Uploads a scene.
    pub fn of(gpu: &Gpu, scene: &Scene, own: OwnAttributes, sorting: Sorting) -> Self {
        Self::upload(gpu, scene, own, None, sorting)
    }

    /// Uploads a scene that was cut.
    pub fn of_cut(gpu: &Gpu, scene: &Scene, own: OwnAttributes, cut: &Cut) -> Self {
        Self::upload(gpu, scene, own, Some(cut), Sorting::AsTheyCome)
    }

    fn upload(gpu: &Gpu, scene: &Scene, own: OwnAttributes, cut: Option<&Cut>, sorting: Sorting) -> Self {
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

        // Join the indices: opaque meshes by material, blended ones apart.
        let mut base = 0;
        let bases: Vec<u32> = parts()
            .map(|(mesh, cut)| {
                let first = base;
                base += (mesh.positions.len() + cut.added.len()) as u32;
                first
            })
            .collect();
        let drawn: Vec<Cow<'_, [u32]>> = parts()
            .map(|(mesh, of_mesh)| if cut.is_some() { of_mesh.indices(mesh).into() } else { drawable(mesh) })
            .collect();
        let corners: usize = drawn.iter().map(|indices| indices.len()).sum();
        let order = order(scene);
        let (mut opaque, mut blended) = (Vec::new(), Vec::new());
        let mut start = 0;
        for &mesh in &order {
            let end = start + drawn[mesh].len() as u32;
            let source = &scene.meshes[mesh];
            let blends = scene.materials[source.material].alpha == Alpha::Blend;
            // Only blended draws are sorted by their distance.
            let centre = if blends { scene.origin + centre(&source.positions) } else { scene.origin };
            let draw = Draw {
                material: source.material,
                motion: source.motion,
                indices: start..end,
                centre,
                groups: Vec::new(),
            };
            push_draw(&mut opaque, &mut blended, draw, blends);
            start = end;
        }
        let of_mesh = |mesh: usize| {
            let base = bases[mesh];
            drawn[mesh].iter().map(move |index| index + base)
        };
        let mut fill = BufferFill::new(gpu, "indices", corners.max(1) * 4, wgpu::BufferUsages::INDEX);
        match sorting {
            Sorting::AsTheyCome => order.iter().for_each(|&mesh| fill.extend(of_mesh(mesh))),
            Sorting::InGroups => {
                let mut indices: Vec<u32> = order.iter().flat_map(|&mesh| of_mesh(mesh)).collect();
                groups_of(scene, &mut indices, &mut opaque, &mut blended);
                fill.extend(indices.into_iter());
            }
        }
        let (indices, stream_stride) = (fill.finish(), stream_stride(count));
        Self { surface, uvs, emissive_uvs, colours, indices, opaque, blended, stream_stride }
    }
}

/// Indices of the triangles of a mesh that can be drawn: a corner without a finite place would be drawn at the eye.
fn drawable(mesh: &Mesh) -> Cow<'_, [u32]> {
    if mesh.positions.iter().all(|position| position.is_finite()) {
        return Cow::Borrowed(&mesh.indices);
    }
    let finite = |corners: &&[u32; 3]| corners.iter().all(|&corner| mesh.positions[corner as usize].is_finite());
    mesh.indices.as_chunks::<3>().0.iter().filter(finite).flatten().copied().collect()
}
