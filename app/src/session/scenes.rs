//! Loading of the requested scene: built in, or from a file.

use crate::command::SceneChoice;
use crate::output::progress;
use built_in::lattice::Lattice;
use built_in::{spectra, town};
use regular_file::Budget;
use scene::{Scene, TooFast};
use scene_files::gltf::LoadStage;
use scene_files::read;
use std::path::PathBuf;
use thiserror::Error;

/// Reason why there is no scene.
#[derive(Debug, Error)]
pub enum SceneError {
    /// A file that gives no scene.
    #[error(transparent)]
    File(#[from] scene_files::SceneReadError),
    /// An animation faster than light.
    #[error("{}: {fault}", path.display())]
    TooFast {
        /// File of the scene.
        path: PathBuf,
        /// Animation, and its speed.
        fault: TooFast,
    },
}

/// Builds or reads a scene as it was modelled. The speed of light, m/s, is needed to refuse animations that are
/// faster.
///
/// # Errors
/// A fault of the file with its place, or an animation faster than light.
pub fn load(choice: &SceneChoice, speed_of_light_m_s: f64) -> Result<Scene, SceneError> {
    match choice {
        SceneChoice::Town => {
            let spinner = progress::spinner("building the old town");
            let scene = town::build(town::TOWN_SEED);
            spinner.finish_and_clear();
            Ok(scene)
        }
        SceneChoice::Spectra => Ok(spectra::build()),
        SceneChoice::Lattice => Ok(Lattice::default().build()),
        SceneChoice::File(path) => {
            let bar = progress::bar(path.display().to_string(), 0);
            let mut scene = read(path, &Budget::default(), |progress| {
                let stage = match progress.stage {
                    LoadStage::Pictures => "pictures",
                    LoadStage::Meshes => "meshes",
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
            checked.map_err(|fault| SceneError::TooFast { path: path.clone(), fault })?;
            Ok(scene)
        }
    }
}
