//! End of a JPEG: decoders fill in what is missing, so the bytes tell whether a file was cut.

/// True if a JPEG file has an end-of-image marker after its last scan.
pub(super) fn is_whole(bytes: &[u8]) -> bool {
    let marker = |code: u8| bytes.windows(2).rposition(|pair| pair == [0xff, code]);
    match (marker(0xd9), marker(0xda)) {
        (Some(end), Some(scan)) => end > scan,
        (end, _) => end.is_some(),
    }
}

/// True if a JPEG is progressive or of another kind whose coefficients are held all at once.
pub(super) fn holds_coefficients(bytes: &[u8]) -> bool {
    // Follow the segments up to the frame.
    let mut place = 2;
    while let Some(&[0xff, code, high, low]) = bytes.get(place..).and_then(|rest| rest.first_chunk::<4>()) {
        match code {
            0xff => place += 1,
            0xc0 | 0xc1 => return false,
            0xc2..=0xcf if ![0xc4, 0xc8, 0xcc].contains(&code) => return true,
            0xda => return false,
            _ => place += 2 + usize::from(u16::from_be_bytes([high, low])),
        }
    }
    false
}

/// Number of rows at the end of a decoded picture that all are the same, of one colour: they were filled in.
pub(super) fn filled_rows(pixels: &[u8], bytes_per_row: usize, bytes_per_pixel: usize) -> usize {
    let Some(last) = pixels.len().checked_sub(bytes_per_pixel).map(|from| &pixels[from..]) else {
        return 0;
    };
    let filled = |row: &&[u8]| row.chunks_exact(bytes_per_pixel).all(|pixel| pixel == last);
    pixels.chunks_exact(bytes_per_row).rev().take_while(filled).count()
}
