//! Depth of a picture, handed on to whoever turns or moves the picture afterwards.

use bytemuck::bytes_of;
use glam::Vec4;
use render::Gpu;
use render::display::{UNIFORM, contents, group, layout, module, pipeline_layout};
use render::target::{DEPTH_FORMAT, Radiance};

/// Pass that writes the depth of a picture that was drawn into a target which keeps it.
pub struct SceneDepth {
    /// Pipelines for targets with one sample a pixel, and with several.
    kinds: [(wgpu::BindGroupLayout, wgpu::RenderPipeline); 2],
}

impl SceneDepth {
    /// Compiles the pass.
    pub fn new(gpu: &Gpu) -> Self {
        Self { kinds: [kind(gpu, false), kind(gpu, true)] }
    }

    /// Fills `depth`, of any size: reversed depth, 1 at `near_m` before the eye and 0 at infinity. `drawn_near_m` is
    /// the near plane with which the target was drawn.
    pub fn draw(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        target: &Radiance,
        depth: &wgpu::TextureView,
        (drawn_near_m, near_m): (f64, f64),
    ) {
        let (layout, pipeline) = &self.kinds[usize::from(target.format.samples > 1)];
        let size = depth.texture().size();
        let texels = [size.width, size.height].map(f64::from);
        let scale = [0, 1].map(|axis| f64::from(target.size[axis]) / texels[axis]);
        let uniform = Vec4::new(scale[0] as f32, scale[1] as f32, (near_m / drawn_near_m) as f32, 0.0);
        let uniform = contents(gpu, "scene depth", bytes_of(&uniform), wgpu::BufferUsages::UNIFORM);
        let resources = [uniform.as_entire_binding(), wgpu::BindingResource::TextureView(target.depth())];
        let group = group(gpu, "scene depth", layout, &resources);
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("scene depth"),
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: depth,
                depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(0.0), store: wgpu::StoreOp::Store }),
                stencil_ops: None,
            }),
            ..Default::default()
        });
        pass.set_pipeline(pipeline);
        pass.set_bind_group(0, &group, &[]);
        pass.draw(0..3, 0..1);
    }
}

fn kind(gpu: &Gpu, multisampled: bool) -> (wgpu::BindGroupLayout, wgpu::RenderPipeline) {
    let depth = wgpu::BindingType::Texture {
        sample_type: wgpu::TextureSampleType::Depth,
        view_dimension: wgpu::TextureViewDimension::D2,
        multisampled,
    };
    let shader = &shaders::SCENE_DEPTH;
    let group_layout = layout(gpu, shader.name, wgpu::ShaderStages::FRAGMENT, &[UNIFORM, depth]);
    let module = module(gpu, shader);
    let pipeline = gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(shader.name),
        layout: Some(&pipeline_layout(gpu, &group_layout)),
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some("vertex"),
            compilation_options: Default::default(),
            buffers: &[],
        },
        primitive: Default::default(),
        depth_stencil: Some(wgpu::DepthStencilState {
            format: DEPTH_FORMAT,
            depth_write_enabled: Some(true),
            depth_compare: Some(wgpu::CompareFunction::Always),
            stencil: Default::default(),
            bias: Default::default(),
        }),
        multisample: Default::default(),
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: Some(if multisampled { "fragment_many" } else { "fragment" }),
            compilation_options: Default::default(),
            targets: &[],
        }),
        multiview_mask: None,
        cache: None,
    });
    (group_layout, pipeline)
}
