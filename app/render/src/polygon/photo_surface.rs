//! The transform beside the render thread: worldwide vertices in, apparent positions out, written directly into
//! memory from which the GPU copies.
//!
//! Three staging buffers circulate (W 6.4.1's flux buffers): one is filled by the `photo-surface` thread and its
//! rayon workers, one is copied from and drawn, one is on its way back. A buffer's way is
//! ```text
//! free ─► submit: job ─► thread: kernel writes the mapped memory ─► receive ─► copy, draw ─► mapped again ─► free
//! ```
//!
//! A photo-surface is handed over as a whole. Call [`PhotoSurface::submit`] for frame n + 1 before the draw of frame
//! n from [`PhotoSurface::receive`], and the two overlap.
//!
//! The kernel does not handle animated bodies. The program solves for each of their vertices, and writes the result
//! into the same streams and one of log2 D.

use crate::gpu::{Gpu, GpuError};
use crate::world::{stream_count, stream_stride};
use scene::Scene;
use scene::motion::{Animated, Course};
use crossbeam_channel::{Receiver, Sender, bounded};
use glam::DVec3;
use physics::Observer;
use physics::photo_surface::{Eye, Kernel, PhotoSurfaceError, Stats, Surface, Vertices};
use rayon::prelude::*;
use std::mem::MaybeUninit;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Number of staging buffers in circulation.
const STAGING_BUFFERS: usize = 3;

/// The transform's thread, its buffers, and the vertex buffer that draws read.
pub struct PhotoSurface {
    jobs: Sender<Job>,
    finished: Receiver<Transformed>,
    free: Receiver<wgpu::Buffer>,
    freed: Sender<wgpu::Buffer>,
    pending: usize,
    /// Apparent positions drawn now: x, y and z streams, [`stream_stride`] bytes apart; if anything is animated, a
    /// fourth of log2 D.
    pub streams: wgpu::Buffer,
}

struct Job {
    staging: wgpu::Buffer,
    /// Eyes in the frame of the resting scene, then in the frame of each motion.
    eyes: Vec<Eye>,
    observer: Observer,
}

/// Successive vertices with the same eye.
enum Run {
    /// Vertices that rest in a frame.
    Still {
        /// Index into a job's eyes.
        eye: usize,
        vertices: Vertices,
    },
    /// Vertices that keys move, with their places in the body's own frame.
    Animated { animated: Arc<Animated>, places: Vec<DVec3> },
}

/// Number of animated vertices that a thread solves for at a time.
const CHUNK: usize = 256;

/// A photo-surface that is ready to draw.
pub struct Transformed {
    staging: wgpu::Buffer,
    /// Counts of vertices and of results that are not finite.
    pub stats: Stats,
    /// Time that the transform took.
    pub duration: Duration,
}

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
            let eye = motion.map_or(0, |motion| 1 + motion);
            Ok(Run::Still { eye, vertices: Vertices::from_offsets(scene.origin, positions)? })
        });
        let runs: Vec<Run> = runs.collect::<Result<_, PhotoSurfaceError>>()?;
        let (freed, free) = bounded(STAGING_BUFFERS);
        for _ in 0..STAGING_BUFFERS {
            let staging = gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("photo-surface staging"),
                size: stream_count(&scene.motions) * stride,
                usage: wgpu::BufferUsages::MAP_WRITE | wgpu::BufferUsages::COPY_SRC,
                mapped_at_creation: true,
            });
            freed.send(staging).expect("the channel holds every buffer");
        }
        let (jobs, job_queue) = bounded::<Job>(STAGING_BUFFERS);
        let (finish, finished) = bounded(STAGING_BUFFERS);
        std::thread::Builder::new()
            .name("photo-surface".to_owned())
            .spawn(move || {
                for job in job_queue {
                    if finish.send(transform(&runs, stride, job)).is_err() {
                        return;
                    }
                }
            })
            .expect("the system can start a thread");
        let streams = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("photo-surface"),
            size: stream_count(&scene.motions) * stride,
            usage: wgpu::BufferUsages::VERTEX | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        Ok(Self { jobs, finished, free, freed, pending: 0, streams })
    }

    /// Begins the transform for an observer. `eyes` are the eye in the frame of the resting scene, then in the frame
    /// of each of the scene's motions. Waits if all buffers are under way.
    ///
    /// # Errors
    /// [`GpuError::Lost`] if the device went away.
    pub fn submit(&mut self, gpu: &Gpu, observer: Observer, eyes: Vec<Eye>) -> Result<(), GpuError> {
        // Buffers come back by callbacks, which run when the device is polled.
        let _ = gpu.device.poll(wgpu::PollType::Poll);
        let staging = match self.free.try_recv() {
            Ok(staging) => staging,
            Err(_) => {
                gpu.wait()?;
                self.free.try_recv().map_err(|_| GpuError::Lost("a staging buffer did not come back".to_owned()))?
            }
        };
        self.jobs
            .send(Job { staging, eyes, observer })
            .map_err(|_| GpuError::Lost("the photo-surface thread has ended".to_owned()))?;
        self.pending += 1;
        Ok(())
    }

    /// Number of photo-surfaces submitted and not yet received.
    pub fn pending(&self) -> usize {
        self.pending
    }

    /// Waits for the oldest photo-surface under way.
    ///
    /// # Errors
    /// [`GpuError::Lost`] if none is under way, or if its thread has ended.
    pub fn receive(&mut self) -> Result<Transformed, GpuError> {
        if self.pending == 0 {
            return Err(GpuError::Lost("no photo-surface was asked for".to_owned()));
        }
        self.pending -= 1;
        self.finished.recv().map_err(|_| GpuError::Lost("the photo-surface thread has ended".to_owned()))
    }

    /// Waits for the oldest photo-surface under way, and frees its buffer, which is still mapped.
    ///
    /// # Errors
    /// Those of [`PhotoSurface::receive`].
    pub fn discard(&mut self) -> Result<(), GpuError> {
        let transformed = self.receive()?;
        self.freed.send(transformed.staging).map_err(|_| GpuError::Lost("the buffers' channel is closed".to_owned()))
    }

    /// Copies a photo-surface to the buffer that draws read, and returns its staging buffer once the GPU is done with
    /// it.
    pub fn upload(&self, encoder: &mut wgpu::CommandEncoder, transformed: Transformed) {
        let staging = transformed.staging;
        staging.unmap();
        encoder.copy_buffer_to_buffer(&staging, 0, &self.streams, 0, staging.size());
        let (back, freed) = (staging.clone(), self.freed.clone());
        encoder.map_buffer_on_submit(&staging, wgpu::MapMode::Write, .., move |mapped| {
            if mapped.is_ok() {
                // A closed channel means that the renderer is gone, and the buffer with it.
                let _ = freed.send(back);
            }
        });
    }
}

/// Runs the kernel on the mapped memory of one buffer.
fn transform(runs: &[Run], stride: u64, job: Job) -> Transformed {
    let started = Instant::now();
    let mut mapped = job.staging.get_mapped_range_mut(..).expect("a free staging buffer is mapped");
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
        let (eye, vertices) = match run {
            Run::Still { eye, vertices } => (eye, vertices),
            Run::Animated { animated, places } => {
                stats.vertices += count;
                stats.not_finite_results += solve(&Course::new(animated, &job.observer), places, streams, log2_doppler);
                continue;
            }
        };
        let surface = Surface::in_write_only(vertices, streams).expect("streams are cut to the number of vertices");
        seen.push((job.eyes[*eye], surface));
    }
    let of_kernel = Kernel::default().transform_each(seen);
    stats.vertices += of_kernel.vertices;
    stats.not_finite_inputs += of_kernel.not_finite_inputs;
    stats.not_finite_results += of_kernel.not_finite_results;
    drop(mapped);
    Transformed { staging: job.staging, stats, duration: started.elapsed() }
}

/// Writes the apparent positions of an animated body's vertices, and log2 D. Vertices without an apparent position
/// are put at the eye. Returns their number.
fn solve(
    course: &Course,
    places: &[DVec3],
    [x, y, z]: [&mut [MaybeUninit<f32>]; 3],
    log2_doppler: &mut [MaybeUninit<f32>],
) -> usize {
    let streams = x.par_chunks_mut(CHUNK).zip(y.par_chunks_mut(CHUNK)).zip(z.par_chunks_mut(CHUNK));
    let chunks = places.par_chunks(CHUNK).zip(streams.zip(log2_doppler.par_chunks_mut(CHUNK)));
    let solved = chunks.map(|(places, (((x, y), z), log2_doppler))| {
        let mut nowhere = 0;
        for (index, place) in places.iter().enumerate() {
            let seen = course.seen(*place);
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
