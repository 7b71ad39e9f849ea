//! Pixels of a picture of any format.

use super::decoded::DecodedPicture;
use super::kind::{PictureKind, kind};
use super::{jpeg, ktx2, png, webp};
use crate::DecodeError;
use crate::loan::Loan;
use regular_file::Budget;

/// Longest side of a picture, pixels: the limit of graphics processors.
const MAX_SIDE: u32 = 16384;

/// Width and height without decoding, pixels.
///
/// # Errors
/// [`DecodeError`]: the bytes are no picture, or one of an impossible size.
pub fn size(bytes: &[u8]) -> Result<(u32, u32), DecodeError> {
    let (width, height) = match kind(bytes).ok_or(DecodeError::UnknownPicture)? {
        PictureKind::Png => png::size(bytes)?,
        PictureKind::Jpeg => jpeg::size(bytes)?,
        PictureKind::WebP => webp::size(bytes)?,
        PictureKind::Ktx2 => ktx2::size(bytes)?,
    };
    if width.max(height) > MAX_SIDE || width.min(height) == 0 {
        return Err(DecodeError::Size { width, height, most: MAX_SIDE });
    }
    Ok((width, height))
}

/// Pixels of the largest mip level. EXIF orientation is ignored, as glTF says.
///
/// The pixels' memory stays taken from the budget; memory of the decoding is taken and given back.
///
/// # Errors
/// [`DecodeError`]: the bytes are no picture, or it exceeds the budget.
pub fn decode(bytes: &[u8], budget: &Budget) -> Result<DecodedPicture, DecodeError> {
    let (width, height) = size(bytes)?;
    let pixels = u64::from(width) * u64::from(height) * 4;
    let kind = kind(bytes).ok_or(DecodeError::UnknownPicture)?;
    let scratch = match kind {
        PictureKind::Png => png::scratch(width),
        PictureKind::Jpeg => jpeg::scratch(bytes)?,
        PictureKind::WebP => webp::scratch(bytes, width, height),
        PictureKind::Ktx2 => ktx2::scratch(bytes)?,
    };
    let loan = Loan::new(budget, pixels.saturating_add(scratch))?;
    let (rgba, notice) = match kind {
        PictureKind::Png => png::decode(bytes, width, height)?,
        PictureKind::Jpeg => jpeg::decode(bytes, width, height)?,
        PictureKind::WebP => webp::decode(bytes, width, height)?,
        PictureKind::Ktx2 => ktx2::decode(bytes)?,
    };
    loan.keep(pixels);
    Ok(DecodedPicture { width, height, rgba, notice })
}
