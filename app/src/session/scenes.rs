//! Where a scene comes from: built in, or a file; refined so that straight edges may bend.

use std::path::{Path, PathBuf};

use super::gltf::{self, GltfError, Stage};
use super::motion::TooFast;
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
    /// An animation faster than light.
    #[error("{}: {fault}", path.display())]
    TooFast {
        /// The scene.
        path: PathBuf,
        /// Which.
        fault: TooFast,
    },
}

/// Builds or reads a scene, as it was modelled, for a world in which light is so fast (m/s).
///
/// # Errors
/// What is wrong with the file, and where; or what of it would be faster than light.
pub fn load(choice: &SceneChoice, speed_of_light_m_s: f64) -> Result<Scene, LoadError> {
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
            let mut scene = read(path, |progress| {
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
            let checked = scene.set_speed_of_light(speed_of_light_m_s);
            checked.map_err(|fault| LoadError::TooFast { path: path.clone(), fault })?;
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
