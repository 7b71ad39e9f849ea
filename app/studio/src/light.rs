//! Light in memory: linear sRGB, fetched from the device and taken there.

use crate::sheet::Sheet;
use half::f16;
use image::Rgb32FImage;
use render::{Gpu, GpuError, display, view_from_rows};
use view::Stored;

/// Texture format in which light is fetched.
const LIGHT_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Float;

/// Uploads texels into a texture of one of the formats that renderers draw in.
pub fn upload(gpu: &Gpu, size: [u32; 2], texels: &[[f32; 4]], format: wgpu::TextureFormat) -> wgpu::TextureView {
    let half = |value: f32| f16::from_f32(value.clamp(-shaders::HALF_LIMIT, shaders::HALF_LIMIT));
    let halves: Vec<[f16; 4]>;
    let bytes: &[u8] = if format == wgpu::TextureFormat::Rgba32Float {
        bytemuck::cast_slice(texels)
    } else {
        halves = texels.iter().map(|texel| texel.map(half)).collect();
        bytemuck::cast_slice(&halves)
    };
    view_from_rows(gpu, "radiance", [size[0], size[1], 1], format, bytes)
}

/// Fetches radiance from the device: linear sRGB in cd/m².
///
/// # Errors
/// [`GpuError::Lost`] if the device went away.
pub fn light(gpu: &Gpu, radiance: &wgpu::TextureView, stored: &Stored) -> Result<Rgb32FImage, GpuError> {
    let size = radiance.texture().size();

    let candela = stored.white / stored.scale;
    let largest = f64::from(f32::MAX);
    let values = texels(gpu, radiance)?
        .into_iter()
        .flat_map(|[red, green, blue, _]| [red, green, blue])
        .map(|value| (f64::from(value) * candela).clamp(-largest, largest) as f32)
        .collect();
    Ok(Rgb32FImage::from_raw(size.width, size.height, values).expect("the sheet has three colours a pixel"))
}

/// Fetches a texture as 32-bit floats, without any conversion of the values.
pub fn texels(gpu: &Gpu, texture: &wgpu::TextureView) -> Result<Vec<[f32; 4]>, GpuError> {
    let size = texture.texture().size();
    let sheet = Sheet::new(gpu, [size.width, size.height], LIGHT_FORMAT);
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    display::copy(gpu, &mut encoder, texture, &sheet.view(), LIGHT_FORMAT);
    Ok(bytemuck::pod_collect_to_vec::<u8, [f32; 4]>(&sheet.fetch(gpu, encoder)?))
}

/// Largest side of a picture that the device can draw, pixels.
pub fn largest_side(gpu: &Gpu) -> u32 {
    gpu.device.limits().max_texture_dimension_2d
}
