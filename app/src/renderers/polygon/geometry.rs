//! The scene on the GPU: static attributes, indices, and the list of draws.

use crate::gpu::Gpu;
use crate::scene::{Alpha, Scene};
use bytemuck::{Pod, Zeroable, cast_slice};
use glam::{DVec3, Vec3};
use wgpu::util::DeviceExt;

/// What a vertex carries besides its apparent position.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
pub struct Attributes {
    /// Metres, relative to the scene's origin.
    pub world: [f32; 3],
    /// Unit vector, world axes.
    pub normal: [f32; 3],
    /// Texture coordinates.
    pub uv: [f32; 2],
    /// Linear colour and opacity.
    pub colour: [f32; 4],
}

/// Consecutive triangles drawn alike.
#[derive(Clone, Debug, PartialEq)]
pub struct Draw {
    /// Index into the scene's materials.
    pub material: usize,
    /// Range of the index buffer.
    pub indices: std::ops::Range<u32>,
    /// World position to sort blended surfaces by.
    pub centre: DVec3,
}

/// Buffers that never change while a scene is shown.
pub struct Geometry {
    /// [`Attributes`] of every vertex.
    pub attributes: wgpu::Buffer,
    /// Three u32 per triangle.
    pub indices: wgpu::Buffer,
    /// Drawn in any order, before the sky: one draw per material.
    pub opaque: Vec<Draw>,
    /// Drawn from far to near, after the sky: one draw per mesh.
    pub blended: Vec<Draw>,
    /// World positions relative to the scene's origin, x, y and z streams one after the other: the plain draw's vertices.
    pub plain: wgpu::Buffer,
    /// Bytes from one stream to the next.
    pub stream_stride: u64,
}

/// Bytes of one f32 stream of `count` vertices, rounded up so that streams stay aligned for copies and wide stores.
pub fn stream_stride(count: usize) -> u64 {
    (count as u64 * 4).next_multiple_of(256).max(256)
}

impl Geometry {
    /// Uploads everything of the scene that does not depend on the observer.
    pub fn new(gpu: &Gpu, scene: &Scene) -> Self {
        let count = scene.vertex_count();
        let mut attributes = Vec::with_capacity(count);
        for mesh in &scene.meshes {
            attributes.extend((0..mesh.positions.len()).map(|i| Attributes {
                world: mesh.positions[i].to_array(),
                normal: mesh.normals[i].to_array(),
                uv: mesh.uvs[i].to_array(),
                colour: mesh.colours[i],
            }));
        }
        let (indices, opaque, blended) = draws(scene);
        let stream_stride = stream_stride(count);
        let mut plain = vec![0.0_f32; (stream_stride / 4 * 3) as usize];
        for (axis, stream) in plain.chunks_mut((stream_stride / 4) as usize).enumerate() {
            for (value, vertex) in stream.iter_mut().zip(&attributes) {
                *value = vertex.world[axis];
            }
        }
        let buffer = |label, contents: &[u8], usage| {
            // A scene without surfaces still has a sky, and an empty buffer cannot be bound.
            let contents = if contents.is_empty() { &[0; size_of::<Attributes>()] } else { contents };
            gpu.device.create_buffer_init(&wgpu::util::BufferInitDescriptor { label: Some(label), contents, usage })
        };
        Self {
            attributes: buffer("attributes", cast_slice(&attributes), wgpu::BufferUsages::VERTEX),
            indices: buffer("indices", cast_slice(&indices), wgpu::BufferUsages::INDEX),
            plain: buffer("plain positions", cast_slice(&plain), wgpu::BufferUsages::VERTEX),
            opaque,
            blended,
            stream_stride,
        }
    }
}

/// Concatenates the meshes' indices: opaque ones grouped by material, blended ones kept apart.
fn draws(scene: &Scene) -> (Vec<u32>, Vec<Draw>, Vec<Draw>) {
    let mut base = 0;
    let bases: Vec<u32> = scene
        .meshes
        .iter()
        .map(|mesh| {
            let first = base;
            base += mesh.positions.len() as u32;
            first
        })
        .collect();
    let blends = |mesh: usize| scene.materials[scene.meshes[mesh].material].alpha == Alpha::Blend;
    let mut order: Vec<usize> = (0..scene.meshes.len()).collect();
    order.sort_by_key(|&mesh| (blends(mesh), scene.meshes[mesh].material));

    let (mut indices, mut opaque, mut blended) = (Vec::new(), Vec::<Draw>::new(), Vec::new());
    for mesh in order {
        let start = indices.len() as u32;
        let source = &scene.meshes[mesh];
        // A corner that is nowhere would be drawn at the eye: leave its triangles out.
        let drawable = |corners: &&[u32]| corners.iter().all(|&i| source.positions[i as usize].is_finite());
        let triangles = source.indices.chunks_exact(3).filter(drawable);
        indices.extend(triangles.flatten().map(|index| index + bases[mesh]));
        let draw = Draw {
            material: source.material,
            indices: start..indices.len() as u32,
            centre: scene.origin + centre(&source.positions),
        };
        match opaque.last_mut() {
            _ if blends(mesh) => blended.push(draw),
            Some(last) if last.material == draw.material => last.indices.end = draw.indices.end,
            _ => opaque.push(draw),
        }
    }
    (indices, opaque, blended)
}

fn centre(positions: &[Vec3]) -> DVec3 {
    let sum: DVec3 = positions.iter().filter(|p| p.is_finite()).map(|p| p.as_dvec3()).sum();
    sum / positions.len().max(1) as f64
}
