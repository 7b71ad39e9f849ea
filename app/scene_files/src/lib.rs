//! Scenes from files and into files: glTF 2.0 both ways, panoramas, and a report on the contents of a scene.

pub mod check;
pub mod export;
pub mod gltf;
mod read;

pub use read::{SceneReadError, read};
