//! Targets of the renderers: linear radiance with depth.

pub use crate::format::{DEPTH_FORMAT, Format};
use crate::gpu::Gpu;
use crate::hidden_area::HiddenArea;

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
        // What has one sample a pixel may be copied into a larger picture.
        let copied = |samples| if samples > 1 { usage } else { usage | wgpu::TextureUsages::COPY_SRC };
        let attachment = |label, format, samples| texture(gpu, label, size, format, samples, copied(samples));
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
    pub fn depth(&self) -> &wgpu::TextureView {
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
