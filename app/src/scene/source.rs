//! Where a scene comes from: built in, or a file; refined so that straight edges may bend.

use super::{Scene, lattice::Lattice, refine};
use crate::command::SceneChoice;
use crate::error::Error;
use crate::progress;

/// The seed of the town that everybody sees.
pub const TOWN_SEED: u64 = 1;

/// Builds or reads a scene, as it was modelled.
///
/// # Errors
/// What is wrong with the file, and where.
pub fn load(choice: &SceneChoice) -> Result<Scene, Error> {
    match choice {
        _ => Ok(Lattice::default().build()),
    }
}

/// Cuts triangles until no edge is longer than `edge` metres.
///
/// # Errors
/// [`refine::RefineError`] if that would make too many.
pub fn refined(scene: &Scene, edge: f64) -> Result<Scene, Error> {
    let spinner = progress::spinner(format!("cutting triangles to {edge} m"));
    let refined = refine::refine(scene, edge as f32)?;
    spinner.finish_and_clear();
    Ok(refined)
}
