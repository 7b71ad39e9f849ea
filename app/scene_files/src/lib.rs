//! Scenes from files and into files: glTF 2.0 both ways, pictures of everything around, and a report on what a file holds.

pub mod check;
pub mod export;
pub mod gltf;
pub mod panorama;
mod read;

pub use read::{LoadError, read};
