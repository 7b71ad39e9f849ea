//! Marks of the observer on the device.

use super::outline::{MarkCorner, outline};
use crate::gpu::Gpu;
use crate::target::{DEPTH_FORMAT, Format};
use glam::DMat4;
use std::mem::size_of;
use view::OutsideCamera;

/// Share of their colours that marks have where the scene hides them.
const HIDDEN_SHARE: f64 = 0.3;

/// Marks of one picture from outside, with the pipelines that draw them over the scene: in full where nothing hides
/// them, and faintly through it.
pub struct Marks {
    module: wgpu::ShaderModule,
    pipelines: Vec<(Format, MarkPipelines)>,
    corners: wgpu::Buffer,
    count: u32,
}

/// Pipelines for marks in one format.
struct MarkPipelines {
    hidden: wgpu::RenderPipeline,
    shown: wgpu::RenderPipeline,
}

impl Marks {
    /// Marks without content.
    pub fn new(gpu: &Gpu) -> Self {
        let module = gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(shaders::MARKS.name),
            source: wgpu::ShaderSource::Wgsl(shaders::MARKS.source().into()),
        });
        Self { module, pipelines: Vec::new(), corners: buffer(gpu, 1), count: 0 }
    }

    /// Writes the marks of the next picture, of `size` pixels in a target of this format. `clip_from_observer`: of the
    /// camera outside, for places relative to the eye. `scale`: factor of radiance.
    pub fn prepare(
        &mut self,
        gpu: &Gpu,
        (size, format): ([u32; 2], Format),
        outside: &OutsideCamera,
        clip_from_observer: &DMat4,
        scale: f64,
    ) {
        if !self.pipelines.iter().any(|(made, _)| *made == format) {
            let pipelines =
                MarkPipelines { hidden: self.pipeline(gpu, format, true), shown: self.pipeline(gpu, format, false) };
            self.pipelines.push((format, pipelines));
        }
        let corners = outline(outside, size, clip_from_observer, scale);
        let bytes: &[u8] = bytemuck::cast_slice(&corners);
        if bytes.len() as u64 > self.corners.size() {
            self.corners = buffer(gpu, bytes.len() as u64);
        }
        gpu.queue.write_buffer(&self.corners, 0, bytes);
        self.count = corners.len() as u32;
    }

    /// Draws the marks that were prepared last.
    pub fn draw(&self, pass: &mut wgpu::RenderPass<'_>, format: Format) {
        let Some((_, pipelines)) = self.pipelines.iter().find(|(made, _)| *made == format) else { return };
        pass.set_vertex_buffer(0, self.corners.slice(..));
        let share = HIDDEN_SHARE;
        pass.set_blend_constant(wgpu::Color { r: share, g: share, b: share, a: share });
        for pipeline in [&pipelines.hidden, &pipelines.shown] {
            pass.set_pipeline(pipeline);
            pass.draw(0..self.count, 0..1);
        }
    }

    fn pipeline(&self, gpu: &Gpu, format: Format, hidden: bool) -> wgpu::RenderPipeline {
        let mixed = wgpu::BlendComponent {
            src_factor: wgpu::BlendFactor::Constant,
            dst_factor: wgpu::BlendFactor::OneMinusConstant,
            operation: wgpu::BlendOperation::Add,
        };
        let attributes = wgpu::vertex_attr_array![0 => Float32x4, 1 => Float32x4];
        gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some("marks"),
            layout: None,
            vertex: wgpu::VertexState {
                module: &self.module,
                entry_point: Some("vertex"),
                compilation_options: Default::default(),
                buffers: &[Some(wgpu::VertexBufferLayout {
                    array_stride: size_of::<MarkCorner>() as u64,
                    step_mode: wgpu::VertexStepMode::Vertex,
                    attributes: &attributes,
                })],
            },
            primitive: Default::default(),
            depth_stencil: Some(wgpu::DepthStencilState {
                format: DEPTH_FORMAT,
                depth_write_enabled: Some(!hidden),
                depth_compare: Some(if hidden { wgpu::CompareFunction::Less } else { wgpu::CompareFunction::Greater }),
                stencil: Default::default(),
                bias: Default::default(),
            }),
            multisample: wgpu::MultisampleState { count: format.samples, ..Default::default() },
            fragment: Some(wgpu::FragmentState {
                module: &self.module,
                entry_point: Some("fragment"),
                compilation_options: Default::default(),
                targets: &[Some(wgpu::ColorTargetState {
                    format: format.colour,
                    blend: hidden.then_some(wgpu::BlendState { color: mixed, alpha: mixed }),
                    write_mask: wgpu::ColorWrites::ALL,
                })],
            }),
            multiview_mask: None,
            cache: None,
        })
    }
}

fn buffer(gpu: &Gpu, bytes: u64) -> wgpu::Buffer {
    gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("marks"),
        size: bytes,
        usage: wgpu::BufferUsages::VERTEX | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    })
}
