//! Upload of the panorama, the picture of all directions around the scene.

use crate::gpu::Gpu;
use half::f16;
use rayon::prelude::*;
use scene::Panorama;
use wgpu::util::{DeviceExt, TextureDataOrder};

/// Texture of a panorama with all its mip levels; one black texel if the scene has none.
pub fn upload(gpu: &Gpu, panorama: Option<&Panorama>) -> (wgpu::TextureView, wgpu::Sampler) {
    let none = Panorama { width: 1, height: 1, rgb: vec![[0.0; 3]] };
    let levels = levels(panorama.unwrap_or(&none));
    let texels: Vec<[f16; 4]> = levels.iter().flat_map(|level| level.rgb.iter().map(texel)).collect();
    let descriptor = wgpu::TextureDescriptor {
        label: Some("panorama"),
        size: wgpu::Extent3d { width: levels[0].width, height: levels[0].height, depth_or_array_layers: 1 },
        mip_level_count: levels.len() as u32,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::Rgba16Float,
        usage: wgpu::TextureUsages::TEXTURE_BINDING,
        view_formats: &[],
    };
    let bytes = bytemuck::cast_slice(&texels);
    let view = gpu
        .device
        .create_texture_with_data(&gpu.queue, &descriptor, TextureDataOrder::LayerMajor, bytes)
        .create_view(&wgpu::TextureViewDescriptor::default());
    // Longitude wraps round; latitude is clamped at the poles.
    let sampler = gpu.device.create_sampler(&wgpu::SamplerDescriptor {
        label: Some("panorama"),
        address_mode_u: wgpu::AddressMode::Repeat,
        address_mode_v: wgpu::AddressMode::ClampToEdge,
        mag_filter: wgpu::FilterMode::Linear,
        min_filter: wgpu::FilterMode::Linear,
        mipmap_filter: wgpu::MipmapFilterMode::Linear,
        ..Default::default()
    });
    (view, sampler)
}

fn texel(rgb: &[f32; 3]) -> [f16; 4] {
    let [red, green, blue] = rgb.map(|value| f16::from_f32(value.clamp(0.0, shaders::HALF_LIMIT)));
    [red, green, blue, f16::ONE]
}

/// Mip levels of a picture down to one texel. Each texel is the mean of those that it covers.
fn levels(panorama: &Panorama) -> Vec<Panorama> {
    let mut levels = vec![panorama.clone()];
    while let Some(last) = levels.last().filter(|last| last.width.max(last.height) > 1) {
        let smaller = halved(last);
        levels.push(smaller);
    }
    levels
}

fn halved(picture: &Panorama) -> Panorama {
    let [width, height] = [picture.width, picture.height].map(|side| (side / 2).max(1));
    // If a side has odd length, a smaller texel covers its own share of it.
    let covered = |index: u32, small: u32, large: u32| {
        let (from, to) = (u64::from(index) * u64::from(large), u64::from(index + 1) * u64::from(large));
        (from / u64::from(small)) as usize..to.div_ceil(u64::from(small)) as usize
    };
    let texel = |number: usize| {
        let (column, row) = (number as u32 % width, number as u32 / width);
        let (columns, rows) = (covered(column, width, picture.width), covered(row, height, picture.height));
        let mut sum = [0.0_f32; 3];
        for y in rows.clone() {
            for rgb in &picture.rgb[y * picture.width as usize..][columns.clone()] {
                (0..3).for_each(|channel| sum[channel] += rgb[channel]);
            }
        }
        sum.map(|value| value / (columns.len() * rows.len()) as f32)
    };
    let rgb = (0..width as usize * height as usize).into_par_iter().map(texel).collect();
    Panorama { width, height, rgb }
}
