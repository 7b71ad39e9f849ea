//! Where a scene comes from: built in, or a file; refined so that straight edges may bend.

use super::gltf::{self, GltfError, Stage};
use super::{Scene, lattice::Lattice, town};
use crate::command::SceneChoice;
use crate::progress;

/// The seed of the town that everybody sees.
pub const TOWN_SEED: u64 = 1;

/// Builds or reads a scene, as it was modelled.
///
/// # Errors
/// What is wrong with the file, and where.
pub fn load(choice: &SceneChoice) -> Result<Scene, GltfError> {
    match choice {
        SceneChoice::Town => {
            let spinner = progress::spinner("building the old town");
            let scene = town::build(TOWN_SEED);
            spinner.finish_and_clear();
            Ok(scene)
        }
        SceneChoice::Lattice => Ok(Lattice::default().build()),
        SceneChoice::File(path) => {
            let bar = progress::bar(path.display().to_string(), 0);
            let scene = gltf::load(path, |progress| {
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
