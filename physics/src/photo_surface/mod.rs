//! The photo-surface of objects at rest in the world: the apparent positions of their vertices for a moving eye.
//!
//! Light that reaches the eye together left the vertices at different times, from the eye's past light cone. In the
//! eye's own rest frame those emission events lie at the *apparent positions*; the surface they make is the
//! photo-surface (W 5.1). Drawing it like any other mesh, with the eye at the origin, gives the picture that the
//! moving observer sees, aberration and light-travel time included.
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
//! - Directions are within 7e-7 rad of exact for γ ≤ 1e9 at distances of 1e-3 to 1e6 m, and within 4e-4 rad for γ ≤
//!   1e12 (`tests/physics/photo_surface_accuracy.rs`).
//! - The output of an eye at rest is p − o, rounded, and D = 1 exactly.
//! - The bits do not depend on the number of threads, on how a mesh's output is aligned, or on whether AVX2 or AVX-512
//!   computed it; [`Instructions::Portable`] may differ in the last bits on processors without fused operations.
//! - Output memory is only written, never read, so that it may be a mapped GPU buffer.
//! - A vertex without a finite result is written as zeros with D = 0 and counted in [`Stats`]: its coordinates or the
//!   eye's position are not finite, or it is or appears further away than 5e18 m.
//! - A vertex at a moving eye has no direction: it is written as zeros with D = 0. Nearer than 1e-18 m D is not
//!   reliable; at every other distance D > 0.
//!
//! # Example
//! ```
//! use glam::DVec3;
//! use physics::photo_surface::{Kernel, PhotoSurfaceMesh, Vertices};
//! use physics::{Celerity, Event, Observer};
//!
//! // A point one metre ahead, for an eye at 0.6 c: u = 0.75, γ = 1.25, D = 2.
//! let vertices = Vertices::from_world(DVec3::ZERO, [DVec3::NEG_Z])?;
//! let celerity = Celerity::new(DVec3::NEG_Z * 0.75)?;
//! let observer = Observer { event: Event::default(), celerity };
//! let (mut x, mut y, mut z, mut doppler) = ([0.0], [0.0], [0.0], [0.0]);
//! let surface = PhotoSurfaceMesh::new(&vertices, [&mut x, &mut y, &mut z])?.with_doppler(&mut doppler)?;
//! let stats = Kernel::default().transform(&observer, vec![surface]);
//! assert_eq!((x[0], y[0], z[0], doppler[0]), (0.0, 0.0, -2.0, 2.0));
//! assert_eq!(stats.not_finite(), 0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod accuracy;
mod chunk;
mod error;
mod eye;
mod formula;
mod instructions;
mod kernel;
mod lanes;
mod line;
mod mesh;
#[cfg(target_arch = "x86_64")]
mod paired;
mod plan;
mod simd;
mod sphere;
mod stats;
mod vertices;

pub use error::PhotoSurfaceError;
pub use eye::PhotoSurfaceEye;
pub use instructions::Instructions;
pub use kernel::{Kernel, Stores};
pub use line::CHUNK;
pub use mesh::PhotoSurfaceMesh;
pub use stats::Stats;
pub use vertices::Vertices;
