//! The shift table on the device: three weights on each carrier, shifted by every Doppler factor.

use crate::gpu::Gpu;
use crate::textures::view_from_rows;
use physics::colour::ShiftTable;
use scene::carriers::SceneCarriers;

/// The shift table of all carriers, for the shaders: of weights relative to white.
pub fn upload(gpu: &Gpu, spectra: &SceneCarriers) -> wgpu::TextureView {
    let table = ShiftTable::new(&spectra.carriers, shaders::SHIFT_NODES as usize);
    let rows_of_a_carrier = 3 * shaders::SHIFT_NODES as usize;
    let carriers = table.texels().chunks_exact(rows_of_a_carrier).zip(spectra.luminances());
    let texels: Vec<[f32; 4]> = carriers
        .flat_map(|(texels, luminance)| {
            let log = luminance.log2() as f32;
            texels.iter().map(move |&[red, green, blue, log_y]| [red, green, blue, log_y - log])
        })
        .collect();
    let size = [shaders::SHIFT_NODES, 3 * spectra.carriers.len() as u32, 1];
    view_from_rows(gpu, "shift table", size, wgpu::TextureFormat::Rgba32Float, bytemuck::cast_slice(&texels))
}
