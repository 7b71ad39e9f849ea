//! Geometry of the scene on the GPU: static attributes, indices, and the list of draws.

use crate::gpu::Gpu;
use bytemuck::{Pod, Zeroable, cast_slice};
use glam::{DVec3, Vec3};
use scene::cut::Cut;
use scene::motion::Motion;
use scene::{Alpha, Scene};
use std::ops::Range;
use wgpu::util::DeviceExt;

/// Number of triangles of a [`Group`]: enough that a draw of its own costs little in comparison.
const GROUP_TRIANGLES: usize = 512;

/// Attributes of a vertex besides its apparent position.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct Attributes {
    /// Position in metres relative to the scene's origin.
    pub world: [f32; 3],
    /// Normal, unit vector, world axes.
    pub normal: [f32; 3],
    /// Texture coordinates.
    pub uv: [f32; 2],
    /// Texture coordinates of the emissive texture.
    pub emissive_uv: [f32; 2],
    /// Linear colour and opacity of the vertex.
    pub colour: [f32; 4],
}

/// Successive triangles with the same material and motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Draw {
    /// Index into the scene's materials.
    pub material: usize,
    /// Index into the scene's motions; `None` for what rests in the world.
    pub motion: Option<usize>,
    /// Range of the index buffer.
    pub indices: Range<u32>,
    /// World position by which blended surfaces are sorted, metres; for a moving body, in its own frame.
    pub centre: DVec3,
    /// Groups of the same triangles that lie close together, for views that see little of the world.
    pub groups: Vec<Group>,
}

/// A few triangles, and a ball around them.
#[derive(Clone, Debug, PartialEq)]
pub struct Group {
    /// Range of the index buffer.
    pub indices: Range<u32>,
    /// Middle of the ball, world position, metres.
    pub centre: DVec3,
    /// Radius of the ball, metres.
    pub radius: f64,
}

/// Buffers of a scene that do not change while it is shown.
pub struct Geometry {
    /// [`Attributes`] of every vertex.
    pub attributes: wgpu::Buffer,
    /// Indices, three u32 for each triangle.
    pub indices: wgpu::Buffer,
    /// Opaque draws, in any order before the sky: one for each material and motion.
    pub opaque: Vec<Draw>,
    /// Blended draws, from far to near after the sky: one for each mesh.
    pub blended: Vec<Draw>,
    /// Positions relative to the scene's origin in x, y and z streams one after the other, metres: the vertices of a
    /// plain draw.
    pub plain: wgpu::Buffer,
    /// Bytes from one stream to the next.
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

/// Contents of a `Geometry` in memory.
#[derive(Clone, Debug, Default)]
pub struct Prepared {
    attributes: Vec<Attributes>,
    indices: Vec<u32>,
    opaque: Vec<Draw>,
    blended: Vec<Draw>,
}

impl Prepared {
    /// Contents for a scene, except for what depends on the observer.
    pub fn of(scene: &Scene) -> Self {
        let mut attributes = Vec::with_capacity(scene.vertex_count());
        for mesh in &scene.meshes {
            attributes.extend((0..mesh.positions.len()).map(|i| Attributes {
                world: mesh.positions[i].to_array(),
                normal: mesh.normals[i].to_array(),
                uv: mesh.uvs[i].to_array(),
                emissive_uv: mesh.emissive_uv(i).to_array(),
                colour: mesh.colours[i],
            }));
        }
        let (indices, opaque, blended) = draws(scene);
        Self { attributes, indices, opaque, blended }
    }

    /// Contents for a scene that was cut. It is drawn as a whole, so there are no groups.
    pub fn of_cut(scene: &Scene, cut: &Cut) -> Self {
        let mut prepared = Self { attributes: Vec::with_capacity(cut.vertex_count()), ..Self::default() };
        let mut bases = Vec::with_capacity(cut.meshes.len());
        for mesh in &cut.meshes {
            bases.push(prepared.attributes.len() as u32);
            prepared.attributes.extend(mesh.vertices.iter().map(|vertex| Attributes {
                world: vertex.place.as_vec3().to_array(),
                normal: vertex.normal.to_array(),
                uv: vertex.uv.to_array(),
                emissive_uv: vertex.emissive_uv.to_array(),
                colour: vertex.colour,
            }));
        }
        for mesh in order(scene) {
            let (base, source) = (bases[mesh], &cut.meshes[mesh]);
            let start = prepared.indices.len() as u32;
            // A corner without a finite place would be drawn at the eye, as in a scene that is not cut.
            let drawable = |corners: &&[u32]| corners.iter().all(|&i| source.vertices[i as usize].place.is_finite());
            let triangles = source.indices.chunks_exact(3).filter(drawable);
            prepared.indices.extend(triangles.flatten().map(|index| base + index));
            let draw = Draw {
                material: scene.meshes[mesh].material,
                motion: scene.meshes[mesh].motion,
                indices: start..prepared.indices.len() as u32,
                centre: scene.origin + centre(&scene.meshes[mesh].positions),
                groups: Vec::new(),
            };
            push_draw(&mut prepared.opaque, &mut prepared.blended, draw, blends(scene, mesh));
        }
        prepared
    }
}

impl Geometry {
    /// Uploads the contents for a scene, except for what depends on the observer.
    pub fn new(gpu: &Gpu, scene: &Scene) -> Self {
        Self::upload(gpu, Prepared::of(scene))
    }

    /// Uploads prepared contents.
    pub fn upload(gpu: &Gpu, prepared: Prepared) -> Self {
        let Prepared { attributes, indices, opaque, blended } = prepared;
        let stream_stride = stream_stride(attributes.len());
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

/// True if a mesh is drawn blended.
fn blends(scene: &Scene, mesh: usize) -> bool {
    scene.materials[scene.meshes[mesh].material].alpha == Alpha::Blend
}

/// Order in which the meshes are drawn: opaque ones first, by material and by motion.
fn order(scene: &Scene) -> Vec<usize> {
    let mut order: Vec<usize> = (0..scene.meshes.len()).collect();
    order.sort_by_key(|&mesh| (blends(scene, mesh), scene.meshes[mesh].material, scene.meshes[mesh].motion));
    order
}

/// Adds a draw. It is joined to the draw before it if that is opaque and has the same material and motion.
fn push_draw(opaque: &mut Vec<Draw>, blended: &mut Vec<Draw>, draw: Draw, blends: bool) {
    match opaque.last_mut() {
        _ if blends => blended.push(draw),
        Some(last) if (last.material, last.motion) == (draw.material, draw.motion) => {
            last.indices.end = draw.indices.end;
        }
        _ => opaque.push(draw),
    }
}

/// Joins the meshes' indices: opaque ones grouped by material, blended ones kept apart.
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
    let (mut indices, mut opaque, mut blended) = (Vec::new(), Vec::<Draw>::new(), Vec::new());
    for mesh in order(scene) {
        let start = indices.len() as u32;
        let source = &scene.meshes[mesh];
        // A corner without a finite place would be drawn at the eye, so its triangles are left out.
        let drawable = |corners: &&[u32]| corners.iter().all(|&i| source.positions[i as usize].is_finite());
        let triangles = source.indices.chunks_exact(3).filter(drawable);
        indices.extend(triangles.flatten().map(|index| index + bases[mesh]));
        let draw = Draw {
            material: source.material,
            motion: source.motion,
            indices: start..indices.len() as u32,
            centre: scene.origin + centre(&source.positions),
            groups: Vec::new(),
        };
        push_draw(&mut opaque, &mut blended, draw, blends(scene, mesh));
    }
    let positions: Vec<Vec3> = scene.meshes.iter().flat_map(|mesh| mesh.positions.iter().copied()).collect();
    for draw in &mut opaque {
        gather(&mut indices[draw.indices.start as usize..draw.indices.end as usize], &positions);
    }
    for draw in opaque.iter_mut().chain(&mut blended) {
        let range = draw.indices.start as usize..draw.indices.end as usize;
        draw.groups = groups(&indices[range], draw.indices.start, &positions, scene.origin);
    }
    (indices, opaque, blended)
}

/// Sorts triangles by the Morton code of their centres, so that neighbours in space are neighbours in the list.
fn gather(indices: &mut [u32], positions: &[Vec3]) {
    let mut triangles: Vec<[u32; 3]> =
        indices.chunks_exact(3).map(|corners| [corners[0], corners[1], corners[2]]).collect();
    let middle = |corners: &[u32; 3]| corners.iter().map(|&i| positions[i as usize]).sum::<Vec3>() / 3.0;
    let (mut low, mut high) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    for triangle in &triangles {
        let middle = middle(triangle);
        (low, high) = (low.min(middle), high.max(middle));
    }
    // One cell size for all axes, 1024 cells along the longest.
    let cells = 1023.0 / (high - low).max_element().max(f32::MIN_POSITIVE);
    triangles.sort_by_cached_key(|triangle| {
        let [x, y, z] = ((middle(triangle) - low) * cells).to_array().map(|cell| spread(cell as u32));
        x | y << 1 | z << 2
    });
    for (place, corner) in indices.iter_mut().zip(triangles.as_flattened()) {
        *place = *corner;
    }
}

/// Ten bits spread with two zeros between each and the next.
fn spread(bits: u32) -> u32 {
    (0..10).fold(0, |sum, bit| sum | (bits >> bit & 1) << (3 * bit))
}

/// Splits a list of triangles into groups. `first` is the place of the list in the index buffer.
fn groups(indices: &[u32], first: u32, positions: &[Vec3], origin: DVec3) -> Vec<Group> {
    let group = |(number, corners): (usize, &[u32])| {
        let corner = |&index: &u32| positions[index as usize].as_dvec3();
        let (low, high) = corners
            .iter()
            .map(corner)
            .fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), at| (low.min(at), high.max(at)));
        let centre = 0.5 * (low + high);
        let radius = corners.iter().map(|index| corner(index).distance(centre)).fold(0.0, f64::max);
        let start = first + (number * 3 * GROUP_TRIANGLES) as u32;
        Group { indices: start..start + corners.len() as u32, centre: origin + centre, radius }
    };
    indices.chunks(3 * GROUP_TRIANGLES).enumerate().map(group).collect()
}

fn centre(positions: &[Vec3]) -> DVec3 {
    let sum: DVec3 = positions.iter().filter(|p| p.is_finite()).map(|p| p.as_dvec3()).sum();
    sum / positions.len().max(1) as f64
}
