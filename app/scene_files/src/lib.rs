//! Scenes from files and into files: glTF 2.0 both ways, panoramas, and a report on a file's contents.

pub mod check;
pub mod export;
pub mod gltf;
pub mod panorama;
mod read;

pub use read::{LoadError, read};
