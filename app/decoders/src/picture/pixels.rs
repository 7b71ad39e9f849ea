//! Pixels of a picture of any format.

use super::kind::{PictureKind, kind};
use crate::DecodeError;
use image::{ImageFormat, ImageReader};
use regular_file::Budget;
use std::io::Cursor;

/// Pixels of a picture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DecodedPicture {
    /// Width, pixels.
    pub width: u32,
    /// Height, pixels.
    pub height: u32,
    /// Red, green, blue, alpha of 8 bits, sRGB as stored, rows from the top.
    pub rgba: Vec<u8>,
    /// Remark on what could not be decoded, worded to follow the name of the picture.
    pub notice: Option<String>,
}

/// Width and height without decoding, pixels.
///
/// # Errors
/// [`DecodeError`]: the bytes are no picture, or one of an impossible size.
pub fn size(bytes: &[u8]) -> Result<(u32, u32), DecodeError> {
    let format = format(bytes)?;
    let size = ImageReader::with_format(Cursor::new(bytes), format).into_dimensions();
    size.map_err(|error| DecodeError::Damaged(error.to_string()))
}

/// Pixels of the largest mip level, their memory taken from the budget. EXIF orientation is ignored, as glTF says.
///
/// # Errors
/// [`DecodeError`]: the bytes are no picture, or it exceeds the budget.
pub fn decode(bytes: &[u8], budget: &Budget) -> Result<DecodedPicture, DecodeError> {
    let (width, height) = size(bytes)?;
    budget.take(u64::from(width) * u64::from(height) * 4)?;
    let picture = ImageReader::with_format(Cursor::new(bytes), format(bytes)?).decode();
    let rgba = picture.map_err(|error| DecodeError::Damaged(error.to_string()))?.into_rgba8().into_raw();
    Ok(DecodedPicture { width, height, rgba, notice: None })
}

fn format(bytes: &[u8]) -> Result<ImageFormat, DecodeError> {
    match kind(bytes) {
        Some(PictureKind::Png) => Ok(ImageFormat::Png),
        Some(PictureKind::Jpeg) => Ok(ImageFormat::Jpeg),
        Some(_) => Err(DecodeError::Unsupported("WebP or KTX2".to_owned())),
        None => Err(DecodeError::UnknownPicture),
    }
}
