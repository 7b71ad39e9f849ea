//! The fixed part of each draw: which shader, which vertex streams, which depth test.

use super::geometry::Attributes;
use super::materials::Materials;
use crate::gpu::Gpu;
use crate::renderers::target::{DEPTH_FORMAT, Format};
use crate::scene::{Alpha, Material, Scene};
use std::mem::{offset_of, size_of};

/// Every pipeline of the polygon renderer.
pub struct Pipelines {
    /// One for each material, in the scene's order; those that look alike share one.
    pub surface: Vec<wgpu::RenderPipeline>,
    /// Behind everything.
    pub sky: wgpu::RenderPipeline,
    /// The sun's depth map.
    pub shadow: wgpu::RenderPipeline,
    /// Group 0 of `surface` and `sky`.
    pub view_layout: wgpu::BindGroupLayout,
    /// Group 0 of `shadow`: no map yet to look up.
    pub light_layout: wgpu::BindGroupLayout,
}

impl Pipelines {
    /// Compiles the shaders for what the scene's materials need, and targets of `format`.
    pub fn new(gpu: &Gpu, scene: &Scene, format: Format, materials: &Materials) -> Self {
        let view_layout_with_map = view_layout(gpu, true);
        let light_layout = view_layout(gpu, false);
        let module = |module: shaders::Module| {
            gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
                label: Some(module.name),
                source: wgpu::ShaderSource::Wgsl(module.source().into()),
            })
        };
        let (surface_module, sky_module, shadow_module) =
            (module(shaders::SURFACE), module(shaders::SKY), module(shaders::SHADOW));
        let mut made: Vec<(Look, wgpu::RenderPipeline)> = Vec::new();
        let mut surface = Vec::with_capacity(scene.materials.len());
        for look in scene.materials.iter().map(Look::of) {
            let pipeline = match made.iter().find(|(known, _)| *known == look) {
                Some((_, pipeline)) => pipeline.clone(),
                None => {
                    let description = Description {
                        label: "surface",
                        module: &surface_module,
                        groups: &[Some(&view_layout_with_map), Some(&materials.layout)],
                        buffers: &surface_buffers(),
                        cull: !look.double_sided,
                        depth_write: !look.blended,
                        depth_compare: wgpu::CompareFunction::Greater,
                        target: Some((format, look.blended)),
                        constants: &look.constants(scene.light.shadows),
                    };
                    let pipeline = description.build(gpu);
                    made.push((look, pipeline.clone()));
                    pipeline
                }
            };
            surface.push(pipeline);
        }
        let sky = Description {
            label: "sky",
            module: &sky_module,
            groups: &[Some(&view_layout_with_map)],
            buffers: &[],
            cull: false,
            depth_write: false,
            depth_compare: wgpu::CompareFunction::GreaterEqual,
            target: Some((format, false)),
            constants: &[],
        }
        .build(gpu);
        let shadow = Description {
            label: "shadow",
            module: &shadow_module,
            groups: &[Some(&light_layout)],
            buffers: &[Some(world_only())],
            cull: false,
            depth_write: true,
            depth_compare: wgpu::CompareFunction::Greater,
            target: None,
            constants: &[],
        }
        .build(gpu);
        Self { surface, sky, shadow, view_layout: view_layout_with_map, light_layout }
    }
}

/// What differs between the pipelines.
struct Description<'a> {
    label: &'a str,
    module: &'a wgpu::ShaderModule,
    groups: &'a [Option<&'a wgpu::BindGroupLayout>],
    buffers: &'a [Option<wgpu::VertexBufferLayout<'a>>],
    cull: bool,
    depth_write: bool,
    depth_compare: wgpu::CompareFunction,
    /// None: depth alone is drawn. The flag mixes with what is there.
    target: Option<(Format, bool)>,
    /// The fragment shader's overrides.
    constants: &'a [(&'a str, f64)],
}

/// What of a material decides its pipeline: what it cannot show is left out of its shader.
#[derive(Clone, Copy, PartialEq, Eq)]
struct Look {
    blended: bool,
    double_sided: bool,
    lit: bool,
    emissive: bool,
    masked: bool,
}

impl Look {
    fn of(material: &Material) -> Self {
        Self {
            blended: material.alpha == Alpha::Blend,
            double_sided: material.double_sided,
            lit: !material.unlit,
            emissive: !material.unlit && material.emissive != [0.0; 3],
            masked: matches!(material.alpha, Alpha::Mask(_)),
        }
    }

    /// The shader's overrides.
    fn constants(self, shadowed: bool) -> [(&'static str, f64); 4] {
        let flag = |value: bool| f64::from(u8::from(value));
        [
            ("LIT", flag(self.lit)),
            ("SHADOWED", flag(shadowed)),
            ("EMISSIVE", flag(self.emissive)),
            ("MASKED", flag(self.masked)),
        ]
    }
}

impl Description<'_> {
    fn build(&self, gpu: &Gpu) -> wgpu::RenderPipeline {
        let layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some(self.label),
            bind_group_layouts: self.groups,
            ..Default::default()
        });
        let targets = self.target.map(|(format, blended)| {
            [Some(wgpu::ColorTargetState {
                format: format.colour,
                blend: blended.then_some(wgpu::BlendState::ALPHA_BLENDING),
                write_mask: wgpu::ColorWrites::ALL,
            })]
        });
        gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(self.label),
            layout: Some(&layout),
            vertex: wgpu::VertexState {
                module: self.module,
                entry_point: Some("vertex"),
                compilation_options: Default::default(),
                buffers: self.buffers,
            },
            primitive: wgpu::PrimitiveState { cull_mode: self.cull.then_some(wgpu::Face::Back), ..Default::default() },
            depth_stencil: Some(wgpu::DepthStencilState {
                format: DEPTH_FORMAT,
                depth_write_enabled: Some(self.depth_write),
                depth_compare: Some(self.depth_compare),
                stencil: Default::default(),
                bias: Default::default(),
            }),
            multisample: wgpu::MultisampleState {
                count: self.target.map_or(1, |(format, _)| format.samples),
                ..Default::default()
            },
            fragment: targets.as_ref().map(|targets| wgpu::FragmentState {
                module: self.module,
                entry_point: Some("fragment"),
                compilation_options: wgpu::PipelineCompilationOptions {
                    constants: self.constants,
                    ..Default::default()
                },
                targets,
            }),
            multiview_mask: None,
            cache: None,
        })
    }
}

const POSITION: [[wgpu::VertexAttribute; 1]; 3] = [
    wgpu::vertex_attr_array![0 => Float32],
    wgpu::vertex_attr_array![1 => Float32],
    wgpu::vertex_attr_array![2 => Float32],
];
const ATTRIBUTES: [wgpu::VertexAttribute; 4] = [
    attribute(3, offset_of!(Attributes, world), wgpu::VertexFormat::Float32x3),
    attribute(4, offset_of!(Attributes, normal), wgpu::VertexFormat::Float32x3),
    attribute(5, offset_of!(Attributes, uv), wgpu::VertexFormat::Float32x2),
    attribute(6, offset_of!(Attributes, colour), wgpu::VertexFormat::Float32x4),
];

const fn attribute(shader_location: u32, offset: usize, format: wgpu::VertexFormat) -> wgpu::VertexAttribute {
    wgpu::VertexAttribute { format, offset: offset as u64, shader_location }
}

fn surface_buffers() -> [Option<wgpu::VertexBufferLayout<'static>>; 4] {
    let stream = |axis: usize| {
        Some(wgpu::VertexBufferLayout {
            array_stride: 4,
            step_mode: wgpu::VertexStepMode::Vertex,
            attributes: &POSITION[axis],
        })
    };
    [stream(0), stream(1), stream(2), Some(with_attributes(&ATTRIBUTES))]
}

fn world_only() -> wgpu::VertexBufferLayout<'static> {
    with_attributes(&ATTRIBUTES[..1])
}

fn with_attributes(attributes: &'static [wgpu::VertexAttribute]) -> wgpu::VertexBufferLayout<'static> {
    wgpu::VertexBufferLayout {
        array_stride: size_of::<Attributes>() as u64,
        step_mode: wgpu::VertexStepMode::Vertex,
        attributes,
    }
}

fn view_layout(gpu: &Gpu, with_shadow_map: bool) -> wgpu::BindGroupLayout {
    let uniform = |binding| wgpu::BindGroupLayoutEntry {
        binding,
        visibility: wgpu::ShaderStages::VERTEX_FRAGMENT,
        ty: wgpu::BindingType::Buffer {
            ty: wgpu::BufferBindingType::Uniform,
            has_dynamic_offset: false,
            min_binding_size: None,
        },
        count: None,
    };
    let fragment =
        |binding, ty| wgpu::BindGroupLayoutEntry { binding, visibility: wgpu::ShaderStages::FRAGMENT, ty, count: None };
    let map = wgpu::BindingType::Texture {
        sample_type: wgpu::TextureSampleType::Depth,
        view_dimension: wgpu::TextureViewDimension::D2,
        multisampled: false,
    };
    let comparison = wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Comparison);
    let entries = [uniform(0), uniform(1), fragment(2, map), fragment(3, comparison)];
    gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("view"),
        entries: if with_shadow_map { &entries } else { &entries[..2] },
    })
}
