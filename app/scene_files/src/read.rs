//! Reading of a scene from any supported kind of file.

use crate::gltf::{self, GltfError};
use crate::panorama::{self, PanoramaError};
use scene::Scene;
use std::path::Path;

/// Reason why a file gives no scene.
#[derive(Debug, thiserror::Error)]
pub enum LoadError {
    /// A fault of a glTF file, or of a file that was taken for one.
    #[error(transparent)]
    Gltf(#[from] GltfError),
    /// A fault of a panorama.
    #[error(transparent)]
    Panorama(#[from] PanoramaError),
}

/// Reads a scene from a file: a panorama if its name ends like a picture's, glTF otherwise.
///
/// # Errors
/// The fault of the file, with its place.
pub fn read(path: &Path, progress: impl Fn(gltf::Progress) + Sync) -> Result<Scene, LoadError> {
    if panorama::is_picture(path) { Ok(panorama::load(path)?) } else { Ok(gltf::load(path, progress)?) }
}
