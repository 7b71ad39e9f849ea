//! Mipmaps: a texture in ever smaller copies, so that distant surfaces neither flicker nor change brightness.
//!
//! Each level is the mean of the one before it, in linear light: the mean of sRGB numbers is too dark, and under the
//! searchlight effect the error would grow with the exposure. Colours are weighted by opacity, so that the cut-out
//! parts of a leaf do not bleed into its edge. An odd row of 2m + 1 pixels becomes m pixels that each cover 2 + 1/m
//! of it, and every source pixel has the same weight: dropping the last one would shift the picture.
//!
//! Levels are averaged in f32 and rounded once each, so errors do not pile up along the chain.

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
    let mut levels = vec![Level { width: texture.width, height: texture.height, rgba: texture.rgba.to_vec() }];
    let mut picture = Linear::from_srgb(texture);
    while picture.width > 1 || picture.height > 1 {
        picture = picture.half();
        levels.push(picture.to_srgb());
    }
    levels
}

/// Picture in linear light; colours are multiplied by their weight, which is opacity + [`TRANSPARENT_WEIGHT`].
struct Linear {
    width: usize,
    height: usize,
    pixels: Vec<[f32; 4]>,
}

impl Linear {
    fn from_srgb(texture: &Texture) -> Self {
        let linear: [f32; 256] = std::array::from_fn(|code| linear_from_srgb(code as f32 / 255.0));
        let pixels = texture
            .rgba
            .par_chunks_exact(4)
            .map(|pixel| {
                let alpha = f32::from(pixel[3]) / 255.0;
                let weight = alpha + TRANSPARENT_WEIGHT;
                let [r, g, b] = [0, 1, 2].map(|channel| linear[usize::from(pixel[channel])] * weight);
                [r, g, b, alpha]
            })
            .collect();
        Self { width: texture.width as usize, height: texture.height as usize, pixels }
    }

    fn half(&self) -> Self {
        let (width, height) = ((self.width / 2).max(1), (self.height / 2).max(1));
        let mut pixels = vec![[0.0; 4]; width * height];
        pixels.par_chunks_exact_mut(width).enumerate().for_each(|(y, row)| {
            let rows = taps(y, self.height, height);
            for (x, pixel) in row.iter_mut().enumerate() {
                for (source_x, weight_x) in taps(x, self.width, width) {
                    for (source_y, weight_y) in rows {
                        let source = self.pixels[source_y * self.width + source_x];
                        for (sum, value) in pixel.iter_mut().zip(source) {
                            *sum += weight_x * weight_y * value;
                        }
                    }
                }
            }
        });
        Self { width, height, pixels }
    }

    fn to_srgb(&self) -> Level {
        let rgba = self
            .pixels
            .par_iter()
            .flat_map_iter(|&[r, g, b, alpha]| {
                let weight = alpha + TRANSPARENT_WEIGHT;
                let [r, g, b] = [r, g, b].map(|value| srgb_from_linear(value / weight));
                [r, g, b, alpha].map(|value| (value * 255.0).round() as u8)
            })
            .collect();
        Level { width: self.width as u32, height: self.height as u32, rgba }
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
