//! Targets of the renderers: linear radiance with depth.

use crate::gpu::Gpu;
use crate::hidden_area::HiddenArea;

/// Depth format. Depth is reversed: 1 at the near plane, 0 at infinity.
pub const DEPTH_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

/// Format of a target. A pipeline can draw only into targets of its own format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Format {
    /// Texture format of the radiance.
    pub colour: wgpu::TextureFormat,
    /// Samples per pixel, 1 or 4.
    pub samples: u32,
}

impl Format {
    /// Format for pictures that are kept: every value exact to f32, if the device can blend such values.
    pub fn exact(gpu: &Gpu) -> Self {
        let colour =
            if gpu.has_full_precision() { wgpu::TextureFormat::Rgba32Float } else { wgpu::TextureFormat::Rgba16Float };
        Self { colour, samples: 1 }
    }

    /// True if every value is exact to f32.
    pub fn is_exact(self) -> bool {
        self.colour == wgpu::TextureFormat::Rgba32Float
    }

    /// Largest value that every channel can hold.
    pub fn largest(self) -> f32 {
        if self.is_exact() { f32::MAX } else { shaders::HALF_LIMIT }
    }

    /// Format for windows: half the memory traffic, edges smoothed by the hardware.
    pub fn fast(samples: u32) -> Self {
        Self { colour: wgpu::TextureFormat::Rgba16Float, samples }
    }
}

/// A colour and a depth texture of one size; with several samples a pixel, also the texture into which they are
/// resolved.
pub struct Radiance {
    /// Width and height, pixels.
    pub size: [u32; 2],
    /// Format with which the textures were made.
    pub format: Format,
    /// True if the depth of what is drawn is kept.
    pub keeps_depth: bool,
    /// Part of the picture that nobody sees.
    pub hidden: Option<HiddenArea>,
    colour: wgpu::TextureView,
    depth: wgpu::TextureView,
    resolved: Option<wgpu::TextureView>,
}

impl Radiance {
    /// Makes the textures.
    pub fn new(gpu: &Gpu, size: [u32; 2], format: Format) -> Self {
        let usage = wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING;
        let attachment = |label, format, samples| texture(gpu, label, size, format, samples, usage);
        Self {
            size,
            format,
            keeps_depth: false,
            hidden: None,
            colour: attachment("radiance", format.colour, format.samples),
            depth: attachment("depth", DEPTH_FORMAT, format.samples),
            resolved: (format.samples > 1).then(|| attachment("resolved radiance", format.colour, 1)),
        }
    }

    /// The same in another size.
    #[must_use]
    pub fn resized(&self, gpu: &Gpu, size: [u32; 2]) -> Self {
        let hidden = self.hidden.clone();
        Self { keeps_depth: self.keeps_depth, hidden, ..Self::new(gpu, size, self.format) }
    }

    /// Depth of what was drawn, if it is kept.
    pub(crate) fn depth(&self) -> &wgpu::TextureView {
        &self.depth
    }

    /// Radiance to read, one sample a pixel.
    pub fn result(&self) -> &wgpu::TextureView {
        self.resolved.as_ref().unwrap_or(&self.colour)
    }

    /// Begins drawing over a cleared target.
    pub fn begin<'encoder>(&self, encoder: &'encoder mut wgpu::CommandEncoder) -> wgpu::RenderPass<'encoder> {
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("radiance"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &self.colour,
                depth_slice: None,
                resolve_target: self.resolved.as_ref(),
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Clear(wgpu::Color::BLACK),
                    store: if self.resolved.is_some() { wgpu::StoreOp::Discard } else { wgpu::StoreOp::Store },
                },
            })],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &self.depth,
                depth_ops: Some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(0.0),
                    store: if self.keeps_depth { wgpu::StoreOp::Store } else { wgpu::StoreOp::Discard },
                }),
                stencil_ops: None,
            }),
            ..Default::default()
        });
        if let Some(hidden) = &self.hidden {
            hidden.draw(&mut pass);
        }
        pass
    }
}

/// A two-dimensional texture without mip levels, as a view.
pub fn texture(
    gpu: &Gpu,
    label: &str,
    size: [u32; 2],
    format: wgpu::TextureFormat,
    samples: u32,
    usage: wgpu::TextureUsages,
) -> wgpu::TextureView {
    let descriptor = wgpu::TextureDescriptor {
        label: Some(label),
        size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: samples,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage,
        view_formats: &[],
    };
    gpu.device.create_texture(&descriptor).create_view(&wgpu::TextureViewDescriptor::default())
}
