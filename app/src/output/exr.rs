//! Light into OpenEXR files: 32-bit floats, linear sRGB, cd/m².
//!
//! The file says so itself: its chromaticities are those of ITU-R BT.709, which sRGB shares, and its white luminance is 1, so that red = green = blue = 1 is
//! 1 cd/m². Compression is lossless: values come back to the bit.

use crate::error::Error;
use exr::meta::attribute::Chromaticities;
use exr::prelude::{Encoding, Image, SpecificChannels, Vec2, WritableImage};
use image::Rgb32FImage;
use std::path::Path;

/// ITU-R BT.709: red, green, blue and the D65 white, as x and y.
const CHROMATICITIES: Chromaticities =
    Chromaticities { red: Vec2(0.64, 0.33), green: Vec2(0.3, 0.6), blue: Vec2(0.15, 0.06), white: Vec2(0.3127, 0.329) };

/// Writes `light`.
///
/// # Errors
/// [`Error::Write`] with the path and the reason; nothing is left behind then.
pub fn save(light: &Rgb32FImage, path: &Path) -> Result<(), Error> {
    let size = (light.width() as usize, light.height() as usize);
    let pixel = |place: Vec2<usize>| {
        let [red, green, blue] = light.get_pixel(place.x() as u32, place.y() as u32).0;
        (red, green, blue)
    };
    let mut file = Image::from_encoded_channels(size, Encoding::SMALL_FAST_LOSSLESS, SpecificChannels::rgb(pixel));
    file.attributes.chromaticities = Some(CHROMATICITIES);
    file.layer_data.attributes.white_luminance = Some(1.0);
    file.write().to_file(path).map_err(|error| Error::Write { path: path.to_owned(), reason: error.to_string() })
}
