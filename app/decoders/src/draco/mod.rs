//! Meshes as KHR_draco_mesh_compression packs them.

mod mesh;

pub use mesh::{Attribute, DracoMesh};

use crate::DecodeError;
use regular_file::Budget;

/// Decoded mesh, its memory taken from the budget.
///
/// # Errors
/// [`DecodeError`]: the bytes are no Draco mesh, or what they decode to exceeds the budget.
pub fn decode(_bytes: &[u8], _budget: &Budget) -> Result<DracoMesh, DecodeError> {
    Err(DecodeError::Unsupported("KHR_draco_mesh_compression".to_owned()))
}
