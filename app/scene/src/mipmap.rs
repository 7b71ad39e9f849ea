//! Mipmaps: a texture in ever smaller copies, so that distant surfaces neither flicker nor change brightness.
//!
//! Each level is the mean of the one before it, in linear light: the mean of sRGB numbers is too dark, and under the
//! searchlight effect the error would grow with the exposure. Colours are weighted by opacity, so that the cut-out
//! parts of a leaf do not bleed into its edge. An odd row of 2m + 1 pixels becomes m pixels that each cover 2 + 1/m
//! of it, and every source pixel has the same weight: dropping the last one would shift the picture.
//!
//! Levels are averaged in f32 and rounded once each, so errors do not pile up along the chain. Each is made from the
//! rows of the one before as they come, so that no level is ever in memory as floats.

use std::sync::OnceLock;

use rayon::prelude::*;

use crate::material::Texture;

/// Weight of a fully transparent pixel's colour beside an opaque one's: small enough to vanish among opaque pixels,
/// large enough that a wholly transparent area keeps its mean colour.
const TRANSPARENT_WEIGHT: f32 = 1.0 / 65536.0;

/// Level of a mipmap chain: 8-bit sRGB with straight alpha, rows from the top.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Level {
    /// Width, pixels.
    pub width: u32,
    /// Height, pixels.
    pub height: u32,
    /// Pixels: `width * height` times four bytes, R, G, B, A.
    pub rgba: Vec<u8>,
}

/// Mipmap chain, from the texture itself down to one pixel.
///
/// Each side is half the one before, rounded down, and at least 1: the sizes that graphics interfaces expect. The
/// result does not depend on the number of threads. A texture without pixels gives no levels.
pub fn mipmap(texture: &Texture) -> Vec<Level> {
    if texture.width == 0 || texture.height == 0 {
        return Vec::new();
    }
    let whole = Level { width: texture.width, height: texture.height, rgba: texture.rgba.to_vec() };
    std::iter::once(whole).chain(smaller_levels(texture)).collect()
}

/// Mipmap chain without the texture itself. In linear light there are only a few rows at a time.
pub fn smaller_levels(texture: &Texture) -> Vec<Level> {
    let (width, height) = (texture.width as usize, texture.height as usize);
    if width.max(height) < 2 {
        return Vec::new();
    }
    let mut first = Halving::new(width, height);
    let linear = LinearCodes::new();
    let codes = SrgbCodes::get();
    let mut levels = Vec::new();
    let mut below = first.next();
    for start in (0..first.height).step_by(BAND) {
        let end = (start + BAND).min(first.height);
        let mut band = vec![[0.0; 4]; (end - start) * first.width];
        let level = &mut first.rgba[4 * start * first.width..4 * end * first.width];
        let rows = band.par_chunks_exact_mut(first.width).zip(level.par_chunks_exact_mut(4 * first.width));
        rows.enumerate().for_each_init(
            || [const { Vec::new() }; 3],
            |sources, (row, (pixels, level))| {
                let taps = taps(start + row, height, first.height);
                if width == 2 * first.width && height == 2 * first.height {
                    let row_of = |tap: usize| &texture.rgba[4 * width * taps[tap].0..][..4 * width];
                    linear.halve([row_of(0), row_of(1)], pixels);
                    codes.row(pixels, level);
                    return;
                }
                for (source, (y, weight)) in sources.iter_mut().zip(taps) {
                    if weight > 0.0 {
                        linear.row(&texture.rgba[4 * y * width..4 * (y + 1) * width], source);
                    }
                }
                halve(sources.each_ref().map(Vec::as_slice), taps.map(|(_, weight)| weight), width, pixels);
                codes.row(pixels, level);
            },
        );
        if let Some(below) = &mut below {
            band.chunks_exact(first.width).for_each(|row| below.push(row, codes));
        }
    }
    levels.push(first.level());
    while let Some(halving) = below {
        let (level, next) = (*halving).into_parts();
        levels.push(level);
        below = next;
    }
    levels
}

/// Number of rows that are made at a time, on all cores.
const BAND: usize = 64;

/// One level that is made from the rows of the level before. Colours are in linear light, multiplied by their weight,
/// which is opacity + [`TRANSPARENT_WEIGHT`].
struct Halving {
    source: [usize; 2],
    width: usize,
    height: usize,
    /// The last three rows of the source, at their number modulo 3.
    rows: [Vec<[f32; 4]>; 3],
    /// Number of rows that came.
    came: usize,
    /// Number of rows that were made.
    made: usize,
    /// Row that is being made.
    row: Vec<[f32; 4]>,
    rgba: Vec<u8>,
    below: Option<Box<Self>>,
}

impl Halving {
    /// Level below a level of this size.
    fn new(source_width: usize, source_height: usize) -> Self {
        let (width, height) = ((source_width / 2).max(1), (source_height / 2).max(1));
        Self {
            source: [source_width, source_height],
            width,
            height,
            rows: [const { Vec::new() }; 3],
            came: 0,
            made: 0,
            row: vec![[0.0; 4]; width],
            rgba: vec![0; 4 * width * height],
            below: None,
        }
    }

    /// Level below this one, with all further ones; `None` if this is the last.
    fn next(&self) -> Option<Box<Self>> {
        (self.width.max(self.height) > 1).then(|| {
            let mut next = Self::new(self.width, self.height);
            next.below = next.next();
            Box::new(next)
        })
    }

    /// Takes the next row of the source.
    fn push(&mut self, row: &[[f32; 4]], codes: &SrgbCodes) {
        let kept = &mut self.rows[self.came % 3];
        kept.clear();
        kept.extend_from_slice(row);
        self.came += 1;
        while self.made < self.height {
            let taps = taps(self.made, self.source[1], self.height);
            if taps.iter().any(|&(y, weight)| weight > 0.0 && y >= self.came) {
                return;
            }
            let sources = taps.map(|(y, _)| self.rows[y % 3].as_slice());
            halve(sources, taps.map(|(_, weight)| weight), self.source[0], &mut self.row);
            let start = 4 * self.made * self.width;
            codes.row(&self.row, &mut self.rgba[start..start + 4 * self.width]);
            self.made += 1;
            if let Some(below) = &mut self.below {
                below.push(&self.row, codes);
            }
        }
    }

    fn into_parts(mut self) -> (Level, Option<Box<Self>>) {
        let below = self.below.take();
        (self.level(), below)
    }

    fn level(self) -> Level {
        Level { width: self.width as u32, height: self.height as u32, rgba: self.rgba }
    }
}

/// Means of pixels of up to three rows, for a row of half the width. Rows of weight 0 are not read.
fn halve(rows: [&[[f32; 4]]; 3], weights: [f32; 3], source_width: usize, target: &mut [[f32; 4]]) {
    let width = target.len();
    if source_width == 2 * width && weights[2] == 0.0 && weights[1] > 0.0 {
        // Four pixels of one weight.
        let weight = 0.5 * weights[0];
        let pairs = rows[0].as_chunks::<2>().0.iter().zip(rows[1].as_chunks::<2>().0);
        for (pixel, ([a, c], [b, d])) in target.iter_mut().zip(pairs) {
            *pixel = std::array::from_fn(|channel| {
                weight * a[channel] + weight * b[channel] + weight * c[channel] + weight * d[channel]
            });
        }
        return;
    }
    for (x, pixel) in target.iter_mut().enumerate() {
        *pixel = [0.0; 4];
        for (source_x, weight_x) in taps(x, source_width, width) {
            for (row, weight_y) in rows.iter().zip(weights) {
                let weight = weight_x * weight_y;
                if weight > 0.0 {
                    for (sum, value) in pixel.iter_mut().zip(row[source_x]) {
                        *sum += weight * value;
                    }
                }
            }
        }
    }
}

/// Linear values of all sRGB codes.
struct LinearCodes([f32; 256]);

/// Weight of an opaque pixel.
const OPAQUE_WEIGHT: f32 = 1.0 + TRANSPARENT_WEIGHT;

impl LinearCodes {
    fn new() -> Self {
        Self(std::array::from_fn(|code| linear_from_srgb(code as f32 / 255.0)))
    }

    /// Row of half the width from two rows of sRGB pixels: as [`halve`] makes it of their linear light.
    fn halve(&self, [upper, lower]: [&[u8]; 2], target: &mut [[f32; 4]]) {
        let pairs = upper.as_chunks::<8>().0.iter().zip(lower.as_chunks::<8>().0);
        for (pixel, (a, b)) in target.iter_mut().zip(pairs) {
            if [a[3], a[7], b[3], b[7]] == [255; 4] {
                let mean = |channel: usize| {
                    let of = |code: u8| self.0[usize::from(code)];
                    let sum = of(a[channel]) + of(b[channel]) + of(a[channel + 4]) + of(b[channel + 4]);
                    0.25 * OPAQUE_WEIGHT * sum
                };
                *pixel = [mean(0), mean(1), mean(2), 1.0];
            } else {
                let mut sum = [0.0; 4];
                for source in [a, b].into_iter().flat_map(|pair| pair.as_chunks::<4>().0) {
                    for (sum, value) in sum.iter_mut().zip(self.pixel(*source)) {
                        *sum += 0.25 * value;
                    }
                }
                *pixel = sum;
            }
        }
    }

    /// Pixel in linear light.
    fn pixel(&self, [r, g, b, alpha]: [u8; 4]) -> [f32; 4] {
        let alpha = f32::from(alpha) / 255.0;
        let weight = alpha + TRANSPARENT_WEIGHT;
        let [r, g, b] = [r, g, b].map(|code| self.0[usize::from(code)] * weight);
        [r, g, b, alpha]
    }

    /// Row of pixels in linear light.
    fn row(&self, rgba: &[u8], row: &mut Vec<[f32; 4]>) {
        row.clear();
        row.extend(rgba.as_chunks::<4>().0.iter().map(|&pixel| self.pixel(pixel)));
    }
}

/// Table of the linear values at which the rounded sRGB code changes.
struct SrgbCodes {
    /// For each of as many equal parts of 0 to 1: the code of its beginning, and the least linear value of the next
    /// code. A part has two codes at most.
    parts: Vec<(f32, u8)>,
}

impl SrgbCodes {
    /// Number of parts: a part is shorter than the shortest range of a code, 1/(12.92 × 255).
    const PARTS: usize = 4096;

    /// Table, computed once.
    fn get() -> &'static Self {
        static TABLE: OnceLock<SrgbCodes> = OnceLock::new();
        TABLE.get_or_init(|| {
            let rounded = |value: f32| (srgb_from_linear(value) * 255.0).round() as u8;
            let least = |code: u8| {
                // Positive floats are in the order of their bits.
                let (mut below, mut from) = (0.0_f32.to_bits(), 1.0_f32.to_bits());
                while from - below > 1 {
                    let middle = below + (from - below) / 2;
                    if rounded(f32::from_bits(middle)) >= code { from = middle } else { below = middle }
                }
                f32::from_bits(from)
            };
            let least_of_next: Vec<f32> = (1..=255).map(least).chain([f32::INFINITY]).collect();
            let codes = (0..Self::PARTS).map(|part| rounded(part as f32 / Self::PARTS as f32));
            Self { parts: codes.map(|code| (least_of_next[usize::from(code)], code)).collect() }
        })
    }

    fn of(&self, value: f32) -> u8 {
        let (next, code) = self.parts[((value * Self::PARTS as f32) as usize).min(Self::PARTS - 1)];
        code + u8::from(value >= next)
    }

    /// Row of a level.
    fn row(&self, pixels: &[[f32; 4]], rgba: &mut [u8]) {
        for (&[r, g, b, alpha], rgba) in pixels.iter().zip(rgba.as_chunks_mut::<4>().0) {
            let share = 1.0 / (alpha + TRANSPARENT_WEIGHT);
            *rgba = [self.of(r * share), self.of(g * share), self.of(b * share), (alpha * 255.0 + 0.5) as u8];
        }
    }
}

/// Indices of up to three source pixels under target pixel `index`, each with its share; unused taps have weight 0.
fn taps(index: usize, source: usize, target: usize) -> [(usize, f32); 3] {
    if source == target {
        return [(index, 1.0), (index, 0.0), (index, 0.0)];
    }
    let first = 2 * index;
    let share = |part: usize| part as f32 / source as f32;
    if source == 2 * target {
        [(first, 0.5), (first + 1, 0.5), (first, 0.0)]
    } else {
        // 2m + 1 pixels become m: the window slides by 1/m of a pixel from one target pixel to the next.
        [(first, share(target - index)), (first + 1, share(target)), (first + 2, share(index + 1))]
    }
}

/// Linear value of an sRGB value, both 0 to 1 (IEC 61966-2-1).
pub fn linear_from_srgb(value: f32) -> f32 {
    if value <= 0.04045 { value / 12.92 } else { ((value + 0.055) / 1.055).powf(2.4) }
}

/// Value in sRGB of a linear value, both 0 to 1 (IEC 61966-2-1, the inverse).
fn srgb_from_linear(value: f32) -> f32 {
    if value <= 0.003_130_8 { value * 12.92 } else { 1.055 * value.powf(1.0 / 2.4) - 0.055 }
}

#[cfg(test)]
mod tests {
    //! Laws under test: averages are taken in linear light and conserve it. A program that averages sRGB numbers
    //! makes black and white 127 instead of 188; one that ignores alpha bleeds hidden colours; one that drops odd
    //! rows loses light.

    use super::*;

    /// Tolerance in sRGB codes: rounding to 8 bits once, in a colour whose linear value is at most 1.
    const HALF_A_CODE: f64 = 0.5;

    fn texture(width: u32, height: u32, rgba: Vec<u8>) -> Texture {
        assert_eq!(rgba.len(), (width * height * 4) as usize);
        let wrap = Default::default();
        Texture { name: String::new(), width, height, rgba: rgba.into(), wrap, nearest: false }
    }

    #[test]
    fn black_and_white_average_to_half_the_light() {
        // 188 is the sRGB code of linear 0.5 (0.7354 × 255 = 187.5).
        let levels = mipmap(&texture(2, 1, vec![0, 0, 0, 255, 255, 255, 255, 255]));
        assert_eq!(levels.len(), 2);
        assert_eq!(levels[1], Level { width: 1, height: 1, rgba: vec![188, 188, 188, 255] });
    }

    #[test]
    fn hidden_colours_do_not_bleed() {
        let levels = mipmap(&texture(2, 1, vec![255, 0, 0, 0, 0, 128, 0, 255]));
        assert_eq!(levels[1].rgba, [0, 128, 0, 128]);
    }

    #[test]
    fn transparent_areas_keep_their_colour() {
        let levels = mipmap(&texture(2, 2, [40, 80, 120, 0].repeat(4)));
        assert_eq!(levels[1].rgba, [40, 80, 120, 0]);
    }

    #[test]
    fn sides_halve_downwards_until_one_pixel() {
        let levels = mipmap(&texture(13, 4, vec![90; 13 * 4 * 4]));
        let sizes: Vec<_> = levels.iter().map(|level| (level.width, level.height)).collect();
        assert_eq!(sizes, [(13, 4), (6, 2), (3, 1), (1, 1)]);
        for level in levels {
            assert_eq!(level.rgba.len(), (level.width * level.height * 4) as usize);
            assert!(level.rgba.iter().all(|&code| code == 90), "a plain colour stays what it is");
        }
    }

    #[test]
    fn every_source_pixel_weighs_the_same_at_any_size() {
        for source in 2..40_usize {
            let target = source / 2;
            let mut weights = vec![0.0_f64; source];
            for index in 0..target {
                let of_target = taps(index, source, target);
                let sum: f32 = of_target.iter().map(|tap| tap.1).sum();
                assert!((sum - 1.0).abs() < 1e-6, "source {source}, target pixel {index}: {sum}");
                for (pixel, weight) in of_target {
                    weights[pixel] += f64::from(weight);
                }
            }
            let even = target as f64 / source as f64;
            assert!(weights.iter().all(|weight| (weight - even).abs() < 1e-6), "source {source}: {weights:?}");
        }
    }

    #[test]
    fn last_level_is_the_mean_of_the_first_in_linear_light() {
        let (width, height) = (37, 21);
        // A fixed opaque pattern without symmetry.
        let rgba: Vec<u8> = (0..width * height)
            .flat_map(|i| [(i * 97 % 256) as u8, (i * 31 % 251) as u8, (i * i % 256) as u8, 255])
            .collect();
        let levels = mipmap(&texture(width, height, rgba.clone()));
        let last = levels.last().unwrap();
        for channel in 0..3 {
            let light = |pixel: &[u8]| f64::from(linear_from_srgb(f32::from(pixel[channel]) / 255.0));
            let mean = rgba.chunks(4).map(light).sum::<f64>() / f64::from(width * height);
            let expected = f64::from(srgb_from_linear(mean as f32)) * 255.0;
            assert!((f64::from(last.rgba[channel]) - expected).abs() < HALF_A_CODE + 1e-3, "channel {channel}");
        }
    }

    #[test]
    fn every_code_survives_linear_light() {
        for code in 0..=255_u8 {
            let back = srgb_from_linear(linear_from_srgb(f32::from(code) / 255.0)) * 255.0;
            assert_eq!(back.round() as u8, code);
        }
    }

    #[test]
    fn a_texture_without_pixels_has_no_levels() {
        assert!(mipmap(&texture(0, 5, Vec::new())).is_empty());
    }
}
