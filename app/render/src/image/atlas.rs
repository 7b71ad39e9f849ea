//! Textures into which the map's panes are drawn: one layer for each carrier of the scene's light, and one depth
//! texture.

use crate::gpu::Gpu;
use crate::target::{DEPTH_FORMAT, Format, texture};

/// Spare room: 1/SPARE of each side is added, so that a little more speed needs no new texture.
const SPARE: u32 = 8;
/// Factor on the area for the spare room and the gaps between panes.
pub const WITH_SPARE: f64 = 1.3;

/// Textures of a map.
pub struct Atlas {
    size: [u32; 2],
    layers: Vec<wgpu::TextureView>,
    /// View of all layers, for looking up.
    pub all_layers: wgpu::TextureView,
    /// Reversed depth, the same for all layers.
    pub depth: wgpu::TextureView,
    /// True if the depth is looked up, and so must be kept.
    keeps_depth: bool,
}

/// Format of an atlas for pictures of `picture` format: the same precision, one sample a texel.
pub fn format(picture: Format) -> Format {
    Format { samples: 1, ..picture }
}

/// Bytes of a texel in all layers, with its depth.
pub fn texel_bytes(format: Format, layers: u32) -> u64 {
    let bytes = |format: wgpu::TextureFormat| u64::from(format.block_copy_size(None).unwrap_or(4));
    bytes(format.colour) * u64::from(layers) + bytes(DEPTH_FORMAT)
}

impl Atlas {
    /// Makes textures of at least `size` texels. `keeps_depth` is true if the depth is looked up as well.
    pub fn new(gpu: &Gpu, size: [u32; 2], format: Format, layers: u32, keeps_depth: bool) -> Self {
        let limit = gpu.device.limits().max_texture_dimension_2d;
        let size = size.map(|side| (side + side / SPARE).next_multiple_of(64).min(limit));
        let texture_of_layers = gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("map"),
            size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: layers },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: format.colour,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING,
            view_formats: &[],
        });
        let view = |descriptor: wgpu::TextureViewDescriptor<'_>| texture_of_layers.create_view(&descriptor);
        let layer = |base_array_layer| {
            view(wgpu::TextureViewDescriptor {
                dimension: Some(wgpu::TextureViewDimension::D2),
                base_array_layer,
                array_layer_count: Some(1),
                ..Default::default()
            })
        };
        let looked_up = if keeps_depth { wgpu::TextureUsages::TEXTURE_BINDING } else { wgpu::TextureUsages::empty() };
        let depth_usage = wgpu::TextureUsages::RENDER_ATTACHMENT | looked_up;
        Self {
            size,
            layers: (0..layers).map(layer).collect(),
            all_layers: view(wgpu::TextureViewDescriptor {
                dimension: Some(wgpu::TextureViewDimension::D2Array),
                ..Default::default()
            }),
            depth: texture(gpu, "map's depth", size, DEPTH_FORMAT, 1, depth_usage),
            keeps_depth,
        }
    }

    /// Number of texels of a layer.
    pub fn texels(&self) -> u64 {
        u64::from(self.size[0]) * u64::from(self.size[1])
    }

    /// True if the textures have room for `size`, are not far too large, and have this number of layers.
    pub fn holds(&self, size: [u32; 2], layers: u32) -> bool {
        self.layers.len() == layers as usize
            && (0..2).all(|axis| size[axis] <= self.size[axis] && self.size[axis] <= 2 * size[axis].max(64))
    }

    /// Begins drawing the panes of one layer over a cleared texture. The first layer begins with a cleared depth, the
    /// others with the depth of the one before, which is that of the same surfaces.
    pub fn begin<'encoder>(
        &self,
        encoder: &'encoder mut wgpu::CommandEncoder,
        layer: u32,
    ) -> wgpu::RenderPass<'encoder> {
        let last = layer as usize + 1 == self.layers.len();
        let store = if self.keeps_depth || !last { wgpu::StoreOp::Store } else { wgpu::StoreOp::Discard };
        let load = if layer == 0 { wgpu::LoadOp::Clear(0.0) } else { wgpu::LoadOp::Load };
        encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("map"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &self.layers[layer as usize],
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color::BLACK), store: wgpu::StoreOp::Store },
            })],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &self.depth,
                depth_ops: Some(wgpu::Operations { load, store }),
                stencil_ops: None,
            }),
            ..Default::default()
        })
    }
}
