//! Any file that gives a scene.

use crate::gltf::{self, GltfError};
use crate::panorama::{self, PanoramaError};
use scene::Scene;
use std::path::Path;

/// Why a file gives no scene.
#[derive(Debug, thiserror::Error)]
pub enum LoadError {
    /// A glTF file, or what was taken for one.
    #[error(transparent)]
    Gltf(#[from] GltfError),
    /// A picture.
    #[error(transparent)]
    Panorama(#[from] PanoramaError),
}

/// Reads a scene from a file: a picture all around, by the ending of its name, or glTF.
///
/// # Errors
/// What is wrong with the file, and where.
pub fn read(path: &Path, progress: impl Fn(gltf::Progress) + Sync) -> Result<Scene, LoadError> {
    if panorama::is_picture(path) { Ok(panorama::load(path)?) } else { Ok(gltf::load(path, progress)?) }
}
