//! The kernel: meshes of a frame cut into chunks, shared between threads.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

use super::error::PhotoSurfaceError;
use super::eye::PhotoSurfaceEye;
use super::instructions::Instructions;
use super::line::CHUNK;
use super::mesh::PhotoSurfaceMesh;
use super::simd;
use super::stats::Stats;

/// Way of writing results: through the caches or past them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Stores {
    /// Past the caches if a frame's results would not stay in them anyway.
    #[default]
    Automatic,
    /// Always through the caches.
    Cached,
    /// Always past the caches, where the output is aligned to 64 bytes.
    Streamed,
}

/// Number of vertices below which one thread works alone: another thread is awake after 50 to 100 µs, and a vertex
/// takes 1 ns. Two threads broke even at 80,000 to 100,000 vertices.
const SERIAL_BELOW: usize = 10 * CHUNK;

/// Bytes of results above which they leave the second-level cache before they are read.
const STREAMED_ABOVE_BYTES: usize = 1 << 20;

/// Instructions and stores by which transforms are carried out. The default is the fastest way on this machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Kernel {
    instructions: Instructions,
    stores: Stores,
}

impl Default for Kernel {
    fn default() -> Self {
        Self { instructions: Instructions::fastest(), stores: Stores::default() }
    }
}

impl Kernel {
    /// A kernel that computes with given instructions, to compare them.
    ///
    /// # Errors
    /// [`PhotoSurfaceError::Instructions`] if this processor does not have them.
    pub fn with_instructions(instructions: Instructions) -> Result<Self, PhotoSurfaceError> {
        if instructions.are_available() {
            Ok(Self { instructions, stores: Stores::default() })
        } else {
            Err(PhotoSurfaceError::Instructions { instructions })
        }
    }

    /// The kernel with a given kind of stores, to compare them.
    #[must_use]
    pub fn with_stores(self, stores: Stores) -> Self {
        Self { stores, ..self }
    }

    /// Instructions that the kernel computes with.
    pub fn instructions(&self) -> Instructions {
        self.instructions
    }

    /// Writes the photo-surface of all meshes of a frame, shared between the caller and the current rayon pool.
    ///
    /// *Frames*: `eye` (an `&Observer` or an eye) and vertices in the world frame; apparent positions relative to the
    /// eye, in its rest frame, on the world's axes after a pure boost; metres. *Equation*: the light-cone form of
    /// x' = d + u (r + u·d/(1+γ)), D = γ + u·n (W 5.1), with d the displacement from the eye to the vertex.
    ///
    /// A position of the eye that is not finite makes no result finite: every vertex is counted.
    pub fn transform<'e, E>(&self, eye: &'e E, surfaces: Vec<PhotoSurfaceMesh<'_>>) -> Stats
    where
        PhotoSurfaceEye: From<&'e E>,
    {
        let eye = PhotoSurfaceEye::from(eye);
        self.transform_each(surfaces.into_iter().map(|surface| (eye, surface)).collect())
    }

    /// Writes the photo-surfaces of meshes that have an eye each: an object in uniform motion has the observer in the
    /// object's own frame (W 5.1.2).
    pub fn transform_each<E: Into<PhotoSurfaceEye>>(&self, surfaces: Vec<(E, PhotoSurfaceMesh<'_>)>) -> Stats {
        let surfaces: Vec<(PhotoSurfaceEye, _)> =
            surfaces.into_iter().map(|(eye, surface)| (eye.into(), surface)).collect();
        let vertices: usize = surfaces.iter().map(|(_, surface)| surface.vertices().len()).sum();
        let not_finite_inputs = surfaces.iter().map(|(_, surface)| surface.vertices().not_finite().len()).sum();
        let bytes: usize = surfaces.iter().map(|(_, surface)| surface.output_bytes()).sum();
        let streaming = match self.stores {
            Stores::Automatic => bytes > STREAMED_ABOVE_BYTES,
            Stores::Cached => false,
            Stores::Streamed => true,
        };

        let helpers = match vertices {
            ..SERIAL_BELOW => 0,
            _ => rayon::current_num_threads().min(vertices.div_ceil(CHUNK)) - 1,
        };

        // The calling thread begins at once. Others take chunks from the same queue as soon as they are awake.
        let queue = Mutex::new(surfaces.into_iter().flat_map(|(eye, surface)| surface.into_chunks(&eye, streaming)));
        let not_finite = AtomicUsize::new(0);
        let work = || {
            while let Some(chunk) = next(&queue) {
                not_finite.fetch_add(simd::run(self.instructions, chunk), Ordering::Relaxed);
            }
        };
        rayon::in_place_scope(|scope| {
            (0..helpers).for_each(|_| scope.spawn(|_| work()));
            work();
        });
        let not_finite = not_finite.into_inner();
        Stats { vertices, not_finite_inputs, not_finite_results: not_finite - not_finite_inputs }
    }
}

/// The next item of a queue. A thread that panicked leaves the queue as good as before.
fn next<I: Iterator>(queue: &Mutex<I>) -> Option<I::Item> {
    queue.lock().unwrap_or_else(PoisonError::into_inner).next()
}
