//! Textures that hold tables computed on the CPU.

use crate::gpu::Gpu;
use wgpu::util::{DeviceExt, TextureDataOrder};

/// Texture without mip levels that shaders read, filled row by row.
///
/// *Shape:* `size` is width, height and layers in texels; `texels` holds all of them in that order, as `format`
/// stores them.
pub fn from_rows(
    gpu: &Gpu,
    label: &str,
    [width, height, depth_or_array_layers]: [u32; 3],
    format: wgpu::TextureFormat,
    texels: &[u8],
) -> wgpu::Texture {
    let descriptor = wgpu::TextureDescriptor {
        label: Some(label),
        size: wgpu::Extent3d { width, height, depth_or_array_layers },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::TEXTURE_BINDING,
        view_formats: &[],
    };
    gpu.device.create_texture_with_data(&gpu.queue, &descriptor, TextureDataOrder::LayerMajor, texels)
}

/// View of a whole texture that [`from_rows`] fills.
pub fn view_from_rows(
    gpu: &Gpu,
    label: &str,
    size: [u32; 3],
    format: wgpu::TextureFormat,
    texels: &[u8],
) -> wgpu::TextureView {
    from_rows(gpu, label, size, format, texels).create_view(&wgpu::TextureViewDescriptor::default())
}
