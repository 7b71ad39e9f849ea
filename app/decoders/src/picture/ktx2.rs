//! KTX2: textures for graphics processors, in the codes of Basis Universal or plain. Of several pictures the first and
//! largest is taken.

use super::basis;
use super::ktx2_outline::{Ktx2Outline, Packing};
use crate::DecodeError;
use ruzstd::decoding::StreamingDecoder;
use std::borrow::Cow;
use std::io::{ErrorKind, Read};

/// Memory of Zstandard that a small picture may ask for, bytes.
const LEAST_WINDOW: u64 = 1 << 23;
/// Memory of the codebooks, bytes.
const CODEBOOKS: u64 = 1 << 23;

/// Code of the pixels.
enum Ktx2Code {
    /// Blocks of 4 × 4 pixels whose colours and patterns stand in codebooks.
    Etc1s,
    /// Blocks of 4 × 4 pixels, 16 bytes each.
    Uastc,
    /// Bytes of red, green, blue and perhaps alpha, or in the order of blue, green, red.
    Plain {
        /// Bytes of a pixel.
        channels: usize,
        /// True if blue comes first.
        blue_first: bool,
    },
}

/// Width and height that the header names, pixels.
pub(super) fn size(bytes: &[u8]) -> Result<(u32, u32), DecodeError> {
    Ktx2Outline::size(bytes)
}

/// Memory of decoding, bytes: what was packed, a copy of it, and codebooks.
pub(super) fn scratch(bytes: &[u8]) -> Result<u64, DecodeError> {
    let outline = Ktx2Outline::read(bytes)?;
    let unpacked = unpacked_bytes(&outline)? as u64;
    Ok(CODEBOOKS + window(unpacked) + 3 * unpacked + 2 * bytes.len() as u64)
}

/// Pixels, and a remark if there are more pictures.
pub(super) fn decode(bytes: &[u8]) -> Result<(Vec<u8>, Option<String>), DecodeError> {
    let outline = Ktx2Outline::read(bytes)?;
    let rgba = match code(&outline)? {
        Ktx2Code::Etc1s => basis::etc1s(&outline)?,
        Ktx2Code::Uastc => basis::uastc(&outline, &unpacked(&outline)?)?,
        Ktx2Code::Plain { channels, blue_first } => plain(&unpacked(&outline)?, channels, blue_first),
    };
    let others = outline.pictures - 1;
    Ok((rgba, (others > 0).then(|| format!("it holds {} pictures, and only the first is shown", others + 1))))
}

fn code(outline: &Ktx2Outline<'_>) -> Result<Ktx2Code, DecodeError> {
    let plain = |channels, blue_first| Ok(Ktx2Code::Plain { channels, blue_first });
    match (outline.format, outline.model[0], outline.packing) {
        (0, basis::ETC1S, Packing::BasisLz) => Ok(Ktx2Code::Etc1s),
        (0, basis::UASTC, Packing::Plain | Packing::Zstandard) => Ok(Ktx2Code::Uastc),
        // Vulkan's numbers, each linear and sRGB.
        (23 | 29, _, _) => plain(3, false),
        (30 | 36, _, _) => plain(3, true),
        (37 | 43, _, _) => plain(4, false),
        (44 | 50, _, _) => plain(4, true),
        (0, model, _) => Err(DecodeError::Unsupported(format!("KTX2 of the colour model {model}"))),
        (format, _, _) => Err(DecodeError::Unsupported(format!("KTX2 of Vulkan's format {format}"))),
    }
}

/// Number of bytes of the first picture when nothing is packed any more.
fn unpacked_bytes(outline: &Ktx2Outline<'_>) -> Result<usize, DecodeError> {
    let [width, height] = [outline.width, outline.height].map(|side| side as usize);
    let blocks = width.div_ceil(4).saturating_mul(height.div_ceil(4));
    Ok(match code(outline)? {
        Ktx2Code::Etc1s => 0,
        Ktx2Code::Uastc => blocks.saturating_mul(16),
        Ktx2Code::Plain { channels, .. } => width.saturating_mul(height).saturating_mul(channels),
    })
}

/// Memory that Zstandard may take for what it has written last, bytes.
fn window(unpacked: u64) -> u64 {
    unpacked.checked_next_power_of_two().unwrap_or(u64::MAX).max(LEAST_WINDOW)
}

/// First picture of the largest level.
fn unpacked<'a>(outline: &Ktx2Outline<'a>) -> Result<Cow<'a, [u8]>, DecodeError> {
    let length = unpacked_bytes(outline)?;
    if outline.packing != Packing::Zstandard {
        return Ok(Cow::Borrowed(outline.level.get(..length).ok_or(DecodeError::CutShort)?));
    }
    let mut unpacked = vec![0; length];
    let mut decoder = StreamingDecoder::new_with_max_window_size(outline.level, window(length as u64))
        .map_err(|error| DecodeError::Damaged(error.to_string()))?;
    decoder.read_exact(&mut unpacked).map_err(|error| match error.kind() {
        ErrorKind::UnexpectedEof => DecodeError::CutShort,
        _ => DecodeError::Damaged(error.to_string()),
    })?;
    Ok(Cow::Owned(unpacked))
}

fn plain(bytes: &[u8], channels: usize, blue_first: bool) -> Vec<u8> {
    let pixel = |pixel: &[u8]| {
        let alpha = pixel.get(3).copied().unwrap_or(255);
        if blue_first { [pixel[2], pixel[1], pixel[0], alpha] } else { [pixel[0], pixel[1], pixel[2], alpha] }
    };
    bytes.chunks_exact(channels).flat_map(pixel).collect()
}
