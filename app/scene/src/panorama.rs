//! Pictures of all directions.

use half::f16;
use std::sync::Arc;

/// Panorama: a picture of all directions, infinitely far away, in the world frame.
///
/// The projection is equirectangular: the first row is straight up, the last straight down. Columns go once round to
/// the right; the middle one is −z.
///
/// Radiances are half floats, which is what the renderers draw: the largest picture has 134 million pixels. Copies
/// share them.
#[derive(Clone, Debug, PartialEq)]
pub struct Panorama {
    /// Width, pixels.
    pub width: u32,
    /// Height, pixels.
    pub height: u32,
    /// Radiances of the pixels, `width * height`, linear sRGB, on the scale where white is 1.
    pub rgb: Arc<Vec<[f16; 3]>>,
}

impl Panorama {
    /// Greatest radiance of a pixel: half floats end there.
    pub const BRIGHTEST: f32 = 65504.0;

    /// Panorama of radiances, each rounded to a half float.
    pub fn new(width: u32, height: u32, rgb: impl IntoIterator<Item = [f32; 3]>) -> Self {
        let rgb = rgb.into_iter().map(|rgb| rgb.map(f16::from_f32)).collect();
        Self { width, height, rgb: Arc::new(rgb) }
    }

    /// Radiance of the pixel in this column and row, which must exist.
    pub fn pixel(&self, column: usize, row: usize) -> [f32; 3] {
        self.rgb[row * self.width as usize + column].map(f16::to_f32)
    }
}
