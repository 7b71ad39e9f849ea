//! The photo-surface of things at rest in the world: where their vertices appear to an eye that moves.
//!
//! Light that reaches the eye together left the vertices at different times, from the eye's past light cone.
//! In the eye's own rest frame those emission events lie at the *apparent positions*; the surface they make is
//! the photo-surface (Weiskopf 2001, 5.1). Drawing it like any other mesh, with the eye at the origin, gives
//! the picture that the moving observer sees, aberration and light-travel time included.
//!
//! # How it works
//! [`Vertices`] keeps a mesh as three f32 streams about an f64 origin. Once a frame the eye's velocity becomes
//! a plan in f64: κ = γ + |u| and the direction of motion. Every chunk of 8192 vertices then gets the cheapest
//! formula that is accurate everywhere in its bounding sphere: a mere shift for an eye at rest, the light-cone form in
//! f32, or, where the chunk reaches into the cone of 14.5° astern, the same with one cross product in f64 for
//! those that lie there. Registers are as wide as the processor has them, and the threads of the rayon pool share
//! the chunks of all meshes.
//!
//! # What can be relied on
//! - Directions are within 7e-7 rad of exact for γ ≤ 1e9 at distances of 1e-3 to 1e6 m, and within 4e-4 rad for γ ≤ 1e12
//!   (`tests/photo_surface_accuracy.rs`).
//! - The output of an eye at rest is p − o, rounded, and D = 1 exactly.
//! - The bits do not depend on the number of threads, on how a mesh's output is aligned, or on whether AVX2 or AVX-512
//!   computed it; [`Instructions::Portable`] may differ in the last bits on processors without fused operations.
//! - Output memory is only written, never read, so that it may be a mapped GPU buffer.
//! - A vertex without a finite result, because its coordinates are not finite, or it is or appears further away
//!   than 5e18 m, is written as zeros with D = 0, and counted in [`Stats`].
//! - A vertex at a moving eye has no direction: it is written as zeros with D = 0. Nearer than 1e-18 m D is not
//!   reliable; everywhere else D > 0.
//!
//! # Example
//! ```
//! use glam::DVec3;
//! use physics::photo_surface::{Eye, Kernel, Surface, Vertices};
//!
//! // A point one metre ahead, for an eye at 0.6 c: u = 0.75, γ = 1.25, D = 2.
//! let vertices = Vertices::from_world(DVec3::ZERO, [DVec3::NEG_Z])?;
//! let eye = Eye::new(DVec3::ZERO, DVec3::NEG_Z * 0.75)?;
//! let (mut x, mut y, mut z, mut doppler) = ([0.0], [0.0], [0.0], [0.0]);
//! let surface = Surface::new(&vertices, [&mut x, &mut y, &mut z])?.with_doppler(&mut doppler)?;
//! let stats = Kernel::default().transform(&eye, vec![surface]);
//! assert_eq!((x[0], y[0], z[0], doppler[0]), (0.0, 0.0, -2.0, 2.0));
//! assert_eq!(stats.not_finite(), 0);
//! # Ok::<(), physics::photo_surface::PhotoSurfaceError>(())
//! ```

mod chunk;
mod formula;
mod lanes;
mod plan;
mod simd;
mod surface;
#[cfg(target_arch = "x86_64")]
mod twice;
mod vertices;

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

use glam::DVec3;
use thiserror::Error;

pub use plan::Eye;
pub use simd::Instructions;
pub use surface::Surface;
pub use vertices::{CHUNK, Vertices};

/// What cannot be transformed.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum PhotoSurfaceError {
    /// The eye is nowhere, or its velocity is none.
    #[error("the eye's position {position} m and celerity {celerity} must be finite numbers")]
    Eye {
        /// As given; world frame, metres.
        position: DVec3,
        /// As given.
        celerity: DVec3,
    },
    /// The vertices have no origin.
    #[error("the vertices' origin {origin} m must be finite: take a point near the middle of the mesh")]
    Origin {
        /// As given; world frame, metres.
        origin: DVec3,
    },
    /// The memory for the results does not fit the mesh.
    #[error(
        "the output stream {stream} holds {length} values and the mesh has {vertices} vertices: they must be as many"
    )]
    OutputLength {
        /// `x`, `y`, `z` or `doppler`.
        stream: &'static str,
        /// Values in the stream.
        length: usize,
        /// Vertices in the mesh.
        vertices: usize,
    },
    /// This processor cannot compute as asked.
    #[error("this processor has no {instructions:?} instructions: take Instructions::fastest()")]
    Instructions {
        /// As asked for.
        instructions: Instructions,
    },
}

/// What a transform met with.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Stats {
    /// Vertices transformed.
    pub vertices: usize,
    /// Vertices whose coordinates are not finite.
    pub not_finite_inputs: usize,
    /// Vertices with finite coordinates whose results are not: too far away.
    pub not_finite_results: usize,
}

impl Stats {
    /// All vertices that were written as zeros for want of a finite result.
    pub fn not_finite(&self) -> usize {
        self.not_finite_inputs + self.not_finite_results
    }
}

/// Whether results go through the caches.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Stores {
    /// Past them where a frame's results would not stay in them anyway.
    #[default]
    Automatic,
    /// Always through them.
    Cached,
    /// Always past them, where the output is aligned to 64 bytes.
    Streamed,
}

/// Fewer vertices than this are done before help arrives: another thread is awake after 50 to 100 µs, and a vertex
/// takes 1 ns. Two threads broke even at 80,000 to 100,000 vertices.
const SERIAL_BELOW: usize = 10 * CHUNK;

/// More bytes of results than this leave the second-level cache before they are read.
const STREAMED_ABOVE_BYTES: usize = 1 << 20;

/// How transforms are carried out. The default is the fastest way on this machine.
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

    /// The same kernel with a given kind of stores, to compare them.
    #[must_use]
    pub fn with_stores(self, stores: Stores) -> Self {
        Self { stores, ..self }
    }

    /// The instructions it computes with.
    pub fn instructions(&self) -> Instructions {
        self.instructions
    }

    /// Writes the photo-surface of all meshes of a frame, shared between the caller and the current rayon pool.
    ///
    /// *Frames*: vertices in the world frame; apparent positions relative to the eye, in its rest frame, on the
    /// world's axes after a pure boost; metres. *Equation*: the light-cone form of x' = d + u (r + u·d/(1+γ)), D = γ + u·n
    /// (Weiskopf 2001, 5.1), with d the displacement from the eye to the vertex.
    pub fn transform(&self, eye: &Eye, surfaces: Vec<Surface<'_>>) -> Stats {
        self.transform_each(surfaces.into_iter().map(|surface| (*eye, surface)).collect())
    }

    /// The same for surfaces that are seen by an eye each: what moves uniformly has the observer in its own frame (W 5.1.2).
    pub fn transform_each(&self, surfaces: Vec<(Eye, Surface<'_>)>) -> Stats {
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
                not_finite.fetch_add(self.instructions.transform(chunk), Ordering::Relaxed);
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

/// Takes the next item from a queue. What a thread that panicked left behind is as good as before.
fn next<I: Iterator>(queue: &Mutex<I>) -> Option<I::Item> {
    queue.lock().unwrap_or_else(PoisonError::into_inner).next()
}
