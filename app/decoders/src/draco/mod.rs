//! Meshes as KHR_draco_mesh_compression packs them.
//!
//! The bit stream is decoded by the crate `draco-core`. Here its header is read first, so that the memory is known
//! before it is asked for, and what comes out is turned into numbers.

mod decode;
mod header;
mod mesh;
#[cfg(test)]
mod tests;

pub use decode::decode;
pub use mesh::{Attribute, DracoMesh};
