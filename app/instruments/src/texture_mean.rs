//! Mean colours of materials, for pictures in which a surface is a spot.

use scene::{Material, Scene};

/// Largest number of pixels of a texture that are looked at.
const SAMPLES: usize = 4096;

/// Linear colour and opacity of each material, its texture and its own light taken in.
pub fn material_means(scene: &Scene) -> Vec<[f32; 4]> {
    let textures: Vec<[f32; 4]> = scene.textures.iter().map(|texture| mean(&texture.rgba)).collect();
    let of = |texture: Option<usize>| texture.and_then(|index| textures.get(index)).copied().unwrap_or([1.0; 4]);
    let material_mean = |material: &Material| {
        let base = of(material.base_colour_texture);
        let own = of(material.emissive_texture);
        let mut colour: [f32; 4] = std::array::from_fn(|index| material.base_colour[index] * base[index]);
        for (index, emitted) in material.emissive.iter().enumerate() {
            colour[index] += emitted * own[index];
        }
        colour
    };
    scene.materials.iter().map(material_mean).collect()
}

/// Mean of a picture's linear colour, weighed by opacity, and of its opacity.
fn mean(rgba: &[u8]) -> [f32; 4] {
    let pixels = rgba.as_chunks::<4>().0;
    let step = pixels.len().div_ceil(SAMPLES).max(1);
    let mut sum = [0.0_f32; 4];
    for pixel in pixels.iter().step_by(step) {
        let alpha = f32::from(pixel[3]) / 255.0;
        for (sum, value) in sum.iter_mut().zip(pixel) {
            *sum += alpha * linear(*value);
        }
        sum[3] += alpha - alpha * linear(pixel[3]);
    }
    let weight = sum[3];
    let number = pixels.len().div_ceil(step).max(1) as f32;
    if weight > 0.0 { [sum[0] / weight, sum[1] / weight, sum[2] / weight, weight / number] } else { [0.0; 4] }
}

/// Linear value of an 8-bit sRGB one.
fn linear(value: u8) -> f32 {
    let value = f32::from(value) / 255.0;
    if value <= 0.040_45 { value / 12.92 } else { ((value + 0.055) / 1.055).powf(2.4) }
}

#[cfg(test)]
mod tests {
    //! Law: a mean is taken of light, not of its code, and what cannot be seen has no weight.

    use super::*;

    #[test]
    fn black_and_white_make_half_the_light() {
        let picture = [[0, 0, 0, 255], [255, 255, 255, 255], [9, 99, 199, 0], [9, 99, 199, 0]].concat();
        let [red, green, blue, alpha] = mean(&picture);
        assert!((red - 0.5).abs() < 1e-6 && (green - 0.5).abs() < 1e-6 && (blue - 0.5).abs() < 1e-6);
        assert!((alpha - 0.5).abs() < 1e-6);
        assert_eq!(mean(&[]), [0.0; 4]);
    }
}
