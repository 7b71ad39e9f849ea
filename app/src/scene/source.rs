//! Where a scene comes from: built in, or a file; refined so that straight edges may bend.

use std::path::Path;

use super::gltf::{self, GltfError, Stage};
use super::panorama::{self, PanoramaError};
use super::{Scene, lattice::Lattice, spectra, town};
use crate::command::SceneChoice;
use crate::progress;

/// The seed of the town that everybody sees.
pub const TOWN_SEED: u64 = 1;

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

/// Builds or reads a scene, as it was modelled.
///
/// # Errors
/// What is wrong with the file, and where.
pub fn load(choice: &SceneChoice) -> Result<Scene, LoadError> {
    match choice {
        SceneChoice::Town => {
            let spinner = progress::spinner("building the old town");
            let scene = town::build(TOWN_SEED);
            spinner.finish_and_clear();
            Ok(scene)
        }
        SceneChoice::Spectra => Ok(spectra::build()),
        SceneChoice::Lattice => Ok(Lattice::default().build()),
        SceneChoice::File(path) => {
            let bar = progress::bar(path.display().to_string(), 0);
            let scene = read(path, |progress| {
                let stage = match progress.stage {
                    Stage::Pictures => "pictures",
                    Stage::Meshes => "meshes",
                };
                bar.set_message(format!("{}: {stage}", path.display()));
                bar.set_length(progress.total as u64);
                bar.set_position(progress.done as u64);
            })?;
            bar.finish_and_clear();
            for notice in &scene.notices {
                eprintln!("{}: {notice}", path.display());
            }
            Ok(scene)
        }
    }
}

/// Reads a scene from a file: a picture all around, by the ending of its name, or glTF.
///
/// # Errors
/// What is wrong with the file, and where.
pub fn read(path: &Path, progress: impl Fn(gltf::Progress) + Sync) -> Result<Scene, LoadError> {
    if panorama::is_picture(path) { Ok(panorama::load(path)?) } else { Ok(gltf::load(path, progress)?) }
}
