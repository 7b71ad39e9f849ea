//! WebP, with and without loss. A moving one gives its first picture.

use super::decoded::spread_rgb;
use super::webp_outline::largest_frame;
use crate::DecodeError;
use image_webp::{DecodingError, WebPDecoder};
use std::io::Cursor;

/// Width and height of the canvas, pixels.
pub(super) fn size(bytes: &[u8]) -> Result<(u32, u32), DecodeError> {
    Ok(open(bytes)?.dimensions())
}

/// Largest part of coded pixels that a WebP can announce, bytes. Its memory is taken before the bytes are read.
const LARGEST_PART: u64 = 1 << 24;

/// Memory of decoding, bytes: planes of brightness and colour or a second set of pixels, and the coded parts.
pub(super) fn scratch(bytes: &[u8], width: u32, height: u32) -> u64 {
    let pixels = (u64::from(width) + 64) * (u64::from(height) + 64);
    LARGEST_PART + 2 * bytes.len() as u64 + 8 * pixels
}

/// Pixels, and a remark if more pictures follow the first.
pub(super) fn decode(bytes: &[u8], width: u32, height: u32) -> Result<(Vec<u8>, Option<String>), DecodeError> {
    let pixels = width as usize * height as usize;
    if largest_frame(bytes)? > pixels as u64 {
        return Err(DecodeError::Damaged("it holds a picture that is larger than it says".to_owned()));
    }
    let mut decoder = open(bytes)?;
    let mut rgba = vec![0; pixels * 4];
    if decoder.has_alpha() {
        decoder.read_image(&mut rgba).map_err(|error| fault(bytes, &error))?;
    } else {
        decoder.read_image(&mut rgba[pixels..]).map_err(|error| fault(bytes, &error))?;
        spread_rgb(&mut rgba);
    }
    let notice = decoder.is_animated().then(|| "it moves, and only its first picture is shown".to_owned());
    Ok((rgba, notice))
}

fn open(bytes: &[u8]) -> Result<WebPDecoder<Cursor<&[u8]>>, DecodeError> {
    WebPDecoder::new(Cursor::new(bytes)).map_err(|error| fault(bytes, &error))
}

fn fault(bytes: &[u8], error: &DecodingError) -> DecodeError {
    // The header names the length of all that follows its first 8 bytes.
    let announced = bytes
        .get(4..8)
        .map_or(u64::MAX, |length| 8 + u64::from(u32::from_le_bytes([length[0], length[1], length[2], length[3]])));
    let cut_short = announced > bytes.len() as u64;
    if cut_short { DecodeError::CutShort } else { DecodeError::Damaged(error.to_string()) }
}
