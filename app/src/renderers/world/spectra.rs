//! Which spectra a scene's light has, and what the observer makes of them.
//!
//! Every radiance is three weights on a carrier spectrum ([`physics::colour::Carrier`]). An ordinary scene has one carrier, the white
//! whose weights are linear sRGB; each spectrum that a material or the illuminant names adds one. The shift table of all
//! carriers is worked out once, on all cores, and the shaders look it up (B eq. 2.16, 2.17).

use crate::gpu::Gpu;
use crate::scene::Scene;
use physics::colour::{Carrier, ShiftTable};
use wgpu::util::{DeviceExt, TextureDataOrder};

/// The carriers of a scene, each once.
#[derive(Clone, Debug, PartialEq)]
pub struct Spectra {
    /// What weights are on.
    pub carriers: Vec<Carrier>,
    /// One for each material, in the scene's order.
    pub materials: Vec<Carriers>,
    /// Carrier of the sky.
    pub sky: usize,
    /// The carrier whose weights are linear sRGB: of a background and of a panorama.
    pub white: usize,
    /// Luminance that is white at rest, cd/m².
    pub white_luminance: f64,
}

/// A material's carriers, as indices.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Carriers {
    /// Of what it reflects or, unlit, sends out.
    pub surface: usize,
    /// Of what it emits besides.
    pub emission: usize,
}

impl Spectra {
    /// Finds the carriers that a scene needs.
    pub fn of(scene: &Scene) -> Self {
        let mut carriers = vec![Carrier::white()];
        let mut number = |carrier: Carrier| {
            carriers.iter().position(|known| *known == carrier).unwrap_or_else(|| {
                carriers.push(carrier);
                carriers.len() - 1
            })
        };
        let materials = scene
            .materials
            .iter()
            .map(|material| {
                let emission = 0;
                let surface = match &material.spectrum {
                    Some(spectrum) if material.is_source() => number(Carrier::emitted(spectrum.clone())),
                    None if material.unlit => emission,
                    reflectance => number(Carrier::reflected(reflectance.clone(), scene.illuminant.clone())),
                };
                Carriers { surface, emission }
            })
            .collect();
        let sky = number(Carrier::reflected(None, scene.illuminant.clone()));
        Self { carriers, materials, sky, white: 0, white_luminance: scene.white_luminance() }
    }

    /// The shift table for the shaders, with luminances relative to the scene's white.
    pub fn upload(&self, gpu: &Gpu) -> wgpu::TextureView {
        let table = ShiftTable::new(&self.carriers, shaders::SHIFT_NODES as usize);
        let log_white = self.white_luminance.log2() as f32;
        let texels: Vec<[f32; 4]> =
            table.texels().iter().map(|&[r, g, b, log_y]| [r, g, b, log_y - log_white]).collect();
        let descriptor = wgpu::TextureDescriptor {
            label: Some("shift table"),
            size: wgpu::Extent3d {
                width: shaders::SHIFT_NODES,
                height: 3 * self.carriers.len() as u32,
                depth_or_array_layers: 1,
            },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: wgpu::TextureFormat::Rgba32Float,
            usage: wgpu::TextureUsages::TEXTURE_BINDING,
            view_formats: &[],
        };
        let bytes = bytemuck::cast_slice(&texels);
        gpu.device
            .create_texture_with_data(&gpu.queue, &descriptor, TextureDataOrder::LayerMajor, bytes)
            .create_view(&wgpu::TextureViewDescriptor::default())
    }
}
