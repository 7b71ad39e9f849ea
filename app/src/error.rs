//! What can go wrong in the program as a whole. Every part has an error of its own; here they meet, so that `main`
//! reports once.

use crate::film::FilmError;
use crate::gpu::GpuError;
use crate::scene::gltf::GltfError;
use crate::scene::refine::RefineError;
use physics::photo_surface::PhotoSurfaceError;
use std::path::PathBuf;
use thiserror::Error;

/// One sentence: what was wrong, where, and what to do.
#[derive(Debug, Error)]
pub enum Error {
    /// Nothing to draw with.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// No film.
    #[error(transparent)]
    Film(#[from] FilmError),
    /// No scene.
    #[error(transparent)]
    Scene(#[from] GltfError),
    /// Too fine.
    #[error(transparent)]
    Refine(#[from] RefineError),
    /// An observer or a scene that is nowhere.
    #[error(transparent)]
    PhotoSurface(#[from] PhotoSurfaceError),
    /// A file that would not be written.
    #[error("{}: could not be written: {reason}; choose another place with --out", path.display())]
    Write {
        /// What was to be written.
        path: PathBuf,
        /// As the system says it.
        reason: String,
    },
    /// More pixels than the device can draw.
    #[error("--size {}x{} is too large for this graphics device, which draws up to {limit} pixels a side", size[0], size[1])]
    TooLarge {
        /// As asked.
        size: [u32; 2],
        /// As the device says.
        limit: u32,
    },
}
