//! The fixed part of each draw: shader, vertex streams, depth test, and effects.
//!
//! Features that a material does not have, and effects that are off, are left out of the shaders, so that they cost
//! nothing. So there is a set of pipelines for each [`Mode`], compiled when it is first asked for.

use super::geometry::{OwnAttributes, VertexSurface};
use super::materials::Materials;
use crate::gpu::Gpu;
use crate::target::{DEPTH_FORMAT, Format};
use scene::carriers::{SceneCarriers, WHITE};
use scene::{Alpha, Material, Scene};
use std::mem::{offset_of, size_of};
use view::{Colouring, Effects};

/// Kind of values drawn of the world.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mode {
    /// Light that an observer sees, with these effects.
    Light(Effects),
    /// Photo-surface seen from outside, in these colours, for an observer with these effects.
    Outside(Colouring, Effects),
    /// Weights of one carrier after another, for the image renderer's map.
    Weights,
    /// Places instead of light: the place in the scene of each pixel's surface, metres relative to the scene's
    /// origin, and 1 for what rests or 2 + i for motion i; zeros if there is no surface.
    Places,
}

/// Origin of the positions at which vertices are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum VertexSource {
    /// The scene's own positions, relative to its origin.
    Plain,
    /// Streams of apparent positions.
    Streams,
    /// Streams for some vertices; the vertex stage bends the others.
    Bent,
}

/// Pipelines for every material and the sky, in one mode, for targets of one format.
pub struct ModePipelines {
    mode: Mode,
    source: VertexSource,
    format: Format,
    /// Pipelines of the materials, in the scene's order. Materials that look alike share one.
    pub surface: Vec<wgpu::RenderPipeline>,
    /// Pipelines of the materials for vertices with their own Doppler factors. `None` if there are no such vertices
    /// or the factors do not matter.
    pub animated: Option<Vec<wgpu::RenderPipeline>>,
    /// Pipeline of the sky, which is behind everything.
    pub sky: wgpu::RenderPipeline,
    /// Pipelines that draw depth alone, before any light, so that only what is seen is shaded. `None` if that does not
    /// pay.
    pub depth: Option<DepthPipelines>,
}

/// Pipelines of depth alone.
pub struct DepthPipelines {
    /// Pipelines of materials with one side, and with two.
    pub by_sides: [wgpu::RenderPipeline; 2],
    /// Index into `by_sides` of each material; `None` for a material that may have holes or be blended.
    pub of_material: Vec<Option<usize>>,
}

/// Sources of the pipelines, and the pipelines made so far.
pub struct Pipelines {
    surface_module: wgpu::ShaderModule,
    sky_module: wgpu::ShaderModule,
    looks: Vec<Look>,
    sky_identity: bool,
    panorama: bool,
    background: bool,
    shadows: bool,
    /// True if anything is animated.
    animates: bool,
    /// True if depth is drawn before light in windows.
    depth_first: bool,
    /// Attributes that each vertex has; all vertices share the others.
    own: OwnAttributes,
    made: Vec<ModePipelines>,
    /// Pipeline of the sun's depth map.
    pub shadow: wgpu::RenderPipeline,
    /// Layout of group 0 for all pipelines but `shadow`.
    pub view_layout: wgpu::BindGroupLayout,
    /// Layout of group 0 for `shadow`, which has no map to look up yet.
    pub light_layout: wgpu::BindGroupLayout,
}

impl Pipelines {
    /// Loads the shaders for the scene's materials. If `background` is true, one radiance is shown instead of the
    /// sky.
    pub fn new(gpu: &Gpu, scene: &Scene, own: OwnAttributes, spectra: &SceneCarriers, background: bool) -> Self {
        let light_layout = light_layout(gpu);
        let module = |module: shaders::Module| {
            gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
                label: Some(module.name),
                source: wgpu::ShaderSource::Wgsl(module.source().into()),
            })
        };
        let shadow_module = module(shaders::SHADOW);
        let shadow = Description {
            label: "shadow",
            module: &shadow_module,
            entry_points: USUAL,
            groups: &[Some(&light_layout)],
            buffers: &[Some(world_only())],
            cull: false,
            depth_write: true,
            depth_compare: wgpu::CompareFunction::Greater,
            target: None,
            vertex_constants: &[],
            constants: &[],
        }
        .build(gpu);
        let looks = scene.materials.iter().zip(&spectra.materials);
        Self {
            surface_module: module(shaders::SURFACE),
            sky_module: module(shaders::SKY),
            looks: looks.map(|(material, carrier)| Look::of(material, *carrier)).collect(),
            sky_identity: spectra.sky == WHITE,
            panorama: scene.panorama.is_some(),
            background,
            shadows: scene.light.shadows,
            animates: scene.motions.iter().any(|motion| motion.animated().is_some()),
            depth_first: gpu.is_software() && scene.triangle_count() <= DEPTH_FIRST_TRIANGLES,
            own,
            made: Vec::new(),
            shadow,
            view_layout: view_layout(gpu),
            light_layout,
        }
    }

    /// Compiles the pipelines of a mode if that has not been done before.
    pub fn prepare(&mut self, gpu: &Gpu, materials: &Materials, mode: Mode, source: VertexSource, format: Format) {
        if self.get(mode, source, format).is_some() {
            return;
        }
        let depth = self.is_depth_first(mode, source, format).then(|| self.depths(gpu, source, format));
        let surface = self.surfaces(gpu, materials, mode, format, (false, source));
        let shifted = source == VertexSource::Streams
            && match mode {
                Mode::Light(effects) => effects.bend() && effects.shift_light(),
                Mode::Outside(..) => true,
                Mode::Weights | Mode::Places => false,
            };
        let animated = (self.animates && shifted).then(|| self.surfaces(gpu, materials, mode, format, (true, source)));
        let sky = Description {
            label: "sky",
            module: &self.sky_module,
            entry_points: USUAL,
            groups: &[Some(&self.view_layout)],
            buffers: &[],
            cull: false,
            depth_write: false,
            depth_compare: wgpu::CompareFunction::GreaterEqual,
            target: Some(ColourTarget { format, blend: None, written: true }),
            vertex_constants: &[],
            constants: &[
                [("PANORAMA", flag(self.panorama)), ("BACKGROUND", flag(self.background))].as_slice(),
                &mode.constants(self.sky_identity, format),
            ]
            .concat(),
        }
        .build(gpu);
        self.made.push(ModePipelines { mode, source, format, surface, animated, sky, depth });
    }

    /// True if depth is drawn before the light of this mode.
    fn is_depth_first(&self, mode: Mode, source: VertexSource, format: Format) -> bool {
        self.depth_first && mode != Mode::Places && source != VertexSource::Bent && !format.is_exact()
    }

    /// Pipelines of depth alone.
    fn depths(&self, gpu: &Gpu, source: VertexSource, format: Format) -> DepthPipelines {
        let plain = source == VertexSource::Plain;
        let mut buffers = [const { None }; 8];
        if plain {
            buffers[3] = Some(world_only());
        } else {
            buffers[..3].clone_from_slice(&surface_buffers(self.own)[..3]);
        }
        let by_sides = [true, false].map(|cull| {
            Description {
                label: "depth",
                module: &self.surface_module,
                entry_points: [if plain { "vertex_plain_depth" } else { "vertex_depth" }, "fragment_depth"],
                groups: &[Some(&self.view_layout)],
                buffers: &buffers,
                cull,
                depth_write: true,
                depth_compare: wgpu::CompareFunction::Greater,
                target: Some(ColourTarget { format, blend: None, written: false }),
                vertex_constants: &[],
                constants: &[],
            }
            .build(gpu)
        });
        let hides = |look: &Look| (!look.masked && !look.blended).then_some(usize::from(look.double_sided));
        DepthPipelines { by_sides, of_material: self.looks.iter().map(hides).collect() }
    }

    /// Pipelines of the materials. `animated` is true for vertices with their own Doppler factors.
    fn surfaces(
        &self,
        gpu: &Gpu,
        materials: &Materials,
        mode: Mode,
        format: Format,
        (animated, source): (bool, VertexSource),
    ) -> Vec<wgpu::RenderPipeline> {
        let mut made: Vec<(Look, wgpu::RenderPipeline)> = Vec::new();
        let mut surface = Vec::with_capacity(self.looks.len());
        let mut buffers = surface_buffers(self.own);
        if !animated {
            buffers[4] = None;
        }
        let entry_points = match (source, mode) {
            (VertexSource::Plain, _) => PLAIN,
            (_, Mode::Outside(..)) => {
                [["vertex_outside", "vertex_outside_animated"][usize::from(animated)], "fragment_outside"]
            }
            _ if animated => ANIMATED,
            (VertexSource::Streams | VertexSource::Bent, _) => USUAL,
        };
        if source == VertexSource::Plain {
            buffers[..3].fill(None);
        }
        let texture_bias = if format.is_exact() { 0.0 } else { WINDOW_TEXTURE_BIAS };
        // Where depth is there already, the surface that it belongs to must pass.
        let depth_compare = if mode == Mode::Weights || self.is_depth_first(mode, source, format) {
            wgpu::CompareFunction::GreaterEqual
        } else {
            wgpu::CompareFunction::Greater
        };
        for &look in &self.looks {
            let pipeline = match made.iter().find(|(known, _)| *known == look) {
                Some((_, pipeline)) => pipeline.clone(),
                None => {
                    let description = Description {
                        label: "surface",
                        module: &self.surface_module,
                        entry_points,
                        groups: &[Some(&self.view_layout), Some(&materials.layout)],
                        buffers: &buffers,
                        cull: !look.double_sided,
                        depth_write: !look.blended,
                        depth_compare,
                        target: Some(ColourTarget {
                            format,
                            blend: look.blended.then(|| blending(mode)),
                            written: true,
                        }),
                        vertex_constants: &[("BENDS", flag(source == VertexSource::Bent))],
                        constants: &[
                            look.constants(self.shadows).as_slice(),
                            &[
                                ("ANIMATED", flag(animated)),
                                ("TEXTURE_BIAS", texture_bias),
                                ("COLOURING", f64::from(mode.colouring())),
                            ],
                            &mode.constants(look.identity, format),
                        ]
                        .concat(),
                    };
                    let pipeline = description.build(gpu);
                    made.push((look, pipeline.clone()));
                    pipeline
                }
            };
            surface.push(pipeline);
        }
        surface
    }

    /// Pipelines of a mode that was prepared.
    pub fn get(&self, mode: Mode, source: VertexSource, format: Format) -> Option<&ModePipelines> {
        self.made.iter().find(|made| (made.mode, made.source, made.format) == (mode, source, format))
    }
}

/// Levels by which windows take textures finer than their pixels ask for. Of the old town at 0.8 c, a frame of
/// 640 × 360 pixels so differs from 64 rays a pixel by a FLIP of 0.053 instead of 0.060 (`cargo bench -p rapidity
/// --bench windows -- 640x360`).
const WINDOW_TEXTURE_BIAS: f64 = -0.5;

/// Largest number of triangles of a scene whose depth is drawn first where the CPU draws: the work on twice as many
/// vertices must stay below that on hidden pixels.
const DEPTH_FIRST_TRIANGLES: usize = 200_000;

type Constant = (&'static str, f64);

/// Entry points of the vertex shader and of the fragment shader.
type EntryPoints = [&'static str; 2];

const USUAL: EntryPoints = ["vertex", "fragment"];
const PLAIN: EntryPoints = ["vertex_plain", "fragment"];
const ANIMATED: EntryPoints = ["vertex_animated", "fragment_animated"];

impl Mode {
    /// Override values of the shaders. `identity` is true if weights are linear sRGB at D = 1.
    fn constants(self, identity: bool, format: Format) -> Vec<Constant> {
        let effects = match self {
            Self::Light(effects) | Self::Outside(_, effects) => effects,
            Self::Weights | Self::Places => Effects::NONE,
        };
        let map = [("MAP", flag(self == Self::Weights)), ("PLACES", flag(self == Self::Places))];
        [map.as_slice(), &effect_constants(effects, identity, format)].concat()
    }
}

impl Mode {
    /// Number of the colouring for `outside.wgsl`.
    fn colouring(self) -> u32 {
        match self {
            Self::Outside(Colouring::Doppler, _) => shaders::OUTSIDE_DOPPLER,
            Self::Outside(Colouring::Delay, _) => shaders::OUTSIDE_DELAY,
            _ => shaders::OUTSIDE_LIGHT,
        }
    }
}

/// Override values of `shift.wgsl`, for targets of `format`.
pub fn effect_constants(effects: Effects, identity: bool, format: Format) -> [Constant; 5] {
    [
        ("GEOMETRY", flag(effects.bend())),
        ("DOPPLER", flag(effects.shift_colour())),
        ("SEARCHLIGHT", flag(effects.brighten())),
        ("IDENTITY", flag(identity)),
        ("LARGEST", f64::from(format.largest())),
    ]
}

fn flag(value: bool) -> f64 {
    f64::from(u8::from(value))
}

/// Blending over the target by opacity. In the light that an observer sees, alpha is the luminance at rest instead of
/// opacity, and keeps its value.
fn blending(mode: Mode) -> wgpu::BlendState {
    match mode {
        Mode::Weights => wgpu::BlendState::ALPHA_BLENDING,
        // Places must not be blended.
        Mode::Places => wgpu::BlendState::REPLACE,
        Mode::Light(_) | Mode::Outside(..) => wgpu::BlendState {
            alpha: wgpu::BlendComponent {
                src_factor: wgpu::BlendFactor::Zero,
                dst_factor: wgpu::BlendFactor::One,
                operation: wgpu::BlendOperation::Add,
            },
            ..wgpu::BlendState::ALPHA_BLENDING
        },
    }
}

/// Settings in which the pipelines differ.
struct Description<'a> {
    label: &'a str,
    module: &'a wgpu::ShaderModule,
    entry_points: EntryPoints,
    groups: &'a [Option<&'a wgpu::BindGroupLayout>],
    buffers: &'a [Option<wgpu::VertexBufferLayout<'a>>],
    cull: bool,
    depth_write: bool,
    depth_compare: wgpu::CompareFunction,
    /// Target of the colours. `None` if there is only depth.
    target: Option<ColourTarget>,
    /// Override values of the vertex shader.
    vertex_constants: &'a [Constant],
    /// Override values of the fragment shader.
    constants: &'a [Constant],
}

/// Target of a pipeline's colours.
#[derive(Clone, Copy)]
struct ColourTarget {
    format: Format,
    blend: Option<wgpu::BlendState>,
    /// True if colours are written, false if they keep their values.
    written: bool,
}

/// Properties of a material that decide its pipeline. Its shader leaves out what they do not need.
#[derive(Clone, Copy, PartialEq, Eq)]
struct Look {
    blended: bool,
    double_sided: bool,
    lit: bool,
    emissive: bool,
    masked: bool,
    spectral: bool,
    split: bool,
    identity: bool,
}

impl Look {
    fn of(material: &Material, carrier: usize) -> Self {
        let spectral = material.spectrum.is_some();
        // An emissive material with a spectrum emits nothing else.
        let source = material.unlit || (spectral && material.is_source());
        let emissive = !source && material.emissive != [0.0; 3];
        let split = emissive && carrier != WHITE;
        Self {
            blended: material.alpha == Alpha::Blend,
            double_sided: material.double_sided,
            lit: !source,
            emissive,
            masked: matches!(material.alpha, Alpha::Mask(_)),
            spectral,
            split,
            identity: carrier == WHITE,
        }
    }

    /// Override values of the shader.
    fn constants(self, shadowed: bool) -> [Constant; 7] {
        [
            ("LIT", flag(self.lit)),
            ("SHADOWED", flag(shadowed)),
            ("EMISSIVE", flag(self.emissive)),
            ("MASKED", flag(self.masked)),
            ("SPECTRAL", flag(self.spectral)),
            ("SPLIT", flag(self.split)),
            ("BLENDED", flag(self.blended)),
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
        let targets = self.target.map(|ColourTarget { format, blend, written }| {
            let write_mask = if written { wgpu::ColorWrites::ALL } else { wgpu::ColorWrites::empty() };
            [Some(wgpu::ColorTargetState { format: format.colour, blend, write_mask })]
        });
        gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(self.label),
            layout: Some(&layout),
            vertex: wgpu::VertexState {
                module: self.module,
                entry_point: Some(self.entry_points[0]),
                compilation_options: wgpu::PipelineCompilationOptions {
                    constants: self.vertex_constants,
                    ..Default::default()
                },
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
                count: self.target.map_or(1, |target| target.format.samples),
                ..Default::default()
            },
            fragment: targets.as_ref().map(|targets| wgpu::FragmentState {
                module: self.module,
                entry_point: Some(self.entry_points[1]),
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
const LOG2_DOPPLER: [wgpu::VertexAttribute; 1] = wgpu::vertex_attr_array![7 => Float32];
const SURFACE: [wgpu::VertexAttribute; 2] = [
    attribute(3, offset_of!(VertexSurface, world), wgpu::VertexFormat::Float32x3),
    attribute(4, offset_of!(VertexSurface, normal), wgpu::VertexFormat::Float32x3),
];
const UV: [wgpu::VertexAttribute; 1] = wgpu::vertex_attr_array![5 => Float32x2];
const COLOUR: [wgpu::VertexAttribute; 1] = wgpu::vertex_attr_array![6 => Float32x4];
const EMISSIVE_UV: [wgpu::VertexAttribute; 1] = wgpu::vertex_attr_array![8 => Float32x2];

const fn attribute(shader_location: u32, offset: usize, format: wgpu::VertexFormat) -> wgpu::VertexAttribute {
    wgpu::VertexAttribute { format, offset: offset as u64, shader_location }
}

/// Vertex buffers: three streams of positions, the surfaces, a stream of log2 D for the vertices that have it, texture
/// coordinates, those of emissive textures, and colours. A stride of 0 gives all vertices the same value.
fn surface_buffers(own: OwnAttributes) -> [Option<wgpu::VertexBufferLayout<'static>>; 8] {
    let buffer = |array_stride, attributes| {
        Some(wgpu::VertexBufferLayout { array_stride, step_mode: wgpu::VertexStepMode::Vertex, attributes })
    };
    let [x, y, z] = &POSITION;
    [
        buffer(4, x),
        buffer(4, y),
        buffer(4, z),
        buffer(size_of::<VertexSurface>() as u64, &SURFACE),
        buffer(4, &LOG2_DOPPLER),
        buffer(if own.uvs { 8 } else { 0 }, &UV),
        buffer(if own.uvs { 8 } else { 0 }, &EMISSIVE_UV),
        buffer(if own.colours { 16 } else { 0 }, &COLOUR),
    ]
}

fn world_only() -> wgpu::VertexBufferLayout<'static> {
    wgpu::VertexBufferLayout {
        array_stride: size_of::<VertexSurface>() as u64,
        step_mode: wgpu::VertexStepMode::Vertex,
        attributes: &SURFACE[..1],
    }
}

/// Layout of group 0 in `shared.wgsl`, `shift.wgsl`, `surface.wgsl` and `sky.wgsl`. The view is one of several,
/// chosen by its offset.
fn view_layout(gpu: &Gpu) -> wgpu::BindGroupLayout {
    let float = |filterable| wgpu::BindingType::Texture {
        sample_type: wgpu::TextureSampleType::Float { filterable },
        view_dimension: wgpu::TextureViewDimension::D2,
        multisampled: false,
    };
    let depth = wgpu::BindingType::Texture {
        sample_type: wgpu::TextureSampleType::Depth,
        view_dimension: wgpu::TextureViewDimension::D2,
        multisampled: false,
    };
    layout(
        gpu,
        "view",
        &[
            uniform(true),
            uniform(false),
            depth,
            wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Comparison),
            float(false),
            float(true),
            wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering),
        ],
    )
}

fn light_layout(gpu: &Gpu) -> wgpu::BindGroupLayout {
    layout(gpu, "light", &[uniform(false), uniform(false)])
}

fn uniform(has_dynamic_offset: bool) -> wgpu::BindingType {
    wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Uniform, has_dynamic_offset, min_binding_size: None }
}

/// Layout with bindings 0, 1, 2…, for vertex and fragment shaders.
pub fn layout(gpu: &Gpu, label: &str, types: &[wgpu::BindingType]) -> wgpu::BindGroupLayout {
    let entry = |(binding, &ty): (usize, &wgpu::BindingType)| wgpu::BindGroupLayoutEntry {
        binding: binding as u32,
        visibility: wgpu::ShaderStages::VERTEX_FRAGMENT,
        ty,
        count: None,
    };
    let entries: Vec<_> = types.iter().enumerate().map(entry).collect();
    gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some(label), entries: &entries })
}
