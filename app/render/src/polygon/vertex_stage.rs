//! The photo-surface computed by the GPU's vertex stage, in the light-cone form.
//!
//! The scene's vertices stay on the device, and a frame needs to write only the place of the eye. But the component
//! across the motion loses its digits in f32 near dead astern, and shaders may not rely on more than f32. So chunks
//! of vertices that reach into the rear cone are bent by the kernel on the CPU, in f64 where it matters, and
//! uploaded. The streams hold those vertices; for all others they hold [`shaders::NOT_BENT`].

use crate::certainty::{Certainty, Edges, EdgesDrawn};
use crate::gpu::Gpu;
use crate::method::{Method, Sample};
use crate::moving_objects::{self, Axes};
use crate::world::{World, stream_stride};
use glam::{DVec3, Vec4};
use physics::Observer;
use physics::photo_surface::{CHUNK, Kernel, PhotoSurfaceError, PhotoSurfaceEye, PhotoSurfaceMesh, Vertices};
use scene::Scene;
use scene::motion::Motion;
use view::Shot;

/// A scene's vertices in chunks, and the streams that mark for the vertex stage the vertices that are already bent.
pub struct VertexStage {
    chunks: Vec<Chunk>,
    origin: DVec3,
    /// Apparent positions of the vertices bent on the CPU: x, y and z streams, [`stream_stride`] bytes apart.
    streams: wgpu::Buffer,
    stride: u64,
    motions: Vec<Motion>,
}

/// Neighbouring vertices with the same motion.
struct Chunk {
    /// Index into the eyes: 0 for the resting scene, then one for each motion.
    observer: usize,
    /// Index of the first vertex among all vertices of the scene.
    first: usize,
    vertices: Vertices,
    /// True if the streams hold apparent positions of the chunk.
    bent: bool,
}

impl VertexStage {
    /// Vertex stage for the vertices of `scene`.
    ///
    /// # Errors
    /// [`PhotoSurfaceError::Origin`] if the scene's origin is not finite.
    pub fn new(gpu: &Gpu, scene: &Scene) -> Result<Self, PhotoSurfaceError> {
        let mut chunks = Vec::new();
        let mut first = 0;
        for mesh in &scene.meshes {
            for positions in mesh.positions.chunks(CHUNK) {
                let vertices = Vertices::from_offsets(scene.origin, positions.iter().copied())?;
                // Every chunk starts as bent, so that the first frame writes that it is not.
                let observer = mesh.motion.map_or(0, |motion| 1 + motion);
                chunks.push(Chunk { observer, first, vertices, bent: true });
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
        Ok(Self { chunks, origin: scene.origin, streams, stride, motions: scene.motions.clone() })
    }

    /// Bends on the CPU the chunks that the vertex stage cannot bend. `observers` are the observer in the world, then
    /// in the frame of each of the scene's motions.
    fn bend(&mut self, gpu: &Gpu, observers: &[Observer]) {
        let write = |first: usize, streams: [&[f32]; 3]| {
            for (axis, stream) in (0..).zip(streams) {
                gpu.queue.write_buffer(
                    &self.streams,
                    axis * self.stride + 4 * first as u64,
                    bytemuck::cast_slice(stream),
                );
            }
        };
        for Chunk { observer, first, vertices, bent } in &mut self.chunks {
            let eye = PhotoSurfaceEye::from(&observers[*observer]);
            let astern = vertices.reach_astern(&eye);
            if astern {
                let mut streams = [const { Vec::new() }; 3];
                streams.iter_mut().for_each(|stream: &mut Vec<f32>| stream.resize(vertices.len(), 0.0));
                let [x, y, z] = &mut streams;
                let surface = PhotoSurfaceMesh::new(vertices, [x, y, z]).expect("streams are as long as the chunk");
                Kernel::default().transform(&eye, vec![surface]);
                write(*first, streams.each_ref().map(Vec::as_slice));
            } else if *bent {
                let unbent = vec![shaders::NOT_BENT; vertices.len()];
                write(*first, [&unbent; 3]);
            }
            *bent = astern;
        }
    }

    /// View for the vertex stage: `view` with the place of this observer.
    fn view(&self, view: shaders::ViewUniforms, observer: &Observer) -> shaders::ViewUniforms {
        let offset = observer.event.position - self.origin;
        let rounded = offset.as_vec3();
        let rest = (offset - rounded.as_dvec3()).as_vec3();
        shaders::ViewUniforms { eye: Vec4::from((rounded, 0.0)), eye_rest: Vec4::from((rest, 0.0)), ..view }
    }
}

impl Method for VertexStage {
    fn name(&self) -> &'static str {
        "polygon"
    }

    fn axes(&self) -> Axes {
        Axes::Group
    }

    fn prepare_eye(&mut self, gpu: &Gpu, _world: &mut World, shots: &[(Shot, [u32; 2])]) {
        if let Some((shot, _)) = shots.first() {
            self.bend(gpu, &moving_objects::observers(&self.motions, &shot.observer));
        }
    }

    fn draw(&mut self, gpu: &Gpu, encoder: &mut wgpu::CommandEncoder, mut sample: Sample<'_>) {
        let observers = moving_objects::observers(&self.motions, &sample.shot.observer);
        for (view, observer) in sample.views.iter_mut().zip(&observers) {
            *view = self.view(*view, observer);
        }
        sample.draw_streams(gpu, encoder, Some(&self.streams), true);
    }

    fn certainty(&self, edges: &Edges, estimate: &dyn Fn(&Edges, EdgesDrawn) -> Certainty) -> Certainty {
        estimate(edges, EdgesDrawn::ByKernel)
    }
}
