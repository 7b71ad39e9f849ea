//! PNG of every colour type and depth. Rows before a fault are kept.

use super::decoded::{Flaw, MISSING};
use crate::DecodeError;
use ::png::{BitDepth, ColorType, Decoder, DecodingError, InterlaceInfo, Limits, Transformations};
use std::io::{Cursor, ErrorKind};

/// Width and height that the header names, pixels.
pub(super) fn size(bytes: &[u8]) -> Result<(u32, u32), DecodeError> {
    let header = bytes.get(8..24).ok_or(DecodeError::CutShort)?;
    if header[4..8] != *b"IHDR" {
        return Err(DecodeError::Damaged("it does not begin with a header".to_owned()));
    }
    let side =
        |place: usize| u32::from_be_bytes([header[place], header[place + 1], header[place + 2], header[place + 3]]);
    Ok((side(8), side(12)))
}

/// Memory of decoding, bytes: a few rows of 16 bits a channel, the window of the inflater, chunks before the pixels.
pub(super) fn scratch(width: u32) -> u64 {
    (1 << 20) + 64 * u64::from(width)
}

/// Pixels, and a remark if some are missing.
pub(super) fn decode(bytes: &[u8], width: u32, height: u32) -> Result<(Vec<u8>, Option<String>), DecodeError> {
    let limits = Limits { bytes: scratch(width) as usize };
    let mut decoder = Decoder::new_with_limits(Cursor::new(bytes), limits);
    decoder.set_transformations(Transformations::EXPAND);
    decoder.set_ignore_text_chunk(true);
    decoder.set_ignore_iccp_chunk(true);
    let mut reader = decoder.read_info().map_err(|error| fault(&error))?;
    let (colour, depth) = reader.output_color_type();
    let interlaced = reader.info().interlaced;
    let (width, height) = (width as usize, height as usize);

    let mut rgba = vec![MISSING; width * height * 4];
    rgba.chunks_exact_mut(4).for_each(|pixel| pixel[3] = 255);
    let mut interlaced_row = vec![0; if interlaced { width * 4 } else { 0 }];
    let mut rows = 0;
    let failure = loop {
        match reader.next_interlaced_row() {
            Ok(Some(row)) => match row.interlace() {
                InterlaceInfo::Null(_) if rows < height => {
                    convert(row.data(), colour, depth, &mut rgba[rows * width * 4..][..width * 4]);
                }
                InterlaceInfo::Null(_) => {}
                InterlaceInfo::Adam7(place) => {
                    let length = convert(row.data(), colour, depth, &mut interlaced_row);
                    ::png::splat_interlaced_row(&mut rgba, width * 4, &interlaced_row[..length], place, 32);
                }
            },
            Ok(None) => break None,
            Err(error) => break Some(error),
        }
        rows += 1;
    };
    let Some(failure) = failure else { return Ok((rgba, None)) };
    // The rows that came are kept.
    let flaw = if cut_short(&failure) { Flaw::CutShort } else { Flaw::Damaged };
    match rows {
        0 => Err(fault(&failure)),
        _ if interlaced => Ok((rgba, Some(flaw.coarse()))),
        _ => Ok((rgba, (rows < height).then(|| flaw.missing_rows(height - rows, height)))),
    }
}

/// Converts a row to 8-bit RGBA; returns the number of bytes written.
fn convert(row: &[u8], colour: ColorType, depth: BitDepth, rgba: &mut [u8]) -> usize {
    match (depth, colour) {
        (BitDepth::Sixteen, ColorType::Grayscale) => spread::<2>(row, rgba, |v| grey(high(v, 0), 255)),
        (BitDepth::Sixteen, ColorType::GrayscaleAlpha) => spread::<4>(row, rgba, |v| grey(high(v, 0), high(v, 2))),
        (BitDepth::Sixteen, ColorType::Rgb) => spread::<6>(row, rgba, |v| [high(v, 0), high(v, 2), high(v, 4), 255]),
        (BitDepth::Sixteen, _) => spread::<8>(row, rgba, |v| [high(v, 0), high(v, 2), high(v, 4), high(v, 6)]),
        (_, ColorType::Grayscale) => spread::<1>(row, rgba, |v| grey(v[0], 255)),
        (_, ColorType::GrayscaleAlpha) => spread::<2>(row, rgba, |v| grey(v[0], v[1])),
        (_, ColorType::Rgb) => spread::<3>(row, rgba, |v| [v[0], v[1], v[2], 255]),
        (_, _) => spread::<4>(row, rgba, |v| *v),
    }
}

fn spread<const N: usize>(row: &[u8], rgba: &mut [u8], pixel: impl Fn(&[u8; N]) -> [u8; 4]) -> usize {
    let (from, _) = row.as_chunks::<N>();
    let (to, _) = rgba.as_chunks_mut::<4>();
    from.iter().zip(to).for_each(|(from, to)| *to = pixel(from));
    4 * from.len()
}

fn grey(value: u8, alpha: u8) -> [u8; 4] {
    [value, value, value, alpha]
}

/// Nearest 8-bit value of the 16-bit value at a place.
fn high(values: &[u8], place: usize) -> u8 {
    let value = u32::from(u16::from_be_bytes([values[place], values[place + 1]]));
    ((value * 255 + 32767) / 65535) as u8
}

fn cut_short(error: &DecodingError) -> bool {
    matches!(error, DecodingError::IoError(error) if error.kind() == ErrorKind::UnexpectedEof)
}

fn fault(error: &DecodingError) -> DecodeError {
    if cut_short(error) { DecodeError::CutShort } else { DecodeError::Damaged(error.to_string()) }
}
