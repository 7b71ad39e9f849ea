//! The way of radiance to the screen, in f64 and from the formulas alone; and helpers that let the program do the
//! same.

use render::display::{Adaptation, Developer, Development, Gamut, Seen, Tone};
use studio::light;
use view::Stored;
use wgpu::util::{DeviceExt, TextureDataOrder};

use crate::colour::linear_of;
use crate::photographer::gpu;

const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Float;

/// Texture with `width` texels a row: linear red, green and blue as seen, and luminance unshifted.
pub fn texture(width: u32, texels: &[[f32; 4]]) -> wgpu::TextureView {
    let descriptor = wgpu::TextureDescriptor {
        label: Some("radiance"),
        size: wgpu::Extent3d { width, height: texels.len() as u32 / width, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: FORMAT,
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::RENDER_ATTACHMENT,
        view_formats: &[],
    };
    let contents = bytemuck::cast_slice(texels);
    let texture =
        gpu().device.create_texture_with_data(&gpu().queue, &descriptor, TextureDataOrder::LayerMajor, contents);
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}

/// An eye, and the passes that show what it sees, on a screen of 32-bit floats.
pub struct AdaptingEye {
    developer: Developer,
    adaptation: Adaptation,
}

impl AdaptingEye {
    /// Eye that has seen nothing yet.
    #[expect(clippy::new_without_default, reason = "compiling shaders is not what a default is expected to do")]
    pub fn new() -> Self {
        Self { developer: Developer::new(gpu(), FORMAT, FORMAT), adaptation: Adaptation::new(gpu()) }
    }

    /// Screen values, encoded as sRGB, for texels in rows of `width`.
    pub fn encoded(
        &mut self,
        width: u32,
        texels: &[[f32; 4]],
        stored: Stored,
        development: Development,
        elapsed_s: Option<f64>,
    ) -> Vec<[f32; 3]> {
        let radiance = texture(width, texels);
        let screen = texture(width, &vec![[0.0; 4]; texels.len()]);
        let seen = Seen { radiance: &radiance, stored, elapsed_s };
        let mut encoder = gpu().device.create_command_encoder(&Default::default());
        self.developer.adapt(gpu(), &mut encoder, &mut self.adaptation, &seen, &development);
        self.developer.show(gpu(), &mut encoder, &radiance, &self.adaptation, &development, &screen);
        gpu().queue.submit([encoder.finish()]);
        let picture = light(gpu(), &screen, &Stored::UNSHIFTED).expect("the device is there");
        picture.pixels().map(|pixel| pixel.0).collect()
    }

    /// Screen values as linear light, for texels in rows of `width`.
    pub fn shown(
        &mut self,
        width: u32,
        texels: &[[f32; 4]],
        stored: Stored,
        development: Development,
        elapsed_s: Option<f64>,
    ) -> Vec<[f64; 3]> {
        let encoded = self.encoded(width, texels, stored, development, elapsed_s);
        encoded.into_iter().map(|pixel| pixel.map(|value| linear_of(f64::from(value)))).collect()
    }
}

/// Luminance of linear sRGB (IEC 61966-2-1).
pub fn luminance(rgb: [f64; 3]) -> f64 {
    physics::colour::luminance(rgb.into())
}

/// Colour after its tone curve. `white` is the luminance that becomes white.
///
/// # Panics
/// For the histogram: its curve depends on the frame and has no formula.
pub fn toned(tone: Tone, rgb: [f64; 3], white: f64) -> [f64; 3] {
    let bright = luminance(rgb);
    let screen = match tone {
        Tone::Linear => bright,
        Tone::Reinhard => bright * (1.0 + bright / (white * white)) / (1.0 + bright),
        Tone::Exponential => -(-bright).exp_m1(),
        Tone::Filmic => bright * (2.51 * bright + 0.03) / (bright * (2.43 * bright + 0.59) + 0.14),
        Tone::Histogram => unreachable!("no formula"),
    };
    rgb.map(|value| value * screen / bright)
}

/// Colour that a screen shows for a colour outside its gamut.
pub fn in_gamut(gamut: Gamut, rgb: [f64; 3]) -> [f64; 3] {
    let least = rgb.iter().copied().fold(f64::INFINITY, f64::min);
    let most = rgb.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    if least >= 0.0 && most <= 1.0 {
        return rgb;
    }
    match gamut {
        Gamut::Clamp => rgb.map(|value| value.clamp(0.0, 1.0)),
        Gamut::White => rgb.map(|value| (value - least.min(0.0)) / (most - least.min(0.0)).max(1.0)),
        Gamut::Desaturate => {
            let grey = luminance(rgb).clamp(0.0, 1.0);
            // Bisection finds the most saturated colour of this luminance and hue inside the gamut.
            let mixed = |share: f64| rgb.map(|value| grey + share * (value - grey));
            let (mut inside, mut outside) = (0.0, 1.0);
            for _ in 0..60 {
                let middle = 0.5 * (inside + outside);
                let fits = mixed(middle).iter().all(|value| (0.0..=1.0).contains(value));
                *(if fits { &mut inside } else { &mut outside }) = middle;
            }
            mixed(inside)
        }
    }
}

/// Mean of the base-2 logarithms of gains, without the lowest and the highest tenth, none counted as more than eight
/// below the brightest; and the brightest: the logarithm that 99 of 100 gains do not exceed.
pub fn adapted(gains: &[f64]) -> (f64, f64) {
    let mut sorted: Vec<f64> = gains.iter().map(|gain| gain.log2()).collect();
    sorted.sort_by(f64::total_cmp);
    let trimmed = sorted.len() / 10;
    let kept = &sorted[trimmed..sorted.len() - trimmed];
    let bright = sorted[(sorted.len() * 99).div_ceil(100) - 1];
    (kept.iter().map(|gain| gain.max(bright - 8.0)).sum::<f64>() / kept.len() as f64, bright)
}
