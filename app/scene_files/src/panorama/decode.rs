//! Decoding of pictures of all directions, in any layout, to equirectangular panoramas.

use std::io::Cursor;
use std::path::Path;

use image::{DynamicImage, ImageDecoder, ImageFormat, ImageReader};
use rayon::prelude::*;

use super::cube::{self, Unfolding};
use super::error::{MAX_BYTES, MAX_WIDTH, PanoramaError};
use scene::Panorama;
use scene::mipmap::linear_from_srgb;

/// Replacement for an infinite radiance: the largest half float, beyond which EXR files overflow.
const BRIGHTEST: f32 = 65504.0;

/// Decodes a picture of any of the shapes above. `path` is for messages; `notice` receives the changes that were
/// needed.
pub fn decode(bytes: &[u8], path: &Path, notice: impl FnMut(String)) -> Result<Panorama, PanoramaError> {
    decode_up_to(MAX_WIDTH, bytes, path, notice)
}

fn decode_up_to(
    max_width: u32,
    bytes: &[u8],
    path: &Path,
    mut notice: impl FnMut(String),
) -> Result<Panorama, PanoramaError> {
    // Check the size before decoding.
    let damaged = |error: image::ImageError| PanoramaError::Damaged { path: path.into(), fault: error.to_string() };
    let format = match image::guess_format(bytes) {
        Ok(format @ (ImageFormat::Png | ImageFormat::Jpeg | ImageFormat::Hdr | ImageFormat::OpenExr)) => format,
        _ => return Err(PanoramaError::Format { path: path.into() }),
    };
    let mut reader = ImageReader::with_format(Cursor::new(bytes), format);
    reader.no_limits(); // checked below, by what the decoder says it needs
    let decoder = reader.into_decoder().map_err(damaged)?;
    let bytes = decoder.total_bytes();
    if bytes > MAX_BYTES {
        return Err(PanoramaError::TooLarge { path: path.into(), bytes });
    }
    let (width, height) = decoder.dimensions();
    let shape =
        PanoramaShape::of(width, height).ok_or_else(|| PanoramaError::Shape { path: path.into(), width, height })?;

    // Decode, make it linear, and reduce it if necessary.
    let image = DynamicImage::from_decoder(decoder).map_err(damaged)?;
    let [target_width, target_height] = shape.reduced([width, height], max_width);
    let (picture, mended) = linear(image, [target_width, target_height]);
    if [target_width, target_height] != [width, height] {
        notice(format!(
            "the panorama of {width} × {height} pixels was scaled down to {target_width} × {target_height}"
        ));
    }
    if mended > 0 {
        notice(format!("numbers of the panorama that were negative or not finite: {mended}; they were replaced"));
    }
    Ok(match shape {
        PanoramaShape::Equirectangular => picture,
        PanoramaShape::Cube(unfolding) => unfolding.equirectangular(&picture),
    })
}

/// True if a picture is twice as wide as high, within 1 in 1000, as stitching programs make it.
pub fn is_equirectangular(width: u32, height: u32) -> bool {
    let (width, height) = (u64::from(width), u64::from(height));
    width > 0 && 1000 * width.abs_diff(2 * height) <= width
}

/// Layout of a picture, as its proportions show.
#[derive(Clone, Copy)]
enum PanoramaShape {
    Equirectangular,
    Cube(&'static Unfolding),
}

impl PanoramaShape {
    fn of(width: u32, height: u32) -> Option<Self> {
        if is_equirectangular(width, height) {
            return Some(Self::Equirectangular);
        }
        Unfolding::of(width, height).map(Self::Cube)
    }

    /// Size at which the panorama is not wider than `max_width`: the size divided by a whole number, for cubes face
    /// by face.
    fn reduced(self, [width, height]: [u32; 2], max_width: u32) -> [u32; 2] {
        match self {
            Self::Equirectangular => {
                let divisor = width.div_ceil(max_width);
                [width / divisor, (height / divisor).max(1)]
            }
            Self::Cube(unfolding) => {
                let side = width / unfolding.columns;
                let side = side / (cube::WIDTH_PER_SIDE * side).div_ceil(max_width);
                [side * unfolding.columns, side * unfolding.rows]
            }
        }
    }
}

/// Picture in linear light, each of its pixels the mean of the pixels of `image` that it covers, and the number of
/// values that were not valid radiances.
fn linear(image: DynamicImage, [width, height]: [u32; 2]) -> (Panorama, usize) {
    match image {
        DynamicImage::ImageRgb32F(_) | DynamicImage::ImageRgba32F(_) => {
            let image = image.into_rgb32f();
            let size = image.dimensions();
            let mut values = image.into_raw();
            let mended = values.par_iter_mut().map(|value| usize::from(mend(value))).sum();
            (reduced(&values, size, [width, height], |value| value), mended)
        }
        DynamicImage::ImageLuma16(_)
        | DynamicImage::ImageLumaA16(_)
        | DynamicImage::ImageRgb16(_)
        | DynamicImage::ImageRgba16(_) => {
            let image = image.into_rgb16();
            let of_code: Vec<f32> = (0..=u16::MAX).map(|code| linear_from_srgb(f32::from(code) / 65535.0)).collect();
            (reduced(image.as_raw(), image.dimensions(), [width, height], |code| of_code[usize::from(code)]), 0)
        }
        _ => {
            let image = image.into_rgb8();
            let of_code: Vec<f32> = (0..=u8::MAX).map(|code| linear_from_srgb(f32::from(code) / 255.0)).collect();
            (reduced(image.as_raw(), image.dimensions(), [width, height], |code| of_code[usize::from(code)]), 0)
        }
    }
}

/// Makes a valid radiance of any number; true if a change was needed.
fn mend(value: &mut f32) -> bool {
    let bad = !(value.is_finite() && *value >= 0.0);
    if bad {
        *value = if *value == f32::INFINITY { BRIGHTEST } else { 0.0 };
    }
    bad
}

fn reduced<T: Copy + Sync>(
    values: &[T],
    (width, height): (u32, u32),
    target: [u32; 2],
    linear: impl Fn(T) -> f32 + Sync,
) -> Panorama {
    let covered = |index: u32, target: u32, source: u32| {
        let edge = |index: u32| (u64::from(index) * u64::from(source) / u64::from(target)) as usize;
        edge(index)..edge(index + 1)
    };
    let pixel = |x: u32, y: u32| {
        let (columns, rows) = (covered(x, target[0], width), covered(y, target[1], height));
        let share = 1.0 / (columns.len() * rows.len()) as f32;
        let mut sum = [0.0; 3];
        for first in rows.flat_map(|row| columns.clone().map(move |column| 3 * (row * width as usize + column))) {
            for (sum, &value) in sum.iter_mut().zip(&values[first..first + 3]) {
                *sum += linear(value) * share;
            }
        }
        sum
    };
    let rgb = (0..target[1]).into_par_iter().flat_map_iter(|y| (0..target[0]).map(move |x| (x, y)));
    Panorama { width: target[0], height: target[1], rgb: rgb.map(|(x, y)| pixel(x, y)).collect() }
}

#[cfg(test)]
#[path = "tests.rs"]
mod tests;
