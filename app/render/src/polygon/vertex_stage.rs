//! The photo-surface bent by the GPU's vertex stage, in the light-cone form.
//!
//! The scene's vertices lie on the device and stay there; a frame needs to write no more than where the eye is. But the part across the motion
//! loses its digits in f32 near dead astern, and shaders may not rely on more: so chunks of vertices that reach into the rear cone are bent by the
//! kernel on the CPU, in f64 where it matters, and handed over. The streams hold those; for all others they hold [`shaders::NOT_BENT`].

use crate::gpu::Gpu;
use crate::world::stream_stride;
use scene::Scene;
use glam::{DVec3, Vec4};
use physics::photo_surface::{CHUNK, Eye, Kernel, PhotoSurfaceError, Surface, Vertices};

/// A scene's vertices in chunks, and the streams that tell the vertex stage which of them are bent already.
pub struct VertexStage {
    chunks: Vec<Chunk>,
    origin: DVec3,
    /// Apparent positions of what the CPU has bent: x, y and z streams, [`stream_stride`] bytes apart.
    pub streams: wgpu::Buffer,
    stride: u64,
}

/// Neighbouring vertices that move alike.
struct Chunk {
    /// Which of the eyes: of what rests, then of each motion.
    eye: usize,
    /// Of all the scene's vertices.
    first: usize,
    vertices: Vertices,
    /// Whether the streams hold apparent positions of it.
    bent: bool,
}

impl VertexStage {
    /// For the vertices of `scene`.
    ///
    /// # Errors
    /// [`PhotoSurfaceError::Origin`] if the scene's origin is not finite.
    pub fn new(gpu: &Gpu, scene: &Scene) -> Result<Self, PhotoSurfaceError> {
        let mut chunks = Vec::new();
        let mut first = 0;
        for mesh in &scene.meshes {
            for positions in mesh.positions.chunks(CHUNK) {
                let vertices = Vertices::from_offsets(scene.origin, positions.iter().copied())?;
                // At first none is bent, which has to be written.
                chunks.push(Chunk { eye: mesh.motion.map_or(0, |motion| 1 + motion), first, vertices, bent: true });
                first += positions.len();
            }
        }
        let stride = stream_stride(first);
        let streams = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("vertices bent on the CPU"),
            size: 3 * stride,
            usage: wgpu::BufferUsages::VERTEX | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        Ok(Self { chunks, origin: scene.origin, streams, stride })
    }

    /// Bends on the CPU what the vertex stage cannot, for an eye as what rests has it, then as each of the scene's motions has it.
    pub fn bend(&mut self, gpu: &Gpu, eyes: &[Eye]) {
        let write = |first: usize, streams: [&[f32]; 3]| {
            for (axis, stream) in (0..).zip(streams) {
                gpu.queue.write_buffer(
                    &self.streams,
                    axis * self.stride + 4 * first as u64,
                    bytemuck::cast_slice(stream),
                );
            }
        };
        for Chunk { eye, first, vertices, bent } in &mut self.chunks {
            let astern = vertices.reach_astern(&eyes[*eye]);
            if astern {
                let mut streams = [const { Vec::new() }; 3];
                streams.iter_mut().for_each(|stream: &mut Vec<f32>| stream.resize(vertices.len(), 0.0));
                let [x, y, z] = &mut streams;
                let surface = Surface::new(vertices, [x, y, z]).expect("streams are as long as the chunk");
                Kernel::default().transform(&eyes[*eye], vec![surface]);
                write(*first, streams.each_ref().map(Vec::as_slice));
            } else if *bent {
                let unbent = vec![shaders::NOT_BENT; vertices.len()];
                write(*first, [&unbent; 3]);
            }
            *bent = astern;
        }
    }

    /// Chunks that the CPU bends for the newest eye, and all.
    pub fn chunks_astern(&self) -> (usize, usize) {
        (self.chunks.iter().filter(|chunk| chunk.bent).count(), self.chunks.len())
    }

    /// A view of what rests or moves, for the vertex stage: where its eye is.
    #[must_use]
    pub fn view(&self, view: shaders::View, eye: &Eye) -> shaders::View {
        let offset = eye.position() - self.origin;
        let rounded = offset.as_vec3();
        let rest = (offset - rounded.as_dvec3()).as_vec3();
        shaders::View { eye: Vec4::from((rounded, 0.0)), eye_rest: Vec4::from((rest, 0.0)), ..view }
    }
}
