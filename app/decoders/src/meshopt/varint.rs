//! Numbers of variable length, and differences with their sign in the lowest bit.

use crate::DecodeError;

/// Takes a number of 7 bits a byte, the lowest first, from the front of the bytes.
pub(super) fn take(bytes: &mut &[u8]) -> Result<u32, DecodeError> {
    let mut number = 0;
    for shift in [0, 7, 14, 21, 28] {
        let (&byte, rest) = bytes.split_first().ok_or(DecodeError::CutShort)?;
        *bytes = rest;
        number |= u32::from(byte & 0x7f) << shift;
        if byte & 0x80 == 0 {
            return Ok(number);
        }
    }
    Err(DecodeError::Damaged("an index has no end".to_owned()))
}

/// Difference of which the lowest bit is the sign: 0, −1, 1, −2, 2 …, modulo 2³².
pub(super) fn difference(number: u32) -> u32 {
    (number >> 1) ^ (number & 1).wrapping_neg()
}

/// Writes an index of 2 or 4 bytes.
pub(super) fn put(place: &mut [u8], index: u32) -> Result<(), DecodeError> {
    let bytes = index.to_le_bytes();
    let (kept, lost) = bytes.split_at(place.len());
    if lost.iter().any(|&byte| byte != 0) {
        return Err(DecodeError::Damaged(format!("the index {index} has no room in {} bytes", place.len())));
    }
    place.copy_from_slice(kept);
    Ok(())
}
