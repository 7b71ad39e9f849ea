//! Parts of a picture that nobody sees, such as the corners of a headset's pictures: no light is worked out for them.

use crate::display::{UNIFORM, contents, group, layout, module, pipeline_layout};
use crate::format::{DEPTH_FORMAT, Format};
use crate::gpu::Gpu;
use bytemuck::{bytes_of, cast_slice};
use glam::Vec4;
use view::Tangents;

/// Parts of a picture that stay black, nearer than everything that is drawn after them. Marks in a picture from
/// outside, which show through what hides them, do here as well.
#[derive(Clone)]
pub struct HiddenArea {
    corners: wgpu::Buffer,
    count: u32,
    picture: wgpu::Buffer,
    group: wgpu::BindGroup,
    pipeline: wgpu::RenderPipeline,
}

impl HiddenArea {
    /// Hidden part of pictures of `format`. `corners` are those of its triangles, three by three: the tangents to the
    /// right and up at which they are seen.
    pub fn new(gpu: &Gpu, format: Format, corners: &[[f32; 2]]) -> Self {
        let shader = &shaders::HIDDEN;
        let group_layout = layout(gpu, shader.name, wgpu::ShaderStages::VERTEX, &[UNIFORM]);
        let usage = wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST;
        let picture = contents(gpu, shader.name, bytes_of(&Vec4::new(0.0, 0.0, 1.0, 1.0)), usage);
        let module = module(gpu, shader);
        let pipeline = gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(shader.name),
            layout: Some(&pipeline_layout(gpu, &group_layout)),
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some("vertex"),
                compilation_options: Default::default(),
                buffers: &[Some(wgpu::VertexBufferLayout {
                    array_stride: size_of::<[f32; 2]>() as u64,
                    step_mode: wgpu::VertexStepMode::Vertex,
                    attributes: &wgpu::vertex_attr_array![0 => Float32x2],
                })],
            },
            primitive: Default::default(),
            depth_stencil: Some(wgpu::DepthStencilState {
                format: DEPTH_FORMAT,
                depth_write_enabled: Some(true),
                depth_compare: Some(wgpu::CompareFunction::Always),
                stencil: Default::default(),
                bias: Default::default(),
            }),
            multisample: wgpu::MultisampleState { count: format.samples, ..Default::default() },
            fragment: Some(wgpu::FragmentState {
                module: &module,
                entry_point: Some("fragment"),
                compilation_options: Default::default(),
                targets: &[Some(format.colour.into())],
            }),
            multiview_mask: None,
            cache: None,
        });
        Self {
            corners: contents(gpu, shader.name, cast_slice(corners), wgpu::BufferUsages::VERTEX),
            count: corners.len() as u32,
            group: group(gpu, shader.name, &group_layout, &[picture.as_entire_binding()]),
            picture,
            pipeline,
        }
    }

    /// Sets what the next pictures show.
    pub fn place(&self, gpu: &Gpu, tangents: &Tangents) {
        let (middle, half) = (tangents.middle().as_vec2(), tangents.half().as_vec2());
        gpu.queue.write_buffer(&self.picture, 0, bytes_of(&Vec4::new(middle.x, middle.y, half.x, half.y)));
    }

    /// Hides the part in a pass that has just begun.
    pub fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &self.group, &[]);
        pass.set_vertex_buffer(0, self.corners.slice(..));
        pass.draw(0..self.count, 0..1);
    }
}
