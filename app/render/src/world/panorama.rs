//! Upload of the panorama, the picture of all directions around the scene.
//!
//! The largest panoramas have 134 million pixels, so they go to the device a few rows at a time, and only one of the
//! smaller copies is held beside the picture.

use crate::gpu::Gpu;
use half::f16;
use rayon::prelude::*;
use scene::Panorama;

/// Bytes that are handed to the device at a time.
const BAND_BYTES: usize = 32 << 20;

/// Texture of a panorama with all its mip levels; one black texel if the scene has none.
pub fn upload(gpu: &Gpu, panorama: Option<&Panorama>) -> (wgpu::TextureView, wgpu::Sampler) {
    let none = Panorama::new(1, 1, [[0.0; 3]]);
    let panorama = panorama.unwrap_or(&none);
    let descriptor = wgpu::TextureDescriptor {
        label: Some("panorama"),
        size: wgpu::Extent3d { width: panorama.width, height: panorama.height, depth_or_array_layers: 1 },
        mip_level_count: panorama.width.max(panorama.height).ilog2() + 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::Rgba16Float,
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    };
    let texture = gpu.device.create_texture(&descriptor);
    let size = [panorama.width, panorama.height];
    write(gpu, &texture, 0, size, &panorama.rgb, |rgb| rgb.map(f16::to_f32));
    let mut smaller = halved(size, &panorama.rgb, |rgb| rgb.map(f16::to_f32));
    for level in 1..descriptor.mip_level_count {
        write(gpu, &texture, level, smaller.size, &smaller.rgb, |rgb| *rgb);
        smaller = halved(smaller.size, &smaller.rgb, |rgb| *rgb);
    }
    let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
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

/// Writes a mip level, some rows at a time.
fn write<T: Sync>(
    gpu: &Gpu,
    texture: &wgpu::Texture,
    level: u32,
    [width, height]: [u32; 2],
    pixels: &[T],
    rgb: impl Fn(&T) -> [f32; 3] + Sync,
) {
    let bytes_per_row = width as usize * size_of::<[f16; 4]>();
    let rows = (BAND_BYTES / bytes_per_row).clamp(1, height as usize);
    for (first, pixels) in (0..).step_by(rows).zip(pixels.chunks(rows * width as usize)) {
        let texels: Vec<[f16; 4]> = pixels.par_iter().map(|pixel| texel(rgb(pixel))).collect();
        let target = wgpu::TexelCopyTextureInfo {
            texture,
            mip_level: level,
            origin: wgpu::Origin3d { x: 0, y: first, z: 0 },
            aspect: wgpu::TextureAspect::All,
        };
        let layout =
            wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(bytes_per_row as u32), rows_per_image: None };
        let extent = wgpu::Extent3d { width, height: (pixels.len() / width as usize) as u32, depth_or_array_layers: 1 };
        gpu.queue.write_texture(target, bytemuck::cast_slice(&texels), layout, extent);
        if rows < height as usize {
            // Without this, the copies of all bands would be kept until the first frame. A lost device is met there.
            gpu.queue.submit([]);
            let _ = gpu.device.poll(wgpu::PollType::wait_indefinitely());
        }
    }
}

fn texel(rgb: [f32; 3]) -> [f16; 4] {
    let [red, green, blue] = rgb.map(|value| f16::from_f32(value.clamp(0.0, shaders::HALF_LIMIT)));
    [red, green, blue, f16::ONE]
}

/// Copy of a picture at half its size. It keeps more digits than the texture, so that errors do not pile up.
struct HalvedPicture {
    size: [u32; 2],
    rgb: Vec<[f32; 3]>,
}

/// Picture of half the width and height, at least 1. Each texel is the mean of those that it covers.
fn halved<T: Sync>(size: [u32; 2], pixels: &[T], rgb: impl Fn(&T) -> [f32; 3] + Sync) -> HalvedPicture {
    let [width, height] = size.map(|side| (side / 2).max(1));
    // If a side has odd length, a smaller texel covers its own share of it.
    let covered = |index: u32, small: u32, large: u32| {
        let (from, to) = (u64::from(index) * u64::from(large), u64::from(index + 1) * u64::from(large));
        (from / u64::from(small)) as usize..to.div_ceil(u64::from(small)) as usize
    };
    let texel = |number: usize| {
        let (column, row) = (number as u32 % width, number as u32 / width);
        let (columns, rows) = (covered(column, width, size[0]), covered(row, height, size[1]));
        let mut sum = [0.0_f32; 3];
        for y in rows.clone() {
            for pixel in &pixels[y * size[0] as usize..][columns.clone()] {
                let rgb = rgb(pixel);
                (0..3).for_each(|channel| sum[channel] += rgb[channel]);
            }
        }
        sum.map(|value| value / (columns.len() * rows.len()) as f32)
    };
    let rgb = (0..width as usize * height as usize).into_par_iter().map(texel).collect();
    HalvedPicture { size: [width, height], rgb }
}
