//! OpenEXR files of light: 32-bit floats, linear sRGB, cd/m².
//!
//! The file states this itself: its chromaticities are those of ITU-R BT.709, which sRGB shares, and its white
//! luminance is 1, so red = green = blue = 1 means 1 cd/m². Compression is lossless: values are read back to the bit.

use super::files::{WriteError, whole};
use exr::meta::attribute::Chromaticities;
use exr::prelude::{Encoding, Image, SpecificChannels, Vec2, WritableImage};
use image::Rgb32FImage;
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::Path;

/// Chromaticities x and y of red, green, blue and the D65 white of ITU-R BT.709.
const CHROMATICITIES: Chromaticities =
    Chromaticities { red: Vec2(0.64, 0.33), green: Vec2(0.3, 0.6), blue: Vec2(0.15, 0.06), white: Vec2(0.3127, 0.329) };

/// Writes `light` to the file `path`.
///
/// # Errors
/// [`WriteError`] with the path and the reason; no partial file is left then.
pub fn save(light: &Rgb32FImage, path: &Path) -> Result<(), WriteError> {
    let size = (light.width() as usize, light.height() as usize);
    let pixel = |place: Vec2<usize>| {
        let [red, green, blue] = light.get_pixel(place.x() as u32, place.y() as u32).0;
        (red, green, blue)
    };
    let mut file = Image::from_encoded_channels(size, Encoding::SMALL_FAST_LOSSLESS, SpecificChannels::rgb(pixel));
    file.attributes.chromaticities = Some(CHROMATICITIES);
    file.layer_data.attributes.white_luminance = Some(1.0);
    let written = whole(path, |temporary| {
        let mut bytes = BufWriter::new(File::create(temporary)?);
        file.write().to_buffered(&mut bytes).map_err(|error| io::Error::other(error.to_string()))?;
        bytes.flush()
    });
    written.map_err(|error| WriteError::new(path, error))
}

#[cfg(test)]
mod tests;
