//! The map drawn, and the picture looked up in it.

use super::atlas::{self, Atlas};
use super::atlas_tiles::{Fineness, Placed, Plan};
use super::map_quality::MapQuality;
use super::picture_map::PictureMap;
use crate::gpu::Gpu;
use crate::stats::MapStats;
use crate::subject::Subject;
use crate::target::{DEPTH_FORMAT, Format};
use crate::textures::from_rows;
use crate::view_matrix::{NEAR_M, matrix};
use crate::world::{Draws, Mode, TargetPart, VertexSource, World, bind_group, effect_constants, layout};
use bytemuck::{bytes_of, cast_slice};
use glam::{DMat4, DVec2, Vec4};
use physics::{Celerity, Observer};
use scene::cut::SeenFrom;
use std::time::Instant;
use view::{Effects, Shot, Sides};
use wgpu::util::DeviceExt;

/// Length of a pane's entry in the table of panes, texels.
const PANE_TEXELS: u32 = (size_of::<shaders::AtlasTile>() / 16) as u32;
/// Fixed cost of drawing a pane besides its own texels, in texels.
const PANE_COST: f64 = 20e3;
/// Fixed cost of drawing a pane where the CPU draws and a change of pipeline costs more, in texels.
const PANE_COST_SOFTWARE: f64 = 60e3;
/// Most memory of a map, with its depth and spare room, bytes.
const MOST_BYTES: u64 = 1 << 30;

/// The map of a scene around an eye, and the pipelines that look it up.
pub struct MapRenderer {
    module: wgpu::ShaderModule,
    group_layout: wgpu::BindGroupLayout,
    /// Layout of the group that holds the points of a screen that is not flat.
    points_layout: wgpu::BindGroupLayout,
    sampler: wgpu::Sampler,
    format: Format,
    quality: MapQuality,
    /// Shift of the texels, parts of a texel.
    shift: DVec2,
    /// True if pictures get their depth.
    with_depth: bool,
    atlas: Option<Atlas>,
    group: Option<wgpu::BindGroup>,
    pipelines: Vec<(LookUp, wgpu::RenderPipeline)>,
    stats: MapStats,
}

/// Kind of look-up that a pipeline does.
#[derive(Clone, Copy, Debug, PartialEq)]
struct LookUp {
    effects: Effects,
    subject: Subject,
    /// True for a screen that is not flat.
    bent: bool,
}

impl MapRenderer {
    /// Renderer for pictures in targets of `format`. `with_depth` is true if anything is drawn over the pictures.
    pub fn new(gpu: &Gpu, format: Format, quality: MapQuality, with_depth: bool) -> Self {
        let module = gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(shaders::WARP.name),
            source: wgpu::ShaderSource::Wgsl(shaders::WARP.source().into()),
        });
        let buffer = |ty| wgpu::BindingType::Buffer { ty, has_dynamic_offset: false, min_binding_size: None };
        let texture = |sample_type, view_dimension| wgpu::BindingType::Texture {
            sample_type,
            view_dimension,
            multisampled: false,
        };
        let float = |filterable| wgpu::TextureSampleType::Float { filterable };
        let mut types = vec![
            buffer(wgpu::BufferBindingType::Uniform),
            texture(wgpu::TextureSampleType::Sint, wgpu::TextureViewDimension::D2Array),
            texture(float(false), wgpu::TextureViewDimension::D2),
            texture(float(true), wgpu::TextureViewDimension::D2Array),
            wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering),
        ];
        if with_depth {
            types.push(texture(wgpu::TextureSampleType::Depth, wgpu::TextureViewDimension::D2));
        }
        let group_layout = layout(gpu, "map", &types);
        let points = [texture(float(false), wgpu::TextureViewDimension::D2)];
        Self {
            module,
            group_layout,
            points_layout: layout(gpu, "points", &points),
            sampler: gpu.device.create_sampler(&wgpu::SamplerDescriptor {
                label: Some("map"),
                mag_filter: wgpu::FilterMode::Linear,
                min_filter: wgpu::FilterMode::Linear,
                ..Default::default()
            }),
            format,
            quality,
            shift: DVec2::ZERO,
            with_depth,
            atlas: None,
            group: None,
            pipelines: Vec::new(),
            stats: MapStats::default(),
        }
    }

    /// Cost of the newest map.
    pub fn stats(&self) -> MapStats {
        self.stats
    }

    /// Sets the texels for each pixel of the next maps, and their shift, parts of a texel.
    pub fn set_texels(&mut self, texels_per_pixel: f64, shift: DVec2) {
        (self.quality.texels_per_pixel, self.shift) = (texels_per_pixel, shift);
    }

    /// Draws the map for flat pictures by one observer, each with its size in pixels, that together show `pixels`
    /// pixels.
    pub fn draw_map(
        &mut self,
        gpu: &Gpu,
        world: &mut World,
        shots: &[(Shot, [u32; 2])],
        pixels: f64,
        subject: Subject,
    ) {
        let Some((shot, _)) = shots.first() else { return };
        let started = Instant::now();
        let places = subject == Subject::Places;
        let (mode, layers) = match subject {
            Subject::Light => (Mode::Weights, world.spectra.carriers.len() as u32),
            Subject::Places => (Mode::Places, 1),
        };
        let format = atlas::format(self.format);
        let texel_bytes = atlas::texel_bytes(format, layers);
        let pictures: Vec<_> = shots.iter().map(|(shot, size)| (shot.camera, *size)).collect();
        let picture_map = PictureMap::new(&pictures, shot.observer.celerity);
        let room = MOST_BYTES as f64 / (texel_bytes as f64 * atlas::WITH_SPARE);
        // A smooth map costs the same at any speed: its number of texels for each pixel of the picture is fixed,
        // wherever they are needed.
        let budget = self.quality.texels_per_pixel.powi(2) * pixels;
        let most_texels = if self.quality.smooth { budget.min(room) } else { room };
        let plan = self.plan(gpu, &picture_map, most_texels).shifted(self.shift);
        self.stats = MapStats {
            panes: plan.placed.len(),
            texels: plan.texels() as u64,
            bytes: 0,
            texels_per_pixel: plan.texels_per_pixel,
            plan_ms: started.elapsed().as_secs_f64() * 1e3,
        };

        // Make one view for each pane and carrier.
        let from_eye = world.origin - shot.observer.event.position;
        let views: Vec<_> =
            plan.placed.iter().map(|pane| pane.view(&picture_map.cube_from_world, from_eye, NEAR_M)).collect();
        // Clockwork stands in the map as it is seen: each view is followed by one for each of its parts.
        let poses = world.clockwork(&shot.observer);
        let poses_from_origin: Vec<_> =
            poses.iter().map(|pose| DMat4::from_translation(-world.origin) * DMat4::from(*pose)).collect();
        let of_layer = |layer: u32| {
            let poses = &poses_from_origin;
            views.iter().flat_map(move |(view, _)| {
                let layer = Vec4::new(layer as f32, 1.0, 0.0, 0.0);
                let resting = shaders::ViewUniforms { layer, ..*view };
                let of_pose = move |(number, pose): (usize, &DMat4)| shaders::ViewUniforms {
                    clip_from_observer: resting.clip_from_observer * matrix(pose),
                    layer: if places { layer + Vec4::X * (1 + number) as f32 } else { layer },
                    ..resting
                };
                std::iter::once(resting).chain(poses.iter().enumerate().map(of_pose))
            })
        };
        world.write_views(gpu, &(0..layers).flat_map(of_layer).collect::<Vec<_>>());
        world.prepare(gpu, mode, VertexSource::Plain, format);

        let atlas = match self.atlas.take() {
            Some(atlas) if atlas.holds(plan.size, layers) => atlas,
            old => {
                // Drop the old one first: there may be no room for two.
                drop((old, self.group.take()));
                Atlas::new(gpu, plan.size, format, layers, self.with_depth)
            }
        };
        self.stats.bytes = atlas.texels() * texel_bytes;
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        // The map is of directions in the world, whatever the observer's motion.
        let observer = Observer { celerity: Celerity::ZERO, ..shot.observer };
        let at_rest = SeenFrom::of(world.origin, &[], &observer, None);
        let posed = |pose| SeenFrom { pose: Some(pose), place: observer.event.position, ..at_rest.clone() };
        let sights: Vec<_> = std::iter::once(at_rest.clone()).chain(poses.iter().copied().map(posed)).collect();
        for layer in 0..layers {
            let draws = Draws {
                streams: None,
                bends: false,
                mode,
                format,
                sights: &sights,
                outside: None,
                pixels: plan.texels(),
                further_carrier: (layer > 0).then_some(layer as usize),
                sky: true,
            };
            let part = |(number, (pane, (_, sides))): (usize, (&Placed, &(_, Sides)))| {
                let ([x, y], [width, height]) = (pane.place, pane.drawn());
                let view = (layer as usize * views.len() + number) * sights.len();
                TargetPart { view: view as u32, place: Some([x, y, width, height]), sides: *sides }
            };
            let parts: Vec<TargetPart> = plan.placed.iter().zip(&views).enumerate().map(part).collect();
            world.draw(gpu, &mut atlas.begin(&mut encoder, layer), &draws, &parts);
        }
        gpu.queue.submit([encoder.finish()]);
        self.group = Some(self.bind(gpu, &plan, &atlas));
        self.atlas = Some(atlas);
    }

    /// Plans a map as fine as wanted, or as fine as there is room for. The frame before tells approximately how fine
    /// that is.
    fn plan(&self, gpu: &Gpu, picture_map: &PictureMap, most_texels: f64) -> Plan {
        let MapQuality { texels_per_pixel: wanted, smooth } = self.quality;
        let fineness = |texels_per_pixel: f64| Fineness {
            texels_per_pixel: texels_per_pixel.min(wanted),
            exact: !smooth,
            pane_cost: if gpu.is_software() { PANE_COST_SOFTWARE } else { PANE_COST },
        };
        let largest_side = gpu.device.limits().max_texture_dimension_2d;
        let before = if smooth && self.stats.panes > 0 { self.stats.texels_per_pixel } else { wanted };
        let plan = picture_map.plan(fineness(before), most_texels, largest_side);
        if plan.texels_per_pixel >= wanted || plan.texels() > 0.8 * most_texels {
            return plan;
        }
        let finer = plan.texels_per_pixel * 0.95 * (most_texels / plan.texels().max(1.0)).sqrt();
        picture_map.plan(fineness(finer), most_texels, largest_side)
    }

    fn bind(&self, gpu: &Gpu, plan: &Plan, atlas: &Atlas) -> wgpu::BindGroup {
        let buffer = |label, contents: &[u8], usage| {
            gpu.device.create_buffer_init(&wgpu::util::BufferInitDescriptor { label: Some(label), contents, usage })
        };
        // No texture may be empty, and a picture that sees nothing of the cube has no panes.
        let panes = if plan.panes.is_empty() { &[shaders::AtlasTile::default()] } else { plan.panes.as_slice() };
        let map = buffer("map", bytes_of(&plan.map), wgpu::BufferUsages::UNIFORM);
        let side = shaders::MAP_CELLS;
        let cells = [side, side, plan.cells.len() as u32];
        let cells = from_rows(gpu, "cells", cells, wgpu::TextureFormat::R32Sint, cast_slice(&plan.cells));
        let size = [PANE_TEXELS, panes.len() as u32, 1];
        let panes = from_rows(gpu, "panes", size, wgpu::TextureFormat::Rgba32Float, cast_slice(panes));
        let cells = cells.create_view(&wgpu::TextureViewDescriptor {
            dimension: Some(wgpu::TextureViewDimension::D2Array),
            ..Default::default()
        });
        let panes = panes.create_view(&wgpu::TextureViewDescriptor::default());
        let mut resources = vec![
            map.as_entire_binding(),
            wgpu::BindingResource::TextureView(&cells),
            wgpu::BindingResource::TextureView(&panes),
            wgpu::BindingResource::TextureView(&atlas.all_layers),
            wgpu::BindingResource::Sampler(&self.sampler),
        ];
        if self.with_depth {
            resources.push(wgpu::BindingResource::TextureView(&atlas.depth));
        }
        bind_group(gpu, "map", &self.group_layout, resources)
    }

    /// Draws the picture from the map drawn last. View 0 must have been written for it. `points`: points of the room
    /// that the pixels show, if the screen is not flat.
    pub fn draw(
        &mut self,
        gpu: &Gpu,
        world: &World,
        pass: &mut wgpu::RenderPass<'_>,
        (effects, subject): (Effects, Subject),
        points: Option<&wgpu::TextureView>,
    ) {
        let look = LookUp { effects, subject, bent: points.is_some() };
        let pipeline = self.pipeline(gpu, world, look);
        let Some(group) = &self.group else { return };
        pass.set_pipeline(&pipeline);
        world.bind_view(gpu, pass, 0, None);
        pass.set_bind_group(1, group, &[]);
        if let Some(points) = points {
            let points = bind_group(gpu, "points", &self.points_layout, [wgpu::BindingResource::TextureView(points)]);
            pass.set_bind_group(2, &points, &[]);
        }
        pass.draw(0..3, 0..1);
    }

    fn pipeline(&mut self, gpu: &Gpu, world: &World, look: LookUp) -> wgpu::RenderPipeline {
        let smooth = self.quality.smooth;
        let LookUp { effects, subject, bent } = look;
        if let Some((_, pipeline)) = self.pipelines.iter().find(|(known, _)| *known == look) {
            return pipeline.clone();
        }
        let layers = world.spectra.carriers.len();
        let flag = |value: bool| f64::from(u8::from(value));
        let places = subject == Subject::Places;
        let own = [("LAYERS", layers as f64), ("SMOOTH", flag(smooth)), ("PLACES", flag(places))];
        let constants = [own.as_slice(), &effect_constants(effects, layers == 1, self.format)].concat();
        let groups = [Some(world.view_layout()), Some(&self.group_layout), Some(&self.points_layout)];
        let entry_point = match (bent, self.with_depth) {
            (true, _) => "fragment_on_surface",
            (false, true) => "fragment_with_depth",
            (false, false) => "fragment",
        };
        let layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("warp"),
            bind_group_layouts: if bent { &groups } else { &groups[..2] },
            ..Default::default()
        });
        let pipeline = gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some("warp"),
            layout: Some(&layout),
            vertex: wgpu::VertexState {
                module: &self.module,
                entry_point: Some("vertex"),
                compilation_options: Default::default(),
                buffers: &[],
            },
            primitive: Default::default(),
            depth_stencil: Some(wgpu::DepthStencilState {
                format: DEPTH_FORMAT,
                depth_write_enabled: Some(self.with_depth),
                // Everywhere but in the hidden part.
                depth_compare: Some(wgpu::CompareFunction::GreaterEqual),
                stencil: Default::default(),
                bias: Default::default(),
            }),
            multisample: wgpu::MultisampleState { count: self.format.samples, ..Default::default() },
            fragment: Some(wgpu::FragmentState {
                module: &self.module,
                entry_point: Some(entry_point),
                compilation_options: wgpu::PipelineCompilationOptions { constants: &constants, ..Default::default() },
                targets: &[Some(wgpu::ColorTargetState {
                    format: self.format.colour,
                    blend: None,
                    write_mask: wgpu::ColorWrites::ALL,
                })],
            }),
            multiview_mask: None,
            cache: None,
        });
        self.pipelines.push((look, pipeline.clone()));
        pipeline
    }
}
