//! Vertices and indices as EXT_meshopt_compression packs them.

mod kind;

pub use kind::{Codec as Mode, Filter};

use crate::DecodeError;
use regular_file::Budget;

/// Decoded bytes: `count * stride` of them, taken from the budget.
///
/// # Errors
/// [`DecodeError`]: the bytes are no such data, or what they decode to exceeds the budget.
pub fn decode(
    _bytes: &[u8],
    _count: usize,
    _stride: usize,
    _mode: Mode,
    _filter: Filter,
    _budget: &Budget,
) -> Result<Vec<u8>, DecodeError> {
    Err(DecodeError::Unsupported("EXT_meshopt_compression".to_owned()))
}
