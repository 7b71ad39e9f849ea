//! Measured maps of a channel's pixels: warps from PFM files, gains from pictures.
//!
//! A file that several channels name is read once, and its samples are shared. Memory is taken from a budget before it
//! is allocated: a picture of a few kilobytes may claim many gigabytes of pixels.

use crate::gain_map::GainMap;
use crate::pfm::{self, Pfm};
use crate::warp::MeasuredWarp;
use glam::DVec2;
use image::{DynamicImage, ImageDecoder, ImageReader};
use regular_file::{Budget, OverBudget};
use std::collections::HashMap;
use std::io::Cursor;
use std::sync::Arc;
use thiserror::Error;

/// Largest number of samples of a gain map: four for each pixel of the finest projectors.
const MAX_SAMPLES: u64 = 1 << 27;

/// Memory of a warp or a grid for each of its samples, bytes: the places, and the net that finds them again.
const BYTES_OF_PLACE: u64 = 80;

/// Reason why a map cannot be used. The text is worded to follow the file's name.
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
    /// A picture with more samples than any projector has pixels.
    #[error("it has {width} × {height} samples; at most {MAX_SAMPLES} can be read, so make it smaller")]
    TooLarge {
        /// Number of columns.
        width: u32,
        /// Number of rows.
        height: u32,
    },
    /// More memory than there is.
    #[error(transparent)]
    Memory(#[from] OverBudget),
}

/// Maps of one display by the names of their files, and the memory that they take.
pub(crate) struct MapShelf<'a> {
    /// Memory for all files of the display.
    pub budget: &'a Budget,
    warps: HashMap<String, MeasuredWarp>,
    /// Gains by file name and the bits of their gamma.
    gains: HashMap<(String, u64), GainMap>,
}

impl<'a> MapShelf<'a> {
    /// Empty shelf.
    pub fn new(budget: &'a Budget) -> Self {
        Self { budget, warps: HashMap::new(), gains: HashMap::new() }
    }

    /// Warp of a file, which `read` reads unless it is there already.
    pub fn warp<E>(
        &mut self,
        name: &str,
        read: impl FnOnce(&Budget) -> Result<Vec<u8>, E>,
        wrong: impl FnOnce(MapError) -> E,
    ) -> Result<MeasuredWarp, E> {
        if let Some(known) = self.warps.get(name) {
            return Ok(known.clone());
        }
        let found = warp(&read(self.budget)?, self.budget).map_err(wrong)?;
        self.warps.insert(name.to_owned(), found.clone());
        Ok(found)
    }

    /// Gain of a file, which `read` reads unless it is there already.
    pub fn gain<E>(
        &mut self,
        name: &str,
        gamma: f64,
        read: impl FnOnce(&Budget) -> Result<Vec<u8>, E>,
        wrong: impl FnOnce(MapError) -> E,
    ) -> Result<GainMap, E> {
        let key = (name.to_owned(), gamma.to_bits());
        if let Some(known) = self.gains.get(&key) {
            return Ok(known.clone());
        }
        let found = gain(&read(self.budget)?, gamma, self.budget).map_err(wrong)?;
        self.gains.insert(key, found.clone());
        Ok(found)
    }
}

/// Portable float map with at least two samples each way. The budget pays for what is made of it, too.
pub(crate) fn grid(bytes: &[u8], budget: &Budget) -> Result<Pfm, MapError> {
    let header = pfm::header(bytes).map_err(MapError::Pfm)?;
    if header.width < 2 || header.height < 2 {
        return Err(MapError::TooSmall { width: header.width, height: header.height });
    }
    budget.take(u64::from(header.width) * u64::from(header.height) * BYTES_OF_PLACE)?;
    Ok(header.samples())
}

/// Warp whose samples are places of the picture (red: x to the right, green: y down, 0 to 1), one for each place of
/// the viewport.
fn warp(bytes: &[u8], budget: &Budget) -> Result<MeasuredWarp, MapError> {
    let map = grid(bytes, budget)?;
    let places = map.samples.iter().map(|&[x, y, _]| DVec2::new(f64::from(x), f64::from(y))).collect();
    Ok(MeasuredWarp::new(map.width, map.height, places))
}

/// Luminance of a picture as linear light: the picture's values, 0 to 1, to the power of `gamma`.
fn gain(bytes: &[u8], gamma: f64, budget: &Budget) -> Result<GainMap, MapError> {
    let unreadable = |error: &dyn std::fmt::Display| MapError::Picture(error.to_string());
    let reader = ImageReader::new(Cursor::new(bytes)).with_guessed_format().map_err(|error| unreadable(&error))?;
    let decoder = reader.into_decoder().map_err(|error| unreadable(&error))?;
    let (width, height) = decoder.dimensions();
    let samples = u64::from(width) * u64::from(height);
    if samples > MAX_SAMPLES {
        return Err(MapError::TooLarge { width, height });
    }

    // While a picture is decoded, its pixels and its samples are there together.
    let grey = matches!(decoder.color_type(), image::ColorType::L8 | image::ColorType::L16);
    let decoded = decoder.total_bytes().saturating_add(if grey { 0 } else { 12 * samples });
    budget.take(decoded.saturating_add(4 * samples))?;
    let picture = DynamicImage::from_decoder(decoder).map_err(|error| unreadable(&error))?;
    let light = |value: f64| value.max(0.0).powf(gamma);
    let values: Vec<f32> = match picture {
        DynamicImage::ImageLuma8(picture) => {
            let table: Vec<f32> = (0..=255).map(|value| light(f64::from(value) / 255.0) as f32).collect();
            picture.into_raw().into_iter().map(|value| table[usize::from(value)]).collect()
        }
        DynamicImage::ImageLuma16(picture) => {
            picture.into_raw().into_iter().map(|value| light(f64::from(value) / 65_535.0) as f32).collect()
        }
        coloured => {
            let luminance = |pixel: &image::Rgb<f32>| {
                let [red, green, blue] = pixel.0.map(|value| light(f64::from(value)));
                (0.2126 * red + 0.7152 * green + 0.0722 * blue) as f32
            };
            coloured.into_rgb32f().pixels().map(luminance).collect()
        }
    };
    budget.give_back(decoded);
    Ok(GainMap { size: [width, height], values: Arc::new(values) })
}
