//! The transform, in parallel with the render thread: world positions of vertices in, apparent positions out, written
//! directly into memory from which the GPU copies.
//!
//! Three staging buffers circulate (W 6.4.1's flux buffers): one is filled by the `photo-surface` thread and its
//! rayon workers, one is copied from and drawn, one is on its way back. A buffer's way is
//! ```text
//! free ─► submit: job ─► thread: kernel writes the mapped memory ─► show: copy, draw ─► mapped again ─► free
//! ```
//!
//! A photo-surface is handed over as a whole, by a [`Pending`] that `show` takes. Submit frame n + 1 before frame n is
//! shown, and the two overlap.
//!
//! The kernel does not handle animated bodies. The program solves for each of their vertices, and writes the result
//! into the same streams and one of log2 D.

use crate::certainty::{Certainty, Edges, EdgesDrawn};
use crate::gpu::{Gpu, GpuError};
use crate::method::{Method, Sample};
use crate::moving_objects::Axes;
use crate::pending::{Pending, Staging, Transformed};
use crate::world::{stream_count, stream_stride};
use crossbeam_channel::{Receiver, Sender, bounded, unbounded};
use glam::DVec3;
use physics::Observer;
use physics::photo_surface::{Kernel, PhotoSurfaceError, PhotoSurfaceEye, PhotoSurfaceMesh, Stats, Vertices};
use rayon::prelude::*;
use scene::Scene;
use scene::motion::{Animated, ObservedBody};
use std::mem::MaybeUninit;
use std::sync::Arc;
use std::time::Instant;

/// Number of staging buffers in circulation.
const STAGING_BUFFERS: usize = 3;

/// The `polygon` method for triangles that were cut once: the transform's thread, its buffers, and the vertex buffer
/// that draws read.
pub struct PhotoSurface {
    jobs: Sender<Job>,
    free: Receiver<wgpu::Buffer>,
    freed: Sender<wgpu::Buffer>,
    /// Apparent positions drawn now: x, y and z streams, [`stream_stride`] bytes apart; if anything is animated, a
    /// fourth of log2 D.
    streams: wgpu::Buffer,
}

struct Job {
    staging: Staging,
    /// The observer in the world, then in the frame of each motion.
    observers: Vec<Observer>,
    finish: Sender<Transformed>,
}

/// Successive vertices that move alike.
enum Run {
    /// Vertices that rest in a frame.
    Still {
        /// Index into a job's observers.
        observer: usize,
        vertices: Vertices,
    },
    /// Vertices that keys move, with their places in the body's own frame.
    Animated { animated: Arc<Animated>, places: Vec<DVec3> },
}

/// Number of animated vertices that a thread solves for at a time.
const CHUNK: usize = 256;

impl PhotoSurface {
    /// Starts the thread for the vertices of `scene`.
    ///
    /// # Errors
    /// [`PhotoSurfaceError::Origin`] if the scene's origin is not finite.
    pub fn new(gpu: &Gpu, scene: &Scene) -> Result<Self, PhotoSurfaceError> {
        let stride = stream_stride(scene.vertex_count());
        // Successive meshes with the same motion form one run. If nothing moves, there is a single run.
        let runs = scene.meshes.chunk_by(|a, b| a.motion == b.motion).map(|meshes| {
            let positions = meshes.iter().flat_map(|mesh| mesh.positions.iter().copied());
            let motion = meshes[0].motion;
            if let Some(animated) = motion.and_then(|motion| scene.motions[motion].animated()) {
                let places = positions.map(|place| place.as_dvec3()).collect();
                return Ok(Run::Animated { animated: Arc::clone(animated), places });
            }
            let observer = motion.map_or(0, |motion| 1 + motion);
            Ok(Run::Still { observer, vertices: Vertices::from_offsets(scene.origin, positions)? })
        });
        let runs: Vec<Run> = runs.collect::<Result<_, PhotoSurfaceError>>()?;
        let (freed, free) = unbounded();
        let size = stream_count(&scene.motions) * stride;
        for _ in 0..STAGING_BUFFERS {
            freed.send(staging_buffer(gpu, size)).expect("this function holds the other end");
        }
        let (jobs, job_queue) = bounded::<Job>(STAGING_BUFFERS);
        std::thread::Builder::new()
            .name("photo-surface".to_owned())
            .spawn(move || {
                for Job { staging, observers, finish } in job_queue {
                    if let Some(transformed) = transform(&runs, stride, staging, &observers) {
                        // A caller that no longer waits drops the photo-surface, and its buffer returns.
                        let _ = finish.send(transformed);
                    }
                }
            })
            .expect("the system can start a thread");
        let streams = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("photo-surface"),
            size,
            usage: wgpu::BufferUsages::VERTEX | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        Ok(Self { jobs, free, freed, streams })
    }
}

impl Method for PhotoSurface {
    fn name(&self) -> &'static str {
        "polygon"
    }

    fn axes(&self) -> Axes {
        Axes::Group
    }

    fn submit(&mut self, gpu: &Gpu, observers: Vec<Observer>) -> Result<Pending, GpuError> {
        // Buffers come back by callbacks, which run when the device is polled.
        let _ = gpu.device.poll(wgpu::PollType::Poll);
        let buffer = match self.free.try_recv() {
            Ok(buffer) => buffer,
            // All are under way, or in pictures that the device still draws.
            Err(_) => {
                gpu.wait()?;
                self.free.try_recv().unwrap_or_else(|_| staging_buffer(gpu, self.streams.size()))
            }
        };
        let staging = Staging::new(buffer, self.freed.clone());
        let (finish, finished) = bounded(1);
        let lost = |_| GpuError::Lost("the memory of a photo-surface is gone".to_owned());
        self.jobs.send(Job { staging, observers, finish }).map_err(lost)?;
        Ok(Pending::of(finished))
    }

    fn show(&mut self, gpu: &Gpu, transformed: Transformed) {
        let (staging, home) = transformed.staging.into_parts();
        staging.unmap();
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        encoder.copy_buffer_to_buffer(&staging, 0, &self.streams, 0, staging.size());
        let back = staging.clone();
        encoder.map_buffer_on_submit(&staging, wgpu::MapMode::Write, .., move |mapped| {
            if mapped.is_ok() {
                // A closed channel means that the renderer is gone, and the buffer with it.
                let _ = home.send(back);
            }
        });
        gpu.queue.submit([encoder.finish()]);
    }

    fn draw(&mut self, gpu: &Gpu, encoder: &mut wgpu::CommandEncoder, sample: Sample<'_>) {
        sample.draw_streams(gpu, encoder, Some(&self.streams), false);
    }

    fn certainty(&self, edges: &Edges, estimate: &dyn Fn(&Edges, EdgesDrawn) -> Certainty) -> Certainty {
        estimate(edges, EdgesDrawn::ByKernel)
    }
}

/// A buffer to be written by the CPU and copied from, mapped.
fn staging_buffer(gpu: &Gpu, size: u64) -> wgpu::Buffer {
    gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("photo-surface staging"),
        size,
        usage: wgpu::BufferUsages::MAP_WRITE | wgpu::BufferUsages::COPY_SRC,
        mapped_at_creation: true,
    })
}

/// Runs the kernel on the mapped memory of one buffer; `None` if that memory went away with the device.
fn transform(runs: &[Run], stride: u64, staging: Staging, observers: &[Observer]) -> Option<Transformed> {
    let started = Instant::now();
    let mut mapped = staging.buffer().get_mapped_range_mut(..).ok()?;
    let length = mapped.slice(..).len() / 4;
    let start = mapped.slice(..).as_raw_element_ptr().cast::<MaybeUninit<f32>>();
    // SAFETY: the mapping holds `length` floats, is aligned to at least 8 bytes (WebGPU's MAP_ALIGNMENT), and is
    // exclusively ours until `mapped` is dropped. As MaybeUninit it need not be readable, and the kernel only writes.
    let floats = unsafe { std::slice::from_raw_parts_mut(start.as_ptr(), length) };
    let (mut x, rest) = floats.split_at_mut(stride as usize / 4);
    let (mut y, rest) = rest.split_at_mut(stride as usize / 4);
    let (mut z, mut log2_doppler) = rest.split_at_mut(stride as usize / 4);
    let mut stats = Stats::default();
    let mut seen = Vec::with_capacity(runs.len());
    for run in runs {
        let count = match run {
            Run::Still { vertices, .. } => vertices.len(),
            Run::Animated { places, .. } => places.len(),
        };
        let streams = [&mut x, &mut y, &mut z]
            .map(|stream| stream.split_off_mut(..count).expect("streams have room for all vertices"));
        // If nothing is animated, there is no stream of log2 D.
        let log2_doppler = log2_doppler.split_off_mut(..count).unwrap_or_default();
        let (observer, vertices) = match run {
            Run::Still { observer, vertices } => (&observers[*observer], vertices),
            Run::Animated { animated, places } => {
                stats.vertices += count;
                stats.not_finite_results +=
                    solve(&ObservedBody::new(animated, &observers[0]), places, streams, log2_doppler);
                continue;
            }
        };
        let surface =
            PhotoSurfaceMesh::in_write_only(vertices, streams).expect("streams are cut to the number of vertices");
        seen.push((PhotoSurfaceEye::from(observer), surface));
    }
    let of_kernel = Kernel::default().transform_each(seen);
    stats.vertices += of_kernel.vertices;
    stats.not_finite_inputs += of_kernel.not_finite_inputs;
    stats.not_finite_results += of_kernel.not_finite_results;
    drop(mapped);
    Some(Transformed { staging, stats, duration: started.elapsed() })
}

/// Writes the apparent positions of an animated body's vertices, and log2 D. Vertices without an apparent position
/// are put at the eye. Returns their number.
fn solve(
    body: &ObservedBody,
    places: &[DVec3],
    [x, y, z]: [&mut [MaybeUninit<f32>]; 3],
    log2_doppler: &mut [MaybeUninit<f32>],
) -> usize {
    let streams = x.par_chunks_mut(CHUNK).zip(y.par_chunks_mut(CHUNK)).zip(z.par_chunks_mut(CHUNK));
    let chunks = places.par_chunks(CHUNK).zip(streams.zip(log2_doppler.par_chunks_mut(CHUNK)));
    let solved = chunks.map(|(places, (((x, y), z), log2_doppler))| {
        let mut nowhere = 0;
        for (index, place) in places.iter().enumerate() {
            let seen = body.seen(*place);
            let apparent = seen.map_or(DVec3::ZERO, |seen| seen.apparent).as_vec3();
            let apparent = if apparent.is_finite() { apparent } else { glam::Vec3::ZERO };
            nowhere += usize::from(seen.is_none());
            x[index].write(apparent.x);
            y[index].write(apparent.y);
            z[index].write(apparent.z);
            log2_doppler[index].write(seen.map_or(0.0, |seen| seen.doppler.log2()) as f32);
        }
        nowhere
    });
    solved.sum()
}
