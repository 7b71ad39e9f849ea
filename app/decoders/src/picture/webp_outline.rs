//! Outline of a WebP: its chunks, and the sizes that they name.
//!
//! The picture, and each frame of a moving one, names its own size once more. One that is larger than the canvas would
//! take memory that nobody counted.

use crate::DecodeError;

/// Largest number of pixels that a frame of a WebP names.
///
/// # Errors
/// [`DecodeError::CutShort`] if a chunk ends within its header.
pub(super) fn largest_frame(bytes: &[u8]) -> Result<u64, DecodeError> {
    let mut largest = 0;
    walk(bytes.get(12..).unwrap_or_default(), &mut largest, true);
    if largest == 0 { Err(DecodeError::CutShort) } else { Ok(largest) }
}

fn walk(mut bytes: &[u8], largest: &mut u64, outer: bool) {
    while let Some((head, rest)) = bytes.split_first_chunk::<8>() {
        let [n0, n1, n2, n3, l0, l1, l2, l3] = *head;
        let length = u32::from_le_bytes([l0, l1, l2, l3]) as usize;
        let data = &rest[..length.min(rest.len())];
        match &[n0, n1, n2, n3] {
            // A tag of 3 bytes, a start code of 3, then width and height of 14 bits.
            b"VP8 " => {
                if let Some(&[w0, w1, h0, h1]) = data.get(6..10) {
                    let [width, height] = [[w0, w1], [h0, h1]].map(|side| u64::from(u16::from_le_bytes(side) & 0x3fff));
                    *largest = (*largest).max(width * height);
                }
            }
            // A signature of 1 byte, then width and height less one of 14 bits each.
            b"VP8L" => {
                if let Some(&[b0, b1, b2, b3]) = data.get(1..5) {
                    let bits = u64::from(u32::from_le_bytes([b0, b1, b2, b3]));
                    *largest = (*largest).max(((bits & 0x3fff) + 1) * ((bits >> 14 & 0x3fff) + 1));
                }
            }
            // Place, width, height and duration of 3 bytes each, flags, then chunks.
            b"ANMF" if outer => {
                if let Some((frame, chunks)) = data.split_first_chunk::<16>() {
                    let side = |place: usize| {
                        u64::from(u32::from_le_bytes([frame[place], frame[place + 1], frame[place + 2], 0])) + 1
                    };
                    *largest = (*largest).max(side(6) * side(9));
                    walk(chunks, largest, false);
                }
            }
            _ => {}
        }
        // A chunk of odd length is followed by a byte that means nothing.
        bytes = rest.get(length.saturating_add(length & 1)..).unwrap_or_default();
    }
}
