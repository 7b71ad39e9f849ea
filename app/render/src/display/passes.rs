//! Building blocks of the passes: bindings numbered in order, a shader module, one full-screen triangle.

use crate::gpu::Gpu;
use std::num::NonZeroU32;
use wgpu::util::DeviceExt;

/// Binding of a texture that is read texel by texel.
pub const UNFILTERED: wgpu::BindingType = wgpu::BindingType::Texture {
    sample_type: wgpu::TextureSampleType::Float { filterable: false },
    view_dimension: wgpu::TextureViewDimension::D2,
    multisampled: false,
};
/// Binding of a texture that is sampled.
pub const FILTERED: wgpu::BindingType = wgpu::BindingType::Texture {
    sample_type: wgpu::TextureSampleType::Float { filterable: true },
    view_dimension: wgpu::TextureViewDimension::D2,
    multisampled: false,
};
/// Binding of a uniform buffer.
pub const UNIFORM: wgpu::BindingType = buffer(wgpu::BufferBindingType::Uniform);
/// Binding of a storage buffer that is read.
pub const READ: wgpu::BindingType = buffer(wgpu::BufferBindingType::Storage { read_only: true });
/// Binding of a storage buffer that is read and written.
pub const WRITE: wgpu::BindingType = buffer(wgpu::BufferBindingType::Storage { read_only: false });

const fn buffer(ty: wgpu::BufferBindingType) -> wgpu::BindingType {
    wgpu::BindingType::Buffer { ty, has_dynamic_offset: false, min_binding_size: None }
}

/// A shader module with the pipeline that fills a whole target.
pub struct Pass {
    name: &'static str,
    layout: wgpu::BindGroupLayout,
    pipeline: wgpu::RenderPipeline,
    /// Layers of the target that are filled at once, a bit each; `None` for a target without layers.
    views: Option<NonZeroU32>,
}

/// Both layers of a target for two eyes.
const TWO_VIEWS: NonZeroU32 = NonZeroU32::new(0b11).expect("it has two bits");

impl Pass {
    /// Compiles `shader` with these override values. `bindings` are numbered in order.
    pub fn new(
        gpu: &Gpu,
        shader: &shaders::Module,
        overrides: &[(&str, f64)],
        bindings: &[wgpu::BindingType],
        target: wgpu::TextureFormat,
    ) -> Self {
        Self::compile(gpu, shader, overrides, bindings, (target, None, None))
    }

    /// The same, which fills the two layers of a target at once. Only for a device that
    /// draws views.
    pub fn of_views(
        gpu: &Gpu,
        shader: &shaders::Module,
        overrides: &[(&str, f64)],
        bindings: &[wgpu::BindingType],
        target: wgpu::TextureFormat,
    ) -> Self {
        Self::compile(gpu, shader, overrides, bindings, (target, None, Some(TWO_VIEWS)))
    }

    /// The same, whose pixels are laid over those of the target by their opacity, with which they are multiplied.
    pub fn over(
        gpu: &Gpu,
        shader: &shaders::Module,
        overrides: &[(&str, f64)],
        bindings: &[wgpu::BindingType],
        target: wgpu::TextureFormat,
    ) -> Self {
        let blend = wgpu::BlendState::PREMULTIPLIED_ALPHA_BLENDING;
        Self::compile(gpu, shader, overrides, bindings, (target, Some(blend), None))
    }

    fn compile(
        gpu: &Gpu,
        shader: &shaders::Module,
        overrides: &[(&str, f64)],
        bindings: &[wgpu::BindingType],
        (target, blend, views): (wgpu::TextureFormat, Option<wgpu::BlendState>, Option<NonZeroU32>),
    ) -> Self {
        let device = &gpu.device;
        let layout = layout(gpu, shader.name, wgpu::ShaderStages::FRAGMENT, bindings);
        let module = module(gpu, shader);
        let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(shader.name),
            layout: Some(&pipeline_layout(gpu, &layout)),
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some("vertex"),
                compilation_options: Default::default(),
                buffers: &[],
            },
            primitive: Default::default(),
            depth_stencil: None,
            multisample: Default::default(),
            fragment: Some(wgpu::FragmentState {
                module: &module,
                entry_point: Some("fragment"),
                compilation_options: wgpu::PipelineCompilationOptions { constants: overrides, ..Default::default() },
                targets: &[Some(wgpu::ColorTargetState { format: target, blend, write_mask: wgpu::ColorWrites::ALL })],
            }),
            multiview_mask: views,
            cache: None,
        });
        Self { name: shader.name, layout, pipeline, views }
    }

    /// Fills `target` from the bound resources.
    pub fn draw(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        target: &wgpu::TextureView,
        resources: &[wgpu::BindingResource<'_>],
    ) {
        let size = target.texture().size();
        self.draw_part(gpu, encoder, target, resources, [0, 0, size.width, size.height], false);
    }

    /// Fills a part of `target`: x, y, width and height in pixels. If `over` is true, pixels that are not written
    /// keep their values.
    pub fn draw_part(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        target: &wgpu::TextureView,
        resources: &[wgpu::BindingResource<'_>],
        part: [u32; 4],
        over: bool,
    ) {
        self.draw_within(gpu, encoder, target, resources, (part, part), over);
    }

    /// Fills a part of `target`, but only the pixels of a smaller rectangle in it. Each rectangle is x, y, width and
    /// height in pixels.
    pub fn draw_within(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        target: &wgpu::TextureView,
        resources: &[wgpu::BindingResource<'_>],
        (part, within): ([u32; 4], [u32; 4]),
        over: bool,
    ) {
        let group = group(gpu, self.name, &self.layout, resources);
        let transparent = wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT);
        let mut pass = begin(encoder, target, if over { wgpu::LoadOp::Load } else { transparent }, self.views);
        let [x, y, width, height] = part.map(|pixels| pixels as f32);
        pass.set_viewport(x, y, width, height, 0.0, 1.0);
        let [x, y, width, height] = within;
        pass.set_scissor_rect(x, y, width, height);
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &group, &[]);
        pass.draw(0..3, 0..1);
    }
}

/// Begins drawing over a cleared target.
pub fn clear<'encoder>(
    encoder: &'encoder mut wgpu::CommandEncoder,
    target: &wgpu::TextureView,
) -> wgpu::RenderPass<'encoder> {
    begin(encoder, target, wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT), None)
}

/// Begins drawing over what a target holds.
pub fn over<'encoder>(
    encoder: &'encoder mut wgpu::CommandEncoder,
    target: &wgpu::TextureView,
) -> wgpu::RenderPass<'encoder> {
    begin(encoder, target, wgpu::LoadOp::Load, None)
}

fn begin<'encoder>(
    encoder: &'encoder mut wgpu::CommandEncoder,
    target: &wgpu::TextureView,
    load: wgpu::LoadOp<wgpu::Color>,
    multiview_mask: Option<NonZeroU32>,
) -> wgpu::RenderPass<'encoder> {
    encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some("display"),
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view: target,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations { load, store: wgpu::StoreOp::Store },
        })],
        multiview_mask,
        ..Default::default()
    })
}

/// Compiles a shader module.
pub fn module(gpu: &Gpu, shader: &shaders::Module) -> wgpu::ShaderModule {
    gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some(shader.name),
        source: wgpu::ShaderSource::Wgsl(shader.source().into()),
    })
}

/// Layout of a bind group whose bindings are numbered in order.
pub fn layout(
    gpu: &Gpu,
    name: &str,
    visibility: wgpu::ShaderStages,
    bindings: &[wgpu::BindingType],
) -> wgpu::BindGroupLayout {
    let entries: Vec<_> = (0..)
        .zip(bindings)
        .map(|(binding, &ty)| wgpu::BindGroupLayoutEntry { binding, visibility, ty, count: None })
        .collect();
    gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some(name), entries: &entries })
}

/// Pipeline layout with one bind group.
pub fn pipeline_layout(gpu: &Gpu, layout: &wgpu::BindGroupLayout) -> wgpu::PipelineLayout {
    gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some("display"),
        bind_group_layouts: &[Some(layout)],
        ..Default::default()
    })
}

/// Bind group whose resources are numbered in order.
pub fn group(
    gpu: &Gpu,
    name: &str,
    layout: &wgpu::BindGroupLayout,
    resources: &[wgpu::BindingResource<'_>],
) -> wgpu::BindGroup {
    let entries: Vec<_> = (0..)
        .zip(resources)
        .map(|(binding, resource)| wgpu::BindGroupEntry { binding, resource: resource.clone() })
        .collect();
    gpu.device.create_bind_group(&wgpu::BindGroupDescriptor { label: Some(name), layout, entries: &entries })
}

/// Buffer with these contents, for one frame.
pub fn contents(gpu: &Gpu, label: &str, contents: &[u8], usage: wgpu::BufferUsages) -> wgpu::Buffer {
    gpu.device.create_buffer_init(&wgpu::util::BufferInitDescriptor { label: Some(label), contents, usage })
}
