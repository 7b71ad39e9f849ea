//! Checks of what a buffer view claims, before it is decoded.

use super::filter;
use super::indices;
use super::kind::{Codec, Filter};
use super::triangles;
use super::vertices;
use crate::DecodeError;
use crate::loan::Loan;
use regular_file::Budget;

/// Decoded bytes: `count * stride` of them, which stay taken from the budget.
///
/// # Errors
/// [`DecodeError`]: the bytes are no such data, or what they decode to exceeds the budget.
pub fn decode(
    bytes: &[u8],
    count: usize,
    stride: usize,
    mode: Codec,
    filter: Filter,
    budget: &Budget,
) -> Result<Vec<u8>, DecodeError> {
    let (strides, fits) = match mode {
        Codec::Attributes => ("a multiple of 4 up to 256", stride.is_multiple_of(4) && (4..=256).contains(&stride)),
        Codec::Triangles | Codec::Indices => ("2 or 4", stride == 2 || stride == 4),
    };
    if !fits {
        return Err(DecodeError::Damaged(format!("they have {stride} bytes each, where {strides} is possible")));
    }
    if mode == Codec::Triangles && !count.is_multiple_of(3) {
        return Err(DecodeError::Damaged(format!("{count} indices make no triangles")));
    }
    filter::check(filter, mode, stride)?;
    // The least bytes that each of them takes: a block of 256 vertices a byte for every 4 of a vertex, an index one.
    let least = match mode {
        Codec::Attributes => count / 256 * (stride / 4),
        Codec::Triangles => count / 3,
        Codec::Indices => count,
    };
    if least > bytes.len() {
        return Err(DecodeError::CutShort);
    }
    let size = count as u64 * stride as u64;
    let loan = Loan::new(budget, size)?;
    let mut decoded = vec![0; count * stride];
    match mode {
        Codec::Attributes => vertices::decode(bytes, stride, &mut decoded)?,
        Codec::Triangles => triangles::decode(bytes, stride, &mut decoded)?,
        Codec::Indices => indices::decode(bytes, stride, &mut decoded)?,
    }
    filter::apply(filter, stride, &mut decoded);
    loan.keep(size);
    Ok(decoded)
}
