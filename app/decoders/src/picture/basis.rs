//! Codes of Basis Universal, by the crate `basisu`.
//!
//! The crate reads whole files. It is given one that is made here, of a single picture and with counts that were
//! checked, so that nothing in a file makes it count or reserve more than that.

use super::ktx2_outline::{Ktx2Outline, part, short, word};
use crate::DecodeError;
use basisu::{DecodeFlags, TargetFormat, Transcoder};

/// Colour model of blocks with codebooks.
pub(super) const ETC1S: u8 = 163;
/// Colour model of blocks of 16 bytes.
pub(super) const UASTC: u8 = 166;

/// First bytes of a KTX2.
const MARK: [u8; 12] = [0xab, b'K', b'T', b'X', b' ', b'2', b'0', 0xbb, b'\r', b'\n', 0x1a, b'\n'];
/// Number of bytes before the descriptor: the header, and the index of one level.
const HEAD: usize = 104;
/// Number of bytes of the header of the codebooks, and of the description of a picture.
const ENTRY: u64 = 20;

/// Pixels of the first picture, its colours and perhaps its alpha in slices of the level.
pub(super) fn etc1s(outline: &Ktx2Outline<'_>) -> Result<Vec<u8>, DecodeError> {
    let shared = outline.shared;
    // The header names the lengths of the codebooks for colours and patterns, and of the tables.
    let lengths = [word(shared, 4)?, word(shared, 8)?, word(shared, 12)?].map(u64::from);
    let description = ENTRY as usize;
    let [colour_at, colour_length, alpha_at, alpha_length] = [
        word(shared, description + 4)?,
        word(shared, description + 8)?,
        word(shared, description + 12)?,
        word(shared, description + 16)?,
    ];
    let pictures = outline.pictures.saturating_mul(outline.levels).saturating_add(1);
    let books = part(shared, ENTRY.saturating_mul(pictures), lengths.iter().sum())?;
    let colour = part(outline.level, colour_at.into(), colour_length.into())?;
    let alpha = part(outline.level, alpha_at.into(), alpha_length.into())?;
    if short(shared, 0)? == 0 || short(shared, 2)? == 0 || colour.is_empty() {
        return Err(DecodeError::Damaged("a codebook in them is empty".to_owned()));
    }

    // Write the codebooks of the one picture.
    let mut one = shared[..ENTRY as usize - 4].to_vec();
    let words = [0, 0, 0, colour_length, if alpha.is_empty() { 0 } else { colour_length }, alpha_length];
    words.iter().for_each(|word| one.extend(word.to_le_bytes()));
    one.extend(books);
    transcode(outline, ETC1S, 0, !alpha.is_empty(), &one, &[colour, alpha])
}

/// Pixels of blocks of 16 bytes.
pub(super) fn uastc(outline: &Ktx2Outline<'_>, blocks: &[u8]) -> Result<Vec<u8>, DecodeError> {
    transcode(outline, UASTC, outline.model[1], false, &[], &[blocks])
}

/// Writes a file of one picture and has it transcoded.
fn transcode(
    outline: &Ktx2Outline<'_>,
    model: u8,
    channel: u8,
    alpha: bool,
    shared: &[u8],
    level: &[&[u8]],
) -> Result<Vec<u8>, DecodeError> {
    let (width, height) = (outline.width, outline.height);
    // A descriptor of one sample, or of two if alpha is apart.
    let mut descriptor = [0_u8; 60];
    let descriptor_length = if alpha { 60 } else { 44 };
    descriptor[0] = descriptor_length;
    descriptor[8] = 2;
    descriptor[10] = descriptor_length - 4;
    // The curve of sRGB, which changes no byte; blocks of 4 × 4; 15 stands for alpha.
    [descriptor[12], descriptor[13], descriptor[14]] = [model, 1, 2];
    [descriptor[16], descriptor[17]] = [3, 3];
    descriptor[31] = channel;
    descriptor[47] = 15;

    let descriptor = &descriptor[..usize::from(descriptor_length)];
    let shared_at = HEAD + descriptor.len();
    let level_at = shared_at + shared.len();
    let level_length: usize = level.iter().map(|slice| slice.len()).sum();
    let packed = !shared.is_empty();
    let mut file = Vec::with_capacity(level_at + level_length);
    file.extend(MARK);
    // Format, size of a type, width, height, depth, layers, faces, levels, packing.
    [0, 1, width, height, 0, 0, 1, 1, u32::from(packed)].iter().for_each(|word| file.extend(word.to_le_bytes()));
    [HEAD as u32, descriptor.len() as u32, 0, 0].iter().for_each(|word| file.extend(word.to_le_bytes()));
    let unpacked = if packed { 0 } else { level_length };
    let longs = [if packed { shared_at } else { 0 }, shared.len(), level_at, level_length, unpacked];
    longs.iter().for_each(|long| file.extend((*long as u64).to_le_bytes()));
    file.extend(descriptor);
    file.extend(shared);
    level.iter().for_each(|slice| file.extend(*slice));

    let damaged = |error| match error {
        basisu::Error::Truncated => DecodeError::CutShort,
        _ => DecodeError::Damaged("their codebooks or blocks do not fit together".to_owned()),
    };
    let transcoder = Transcoder::new(&file).map_err(damaged)?;
    let mut rgba = vec![0; width as usize * height as usize * 4];
    transcoder.transcode_into(0, TargetFormat::Rgba32, DecodeFlags::NONE, &mut rgba).map_err(damaged)?;
    Ok(rgba)
}
