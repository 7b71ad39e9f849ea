//! Places of a scene's vertices, worked out in f64 and written to the device.

use glam::{DVec3, Vec3};
use rayon::prelude::*;
use scene::Scene;
use scene::cut::{Cut, CutVertex, SeenFrom};

use crate::gpu::Gpu;
use crate::world::{hand_over, stream_count, stream_stride};

/// Number of vertices that a thread transforms at a time.
const CHUNK: usize = 4096;

/// Number of vertices that are written to the device at a time.
const PIECE: usize = 1 << 20;

/// Buffer for the places of all vertices of a scene, or of one of its cuts.
pub fn place_streams(gpu: &Gpu, scene: &Scene, cut: Option<&Cut>) -> wgpu::Buffer {
    gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("places of vertices"),
        size: stream_count(&scene.motions) * stream_stride(vertex_count(scene, cut)),
        usage: wgpu::BufferUsages::VERTEX | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    })
}

fn vertex_count(scene: &Scene, cut: Option<&Cut>) -> usize {
    cut.map_or_else(|| scene.vertex_count(), |cut| cut.vertices)
}

/// Writes the places of all vertices of a scene, or of one of its cuts, relative to the eye in the observer's axes: x,
/// y and z streams, and one of log2 D if anything is animated. Vertices without a place are put at the eye. `sights`
/// are of the resting scene, then of each motion.
pub fn write_places(gpu: &Gpu, scene: &Scene, cut: Option<&Cut>, sights: &[SeenFrom], buffer: &wgpu::Buffer) {
    let vertices = vertex_count(scene, cut);
    let stride = stream_stride(vertices);
    let count = stream_count(&scene.motions) as usize;
    let mut piece = vec![0.0_f32; count * vertices.min(PIECE)];
    let mut parts = scene.meshes.iter().enumerate().flat_map(|(number, mesh)| {
        let sight = &sights[mesh.motion.map_or(0, |motion| 1 + motion)];
        let own = mesh.positions.chunks(CHUNK).map(VertexRun::Own);
        let added: &[CutVertex] = cut.map_or(&[], |cut| &cut.meshes[number].added);
        own.chain(added.chunks(CHUNK).map(VertexRun::Added)).map(move |run| (sight, run))
    });
    let mut next = parts.next();
    let mut first = 0;
    while next.is_some() {
        // Share as many vertices among the threads as there is room for.
        let room = piece.len() / count;
        let mut streams = piece.chunks_exact_mut(room);
        let [mut x, mut y, mut z, mut log2_doppler] = [(); 4].map(|()| streams.next().unwrap_or_default());
        let mut jobs = Vec::new();
        let mut taken = 0;
        while let Some((sight, run)) = next.take_if(|(_, run)| taken + run.len() <= room) {
            let streams = [&mut x, &mut y, &mut z].map(|stream| stream.split_off_mut(..run.len()));
            let log2_doppler = log2_doppler.split_off_mut(..run.len()).unwrap_or_default();
            taken += run.len();
            jobs.push((sight, run, streams, log2_doppler));
            next = parts.next();
        }
        jobs.into_par_iter().for_each(|(sight, run, [x, y, z], log2_doppler)| {
            let [Some(x), Some(y), Some(z)] = [x, y, z] else { return };
            for index in 0..run.len() {
                let place = run.place(index);
                let seen = match &sight.body {
                    None => sight.apparent(place),
                    Some(body) => {
                        let seen = if sight.contraction.is_some() { body.measured(place) } else { body.seen(place) };
                        log2_doppler[index] = seen.map_or(0.0, |seen| seen.doppler.log2()) as f32;
                        seen.map_or(DVec3::ZERO, |seen| seen.apparent)
                    }
                };
                let seen = seen.as_vec3();
                let seen = if seen.is_finite() { seen } else { Vec3::ZERO };
                (x[index], y[index], z[index]) = (seen.x, seen.y, seen.z);
            }
        });
        for (number, stream) in (0..).zip(piece.chunks_exact(room)) {
            let offset = number * stride + 4 * first as u64;
            gpu.queue.write_buffer(buffer, offset, bytemuck::cast_slice(&stream[..taken]));
        }
        first += taken;
        if next.is_some() {
            hand_over(gpu);
        }
    }
}

/// Successive vertices of a cut.
enum VertexRun<'a> {
    /// Vertices of the mesh.
    Own(&'a [Vec3]),
    /// Vertices that the cut added.
    Added(&'a [CutVertex]),
}

impl VertexRun<'_> {
    fn len(&self) -> usize {
        match self {
            Self::Own(positions) => positions.len(),
            Self::Added(vertices) => vertices.len(),
        }
    }

    fn place(&self, index: usize) -> DVec3 {
        match self {
            Self::Own(positions) => positions[index].as_dvec3(),
            Self::Added(vertices) => vertices[index].place,
        }
    }
}
