//! Materials on the GPU: a uniform and two textures for each.

use super::buffer_fill::hand_over;
use crate::gpu::Gpu;
use bytemuck::bytes_of;
use glam::Vec4;
use scene::carriers::{SceneCarriers, WHITE};
use scene::mipmap::smaller_levels;
use scene::{Alpha, Material, Scene, Texture, Wrap};
use wgpu::util::DeviceExt;

/// Number of samples along the longer side of a stretched footprint.
const ANISOTROPY: u16 = 8;
/// Number of samples where the CPU draws. Mesa's software sampler walks the whole bounding box of a footprint. Near
/// the eye, where a triangle is stretched without bound, it may never finish.
const ANISOTROPY_SOFTWARE: u16 = 1;

/// Bind groups of the materials, in the scene's order.
pub struct Materials {
    /// Layout of the bind groups, for the pipelines.
    pub layout: wgpu::BindGroupLayout,
    /// Bind groups by index of the material.
    pub bind_groups: Vec<wgpu::BindGroup>,
}

impl Materials {
    /// Uploads textures with all their mip levels, and the uniforms. Each texture is dropped when it is uploaded.
    pub fn new(gpu: &Gpu, scene: &Scene, textures: Vec<Texture>, spectra: &SceneCarriers) -> Self {
        let layout = layout(gpu);
        let white = Texture {
            name: "white".to_owned(),
            width: 1,
            height: 1,
            rgba: vec![255; 4].into(),
            wrap: [Wrap::Repeat; 2],
            nearest: false,
        };
        let none = textures.len();
        let pictures = textures.into_iter().chain([white]);
        let textures: Vec<_> = pictures.map(|texture| (upload(gpu, &texture), sampler(gpu, &texture))).collect();
        let bind_groups = scene
            .materials
            .iter()
            .zip(&spectra.materials)
            .map(|(material, &carrier)| {
                let texture = |index: Option<usize>| &textures[index.unwrap_or(none)];
                let (base, emissive) = (texture(material.base_colour_texture), texture(material.emissive_texture));
                let carriers = [carrier, WHITE].map(|carrier| (carrier as f32, spectra.factor(carrier)));
                bind(gpu, &layout, material, carriers, base, emissive)
            })
            .collect();
        Self { layout, bind_groups }
    }
}

type Sampled = (wgpu::TextureView, wgpu::Sampler);

fn bind(
    gpu: &Gpu,
    layout: &wgpu::BindGroupLayout,
    material: &Material,
    [surface, emission]: [(f32, f32); 2],
    base: &Sampled,
    emissive: &Sampled,
) -> wgpu::BindGroup {
    let threshold = if let Alpha::Mask(threshold) = material.alpha { threshold } else { 0.0 };
    let [red, green, blue] = material.emissive;
    let uniform = shaders::MaterialUniforms {
        base_colour: Vec4::from_array(material.base_colour),
        emissive: Vec4::new(red, green, blue, threshold),
        carriers: Vec4::new(surface.0, emission.0, surface.1, emission.1),
    };
    let buffer = gpu.device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
        label: Some(&material.name),
        contents: bytes_of(&uniform),
        usage: wgpu::BufferUsages::UNIFORM,
    });
    gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some(&material.name),
        layout,
        entries: &[
            wgpu::BindGroupEntry { binding: 0, resource: buffer.as_entire_binding() },
            wgpu::BindGroupEntry { binding: 1, resource: wgpu::BindingResource::TextureView(&base.0) },
            wgpu::BindGroupEntry { binding: 2, resource: wgpu::BindingResource::Sampler(&base.1) },
            wgpu::BindGroupEntry { binding: 3, resource: wgpu::BindingResource::TextureView(&emissive.0) },
            wgpu::BindGroupEntry { binding: 4, resource: wgpu::BindingResource::Sampler(&emissive.1) },
        ],
    })
}

fn layout(gpu: &Gpu) -> wgpu::BindGroupLayout {
    let entry =
        |binding, ty| wgpu::BindGroupLayoutEntry { binding, visibility: wgpu::ShaderStages::FRAGMENT, ty, count: None };
    let texture = wgpu::BindingType::Texture {
        sample_type: wgpu::TextureSampleType::Float { filterable: true },
        view_dimension: wgpu::TextureViewDimension::D2,
        multisampled: false,
    };
    let sampler = wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering);
    let uniform = wgpu::BindingType::Buffer {
        ty: wgpu::BufferBindingType::Uniform,
        has_dynamic_offset: false,
        min_binding_size: None,
    };
    gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("material"),
        entries: &[entry(0, uniform), entry(1, texture), entry(2, sampler), entry(3, texture), entry(4, sampler)],
    })
}

/// Bytes that are written to the device at a time.
const PIECE: usize = 8 << 20;

fn upload(gpu: &Gpu, texture: &Texture) -> wgpu::TextureView {
    let uploaded = gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some(&texture.name),
        size: wgpu::Extent3d { width: texture.width, height: texture.height, depth_or_array_layers: 1 },
        mip_level_count: texture.width.max(texture.height).ilog2() + 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::Rgba8UnormSrgb,
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    });
    write_level(gpu, &uploaded, 0, texture.width, &texture.rgba);
    for (level, smaller) in (1..).zip(smaller_levels(texture)) {
        write_level(gpu, &uploaded, level, smaller.width, &smaller.rgba);
    }
    uploaded.create_view(&wgpu::TextureViewDescriptor::default())
}

/// Writes a mip level, a few rows at a time: the memory through which they go is freed in between.
fn write_level(gpu: &Gpu, texture: &wgpu::Texture, mip_level: u32, width: u32, rgba: &[u8]) {
    let row = 4 * width as usize;
    let most = (PIECE / row).max(1);
    for (number, rows) in rgba.chunks(most * row).enumerate() {
        let place = wgpu::TexelCopyTextureInfo {
            texture,
            mip_level,
            origin: wgpu::Origin3d { x: 0, y: (number * most) as u32, z: 0 },
            aspect: wgpu::TextureAspect::All,
        };
        let layout = wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(4 * width), rows_per_image: None };
        let height = (rows.len() / row) as u32;
        gpu.queue.write_texture(place, rows, layout, wgpu::Extent3d { width, height, depth_or_array_layers: 1 });
        if rows.len() == most * row {
            hand_over(gpu);
        }
    }
}

fn sampler(gpu: &Gpu, texture: &Texture) -> wgpu::Sampler {
    let mode = |wrap| match wrap {
        Wrap::Repeat => wgpu::AddressMode::Repeat,
        Wrap::Mirror => wgpu::AddressMode::MirrorRepeat,
        Wrap::Clamp => wgpu::AddressMode::ClampToEdge,
    };
    let anisotropy = if gpu.is_software() { ANISOTROPY_SOFTWARE } else { ANISOTROPY };
    let filter = if texture.nearest { wgpu::FilterMode::Nearest } else { wgpu::FilterMode::Linear };
    gpu.device.create_sampler(&wgpu::SamplerDescriptor {
        label: Some(&texture.name),
        address_mode_u: mode(texture.wrap[0]),
        address_mode_v: mode(texture.wrap[1]),
        mag_filter: filter,
        min_filter: filter,
        mipmap_filter: if texture.nearest { wgpu::MipmapFilterMode::Nearest } else { wgpu::MipmapFilterMode::Linear },
        // The driver demands linear filters throughout for an anisotropy above one.
        anisotropy_clamp: if texture.nearest { 1 } else { anisotropy },
        ..Default::default()
    })
}
