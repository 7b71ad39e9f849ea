//! Indices in any order: each the difference to one of the two runs that are under way.

use super::varint::{difference, put, take};
use crate::DecodeError;

/// Upper half of the first byte.
const MARK: u8 = 0xd0;
/// Number of bytes behind the indices that mean nothing.
const TAIL: usize = 4;

/// Fills the bytes with indices of 2 or 4 bytes each.
pub(super) fn decode(bytes: &[u8], stride: usize, decoded: &mut [u8]) -> Result<(), DecodeError> {
    let (&mark, rest) = bytes.split_first().ok_or(DecodeError::CutShort)?;
    if mark & 0xf0 != MARK || mark & 0x0f > 1 {
        return Err(DecodeError::Damaged("they do not begin as indices do".to_owned()));
    }
    let mut rest = &rest[..rest.len().checked_sub(TAIL).ok_or(DecodeError::CutShort)?];
    let mut last = [0_u32; 2];
    for place in decoded.chunks_exact_mut(stride) {
        let number = take(&mut rest)?;
        let last = &mut last[(number & 1) as usize];
        *last = last.wrapping_add(difference(number >> 1));
        put(place, *last)?;
    }
    if rest.is_empty() { Ok(()) } else { Err(DecodeError::Damaged("more indices follow than are named".to_owned())) }
}
