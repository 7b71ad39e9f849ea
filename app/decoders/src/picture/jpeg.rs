//! JPEG, baseline and progressive, grey, colour and CMYK. Rows before a fault are kept.

use super::decoded::{Flaw, MISSING, spread_rgb};
use super::jpeg_outline::JpegOutline;
use crate::DecodeError;
use std::borrow::Cow;
use zune_core::bytestream::ZCursor;
use zune_core::colorspace::ColorSpace;
use zune_core::options::DecoderOptions;
use zune_jpeg::JpegDecoder;

/// Marker at the end of a file.
const END: [u8; 2] = [0xff, 0xd9];

/// Width and height that the frame header names, pixels.
pub(super) fn size(bytes: &[u8]) -> Result<(u32, u32), DecodeError> {
    let outline = JpegOutline::read(bytes)?;
    Ok((outline.width, outline.height))
}

/// Most blocks of 8 × 8 pixels that a byte may announce: each takes a bit at least, and a 64th of them must be there.
const BLOCKS_PER_BYTE: u64 = 8 * 64;

/// Memory of decoding, bytes: the coefficients of 16 bits, a few rows of blocks, a second copy of a file that is cut.
pub(super) fn scratch(bytes: &[u8]) -> Result<u64, DecodeError> {
    let outline = JpegOutline::read(bytes)?;
    let [across, down] =
        [0, 1].map(|axis| outline.sampling.iter().map(|sampling| sampling[axis]).max().unwrap_or(1).max(1));
    let [columns, rows] = [outline.width.div_ceil(8 * across), outline.height.div_ceil(8 * down)].map(u64::from);
    let least = u64::from(outline.width.div_ceil(8)) * u64::from(outline.height.div_ceil(8)) / BLOCKS_PER_BYTE;
    if least > bytes.len() as u64 {
        return Err(DecodeError::CutShort);
    }
    let blocks: u64 = outline.sampling.iter().map(|[across, down]| u64::from(across * down)).sum();
    let row = columns * blocks * 64 * 2;
    Ok((1 << 20) + bytes.len() as u64 + row * (rows + 16))
}

/// Pixels, and a remark if some are missing.
pub(super) fn decode(bytes: &[u8], width: u32, height: u32) -> Result<(Vec<u8>, Option<String>), DecodeError> {
    let outline = JpegOutline::read(bytes)?;
    let (width, height) = (width as usize, height as usize);
    let options = DecoderOptions::default()
        .jpeg_set_out_colorspace(ColorSpace::RGB)
        .set_max_width(width)
        .set_max_height(height)
        .set_strict_mode(false)
        .jpeg_set_max_scans(64);
    // A file that is cut between two versions or within a header would give nothing, so it is made to end before.
    let between = !outline.complete && (outline.progressive || outline.sound < bytes.len());
    let whole = match between {
        true => Cow::Owned([&bytes[..outline.sound], &END].concat()),
        false => Cow::Borrowed(bytes),
    };
    let mut decoder = JpegDecoder::new_with_options(ZCursor::new(&*whole), options);
    let cut_short =
        |reason: String| if outline.complete { DecodeError::Damaged(reason) } else { DecodeError::CutShort };
    decoder.decode_headers().map_err(|error| cut_short(error.to_string()))?;
    let mut rgba = vec![MISSING; width * height * 4];
    let rgb = &mut rgba[width * height..];
    if decoder.output_buffer_size() != Some(rgb.len()) {
        return Err(DecodeError::Damaged("its headers name different sizes".to_owned()));
    }
    let failure = decoder.decode_into(rgb).err();

    // The decoder leaves rows grey that it did not come to.
    let mut notice = None;
    if failure.is_some() || !outline.complete {
        let missing = rgb.rchunks_exact(width * 3).take_while(|row| row.iter().all(|&value| value == MISSING)).count();
        let flaw = if outline.complete { Flaw::Damaged } else { Flaw::CutShort };
        notice = match missing {
            _ if missing == height => {
                let reason = failure.map_or_else(|| "no pixel comes out of it".to_owned(), |error| error.to_string());
                return Err(cut_short(reason));
            }
            0 if outline.progressive => Some(flaw.coarse()),
            // A file without its end marker only: every pixel is there, as far as can be seen.
            0 => Some(flaw.missing_rows(1, height)),
            _ => Some(flaw.missing_rows(missing, height)),
        };
    }
    spread_rgb(&mut rgba);
    Ok((rgba, notice))
}
