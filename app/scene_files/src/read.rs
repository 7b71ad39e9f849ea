//! Scene from a file of any kind.

use crate::gltf::{self, GltfError, ReadRules};
use panoramas::PanoramaError;
use scene::Scene;
use std::path::Path;

/// Reason why a file gives no scene.
#[derive(Debug, thiserror::Error)]
pub enum SceneReadError {
    /// A file that is not a valid glTF scene.
    #[error(transparent)]
    Gltf(#[from] GltfError),
    /// A picture that is not a panorama.
    #[error(transparent)]
    Panorama(#[from] PanoramaError),
}

/// Reads a scene from a file: a picture all around, by the ending of its name, or glTF. What it holds in memory is
/// taken from the budget.
///
/// # Errors
/// [`SceneReadError`], with the fault and its place.
pub fn read(
    path: &Path,
    rules: ReadRules<'_>,
    progress: impl Fn(gltf::Progress) + Sync,
) -> Result<Scene, SceneReadError> {
    if panoramas::is_picture(path) {
        Ok(panoramas::load(path, rules.budget)?)
    } else {
        Ok(gltf::load(path, rules, progress)?)
    }
}
