//! Whether a device fills both layers of a target in one pass.

use render::Gpu;
use render::display::Pass;
use studio::{SCREEN_FORMAT, Sheet};

/// Side of the target on which a device is tried, pixels.
const SIDE: u32 = 4;

/// True if the device tells the two views of a pass apart, each in its layer: it is tried, since there are drivers that
/// say so and draw both into one.
pub fn draws_views(gpu: &Gpu) -> bool {
    if !gpu.device.features().contains(wgpu::Features::MULTIVIEW) || gpu.device.limits().max_multiview_view_count < 2 {
        return false;
    }
    let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("views"),
        size: wgpu::Extent3d { width: SIDE, height: SIDE, depth_or_array_layers: 2 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: SCREEN_FORMAT,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
        view_formats: &[],
    });
    let both = texture.create_view(&wgpu::TextureViewDescriptor::default());
    let pass = Pass::of_views(gpu, &shaders::VIEW_NUMBER, &[], &[], SCREEN_FORMAT);
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    pass.draw(gpu, &mut encoder, &both, &[]);
    gpu.queue.submit([encoder.finish()]);
    let sheet = Sheet::new(gpu, [SIDE; 2], SCREEN_FORMAT);
    [[0, 255, 0, 255], [255, 0, 0, 255]].iter().zip(0..).all(|(colour, layer)| {
        let encoder = gpu.device.create_command_encoder(&Default::default());
        let pixels = sheet.fetch_from(gpu, encoder, &texture, layer);
        pixels.is_ok_and(|pixels| pixels.chunks_exact(4).all(|pixel| pixel == colour))
    })
}
