//! Measured maps of a channel's pixels: warps from PFM files, gains from PNG files.

use crate::gain_map::GainMap;
use crate::pfm;
use crate::warp::MeasuredWarp;
use glam::DVec2;
use thiserror::Error;

/// Reason why a map cannot be used.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum MapError {
    /// A file that is no portable float map.
    #[error("{0}")]
    Pfm(String),
    /// A warp with a single row or column.
    #[error("a warp needs at least 2 × 2 samples, and it has {width} × {height}")]
    TooSmall {
        /// Number of columns.
        width: u32,
        /// Number of rows.
        height: u32,
    },
    /// A file that is no readable picture.
    #[error("it is no picture that can be read: {0}")]
    Picture(String),
}

/// Portable float map with at least two samples each way.
pub(crate) fn grid(bytes: &[u8]) -> Result<pfm::Pfm, MapError> {
    let map = pfm::read(bytes).map_err(MapError::Pfm)?;
    if map.width < 2 || map.height < 2 {
        return Err(MapError::TooSmall { width: map.width, height: map.height });
    }
    Ok(map)
}

/// Warp whose samples are places of the picture (red: x to the right, green: y down, 0 to 1), one for each place of
/// the viewport.
pub(crate) fn warp(bytes: &[u8]) -> Result<MeasuredWarp, MapError> {
    let map = grid(bytes)?;
    let places = map.samples.iter().map(|&[x, y, _]| DVec2::new(f64::from(x), f64::from(y))).collect();
    Ok(MeasuredWarp::new(map.width, map.height, places))
}

/// Luminance of a picture as linear light: the picture's values, 0 to 1, to the power of `gamma`.
pub(crate) fn gain(bytes: &[u8], gamma: f64) -> Result<GainMap, MapError> {
    let picture = image::load_from_memory(bytes).map_err(|error| MapError::Picture(error.to_string()))?.into_rgb32f();
    let values = picture.pixels().map(|pixel| {
        let [red, green, blue] = pixel.0.map(|value| f64::from(value).max(0.0).powf(gamma));
        (0.2126 * red + 0.7152 * green + 0.0722 * blue) as f32
    });
    Ok(GainMap { size: [picture.width(), picture.height()], values: values.collect() })
}
