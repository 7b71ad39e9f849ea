//! Factors of a channel's pixels on the device.

use render::{Gpu, view_from_rows};
use room::Gains;

/// Factors of pixels, for the developing pass: red multiplies, and green is then added.
pub fn upload(gpu: &Gpu, gains: &Gains) -> wgpu::TextureView {
    let lift = |pixel: usize| gains.lifts.as_ref().map_or(0.0, |lifts| lifts[pixel]);
    let texels: Vec<[f32; 2]> =
        gains.factors.iter().enumerate().map(|(pixel, factor)| [*factor, lift(pixel)]).collect();
    let size = [gains.size[0], gains.size[1], 1];
    view_from_rows(gpu, "gains", size, wgpu::TextureFormat::Rg32Float, bytemuck::cast_slice(&texels))
}
