//! From radiance to pixels: the mean of several samples, then the screen's curve.

use super::target::{Radiance, texture};
use crate::gpu::Gpu;
use bytemuck::bytes_of;
use wgpu::util::DeviceExt;

/// Passes that read one radiance texture and write one target.
pub struct Resolver {
    layout: wgpu::BindGroupLayout,
    accumulate: wgpu::RenderPipeline,
    display: wgpu::RenderPipeline,
    nothing: wgpu::TextureView,
    encode: f32,
    sum_format: wgpu::TextureFormat,
}

/// Sums of samples, each with the number of samples as its weight's inverse.
pub struct Accumulator {
    sums: [wgpu::TextureView; 2],
    current: usize,
    filled: bool,
}

impl Resolver {
    /// Passes that sum in `radiance` format and show in `screen` format (an sRGB format encodes by itself).
    pub fn new(gpu: &Gpu, radiance: wgpu::TextureFormat, screen: wgpu::TextureFormat) -> Self {
        let device = &gpu.device;
        let texture_entry = |binding| wgpu::BindGroupLayoutEntry {
            binding,
            visibility: wgpu::ShaderStages::FRAGMENT,
            ty: wgpu::BindingType::Texture {
                sample_type: wgpu::TextureSampleType::Float { filterable: false },
                view_dimension: wgpu::TextureViewDimension::D2,
                multisampled: false,
            },
            count: None,
        };
        let uniform = wgpu::BindGroupLayoutEntry {
            binding: 2,
            visibility: wgpu::ShaderStages::FRAGMENT,
            ty: wgpu::BindingType::Buffer {
                ty: wgpu::BufferBindingType::Uniform,
                has_dynamic_offset: false,
                min_binding_size: None,
            },
            count: None,
        };
        let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("resolve"),
            entries: &[texture_entry(0), texture_entry(1), uniform],
        });
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(shaders::RESOLVE.name),
            source: wgpu::ShaderSource::Wgsl(shaders::RESOLVE.source().into()),
        });
        let pipeline_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("resolve"),
            bind_group_layouts: &[Some(&layout)],
            ..Default::default()
        });
        let pipeline = |entry_point, format| {
            device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
                label: Some(entry_point),
                layout: Some(&pipeline_layout),
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
                    entry_point: Some(entry_point),
                    compilation_options: Default::default(),
                    targets: &[Some(wgpu::ColorTargetState {
                        format,
                        blend: None,
                        write_mask: wgpu::ColorWrites::ALL,
                    })],
                }),
                multiview_mask: None,
                cache: None,
            })
        };
        let nothing = texture(gpu, "nothing", [1, 1], radiance, 1, wgpu::TextureUsages::TEXTURE_BINDING);
        Self {
            accumulate: pipeline("accumulate", radiance),
            display: pipeline("display", screen),
            layout,
            nothing,
            encode: if screen.is_srgb() { 0.0 } else { 1.0 },
            sum_format: radiance,
        }
    }

    /// Room for the sum of several samples.
    pub fn accumulator(&self, gpu: &Gpu, size: [u32; 2]) -> Accumulator {
        let usage = wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING;
        let sum = || texture(gpu, "sum", size, self.sum_format, 1, usage);
        Accumulator { sums: [sum(), sum()], current: 0, filled: false }
    }

    /// Adds one sample, out of `count`.
    pub fn add(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        sum: &mut Accumulator,
        sample: &Radiance,
        count: u32,
    ) {
        // The very first sum is over zeros: loads outside a 1 × 1 texture must not be relied on, so clear instead.
        if !sum.filled {
            self.pass(encoder, &sum.sums[sum.current], None);
            sum.filled = true;
        }
        let bind = self.bind(gpu, sample.result(), &sum.sums[sum.current], 1.0 / count as f32);
        sum.current = 1 - sum.current;
        self.pass(encoder, &sum.sums[sum.current], Some((&self.accumulate, &bind)));
    }

    /// Writes `radiance` to the screen.
    pub fn show(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        radiance: &wgpu::TextureView,
        screen: &wgpu::TextureView,
    ) {
        let bind = self.bind(gpu, radiance, &self.nothing, 1.0);
        self.pass(encoder, screen, Some((&self.display, &bind)));
    }

    fn bind(&self, gpu: &Gpu, radiance: &wgpu::TextureView, sum: &wgpu::TextureView, weight: f32) -> wgpu::BindGroup {
        let uniform = shaders::Resolve { weight, encode: self.encode, padding: [0.0; 2] };
        let buffer = gpu.device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some("resolve"),
            contents: bytes_of(&uniform),
            usage: wgpu::BufferUsages::UNIFORM,
        });
        gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("resolve"),
            layout: &self.layout,
            entries: &[
                wgpu::BindGroupEntry { binding: 0, resource: wgpu::BindingResource::TextureView(radiance) },
                wgpu::BindGroupEntry { binding: 1, resource: wgpu::BindingResource::TextureView(sum) },
                wgpu::BindGroupEntry { binding: 2, resource: buffer.as_entire_binding() },
            ],
        })
    }

    /// One full-screen pass over a cleared target.
    fn pass(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        target: &wgpu::TextureView,
        draw: Option<(&wgpu::RenderPipeline, &wgpu::BindGroup)>,
    ) {
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("resolve"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: target,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT),
                    store: wgpu::StoreOp::Store,
                },
            })],
            ..Default::default()
        });
        if let Some((pipeline, bind)) = draw {
            pass.set_pipeline(pipeline);
            pass.set_bind_group(0, bind, &[]);
            pass.draw(0..3, 0..1);
        }
    }
}

impl Accumulator {
    /// The sum of all samples added so far.
    pub fn result(&self) -> &wgpu::TextureView {
        &self.sums[self.current]
    }

    /// Forgets the samples, for the next picture.
    pub fn restart(&mut self) {
        self.filled = false;
    }
}
