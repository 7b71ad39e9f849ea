//! The sun's depth map, which tells the surfaces that the sun reaches.
//!
//! Sun and scene are at rest relative to each other. So the pattern of light and shadow in the world frame does not
//! change, and one map, drawn with the first picture, serves every observer at every speed (W 5.1.3).
//!
//! Moving bodies have their own light, by their own frame. They are left out of the map: they neither cast shadows
//! nor receive any.

use super::draw_list::Draw;
use super::geometry::Geometry;
use super::pipelines::Pipelines;
use crate::gpu::Gpu;
use crate::target::{DEPTH_FORMAT, texture};
use crate::view_matrix::matrix;
use bytemuck::bytes_of;
use glam::{DMat4, DVec3, Vec4};
use scene::Scene;
use scene::carriers::SceneCarriers;
use scene::irradiance::Irradiance;
use scene::motion::Motion;
use wgpu::util::DeviceExt;

/// Side of the map, texels.
const MAP_SIZE: u32 = 4096;

/// Least extent of the map along an axis, as a share of the largest.
const LEAST_EXTENT: f64 = 1e-3;

/// Light of a scene, for the shaders.
pub struct Light {
    /// Light that falls on the resting scene.
    pub at_rest: shaders::LightingUniforms,
    /// Uniforms [`shaders::LightingUniforms`]: one for the resting scene, then one for each of its motions.
    pub uniforms: Vec<wgpu::Buffer>,
    /// Reversed depth, seen from the sun; to be drawn.
    pub map: wgpu::TextureView,
    /// Sampler that compares and filters.
    pub sampler: wgpu::Sampler,
}

impl Light {
    /// Uploads the light of `scene`.
    ///
    /// `background` is a linear radiance that replaces the sky.
    pub fn new(gpu: &Gpu, scene: &Scene, spectra: &SceneCarriers, background: Option<[f32; 3]>) -> Self {
        let moving = scene.motions.iter().map(|motion| match motion {
            Motion::Uniform(uniform) => {
                Irradiance::on_moving(&scene.light, uniform.celerity, &spectra.carriers[spectra.sky])
            }
            // This is written for every picture.
            Motion::Animated(_) => Irradiance::at_rest(&scene.light),
        });
        let side = if scene.light.shadows { MAP_SIZE.min(gpu.device.limits().max_texture_dimension_2d) } else { 1 };
        let shadow = Shadow::of(scene, side);
        let at_rest = lighting(scene, &Irradiance::at_rest(&scene.light), Some(&shadow), spectra, background);
        let moving = moving.map(|falling| lighting(scene, &falling, None, spectra, background));
        let upload = |lighting| {
            gpu.device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
                label: Some("lighting"),
                contents: bytes_of(&lighting),
                usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            })
        };
        let uniforms: Vec<_> = std::iter::once(at_rest).chain(moving).map(upload).collect();
        let usage = wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING;
        let map = texture(gpu, "sun's depth map", [side, side], DEPTH_FORMAT, 1, usage);
        let sampler = gpu.device.create_sampler(&wgpu::SamplerDescriptor {
            label: Some("sun's depth map"),
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            compare: Some(wgpu::CompareFunction::GreaterEqual),
            ..Default::default()
        });
        Self { at_rest, uniforms, map, sampler }
    }
}

/// Materials whose surfaces cast shadows of the sun, by index; `None` if there are no shadows.
pub fn casters(scene: &Scene) -> Option<Vec<bool>> {
    scene.light.shadows.then(|| scene.materials.iter().map(|material| !material.unlit).collect())
}

/// Draws the sun's depth map of a scene's geometry. `lighting` is the light of the resting scene.
pub fn draw_map(
    gpu: &Gpu,
    (map, lighting): (&wgpu::TextureView, &wgpu::Buffer),
    casters: &[bool],
    geometry: &Geometry,
    pipelines: &Pipelines,
) {
    // The layout needs a view as well; the shadow shader does not read it.
    let view = gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("unused view"),
        size: size_of::<shaders::ViewUniforms>() as u64,
        usage: wgpu::BufferUsages::UNIFORM,
        mapped_at_creation: false,
    });
    let bind = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("light"),
        layout: &pipelines.light_layout,
        entries: &[
            wgpu::BindGroupEntry { binding: 0, resource: view.as_entire_binding() },
            wgpu::BindGroupEntry { binding: 1, resource: lighting.as_entire_binding() },
        ],
    });
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    {
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("sun's depth map"),
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: map,
                depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(0.0), store: wgpu::StoreOp::Store }),
                stencil_ops: None,
            }),
            ..Default::default()
        });
        pass.set_pipeline(&pipelines.shadow);
        pass.set_bind_group(0, &bind, &[]);
        pass.set_vertex_buffer(0, geometry.surface.slice(..));
        pass.set_index_buffer(geometry.indices.slice(..), wgpu::IndexFormat::Uint32);
        let casts = |draw: &&Draw| draw.motion.is_none() && casters[draw.material];
        for draw in geometry.list.opaque.iter().filter(casts) {
            pass.draw_indexed(draw.indices.clone(), 0, 0..1);
        }
    }
    gpu.queue.submit([encoder.finish()]);
}

/// Light of a scene for the shaders, falling as `falling` says. `shadow` of surfaces between it and the sun, if they
/// cast any.
fn lighting(
    scene: &Scene,
    falling: &Irradiance,
    shadow: Option<&Shadow>,
    spectra: &SceneCarriers,
    background: Option<[f32; 3]>,
) -> shaders::LightingUniforms {
    let light = &scene.light;
    let colour = |[red, green, blue]: [f32; 3]| Vec4::new(red, green, blue, 0.0);
    let of_scene = shaders::LightingUniforms {
        shadow_from_world: matrix(&shadow.map_or(DMat4::IDENTITY, |shadow| shadow.from_world)),
        sun_direction: Vec4::W * f32::from(u8::from(shadow.is_some())),
        sun: Vec4::W * shadow.map_or(0.0, |shadow| shadow.bias as f32),
        ambient_red: Vec4::ZERO,
        ambient_green: Vec4::ZERO,
        ambient_blue: Vec4::ZERO,
        ground: colour(light.ground).with_w(shadow.map_or(0.0, |shadow| shadow.normal_offset_m as f32)),
        zenith: colour(light.zenith).with_w(spectra.sky as f32),
        horizon: colour(light.horizon).with_w(spectra.factor(spectra.sky)),
        background: background.map_or(Vec4::ZERO, colour),
    };
    with_falling(&of_scene, falling)
}

/// Lighting with other light that falls.
pub fn with_falling(lighting: &shaders::LightingUniforms, falling: &Irradiance) -> shaders::LightingUniforms {
    let [ambient_red, ambient_green, ambient_blue] = falling.ambient.map(|channel| channel.as_vec4());
    shaders::LightingUniforms {
        sun_direction: falling.sun_direction.as_vec3().extend(lighting.sun_direction.w),
        sun: falling.sun.as_vec3().extend(lighting.sun.w),
        ambient_red,
        ambient_green,
        ambient_blue,
        ..*lighting
    }
}

/// Place of the sun's depth map.
struct Shadow {
    /// Matrix from the scene's coordinates to texture coordinates (y down) and reversed depth, such that all lit
    /// surfaces are inside.
    from_world: DMat4,
    /// Depth that a surface may lie behind the map and still be lit, a share of the map's range.
    bias: f64,
    /// Distance by which a point is moved off its surface before it is looked up, metres.
    normal_offset_m: f64,
}

impl Shadow {
    /// Map of `side` texels over a scene of any size.
    fn of(scene: &Scene, side: u32) -> Self {
        let (from_world, extent_m) = shadow_from_world(scene);
        let texel_m = extent_m.x.max(extent_m.y) / f64::from(side);
        Self {
            from_world,
            bias: shaders::SHADOW_BIAS_TEXELS * texel_m / extent_m.z,
            normal_offset_m: shaders::SHADOW_NORMAL_OFFSET_TEXELS * texel_m,
        }
    }
}

/// Matrix from the scene's coordinates to texture coordinates (y down) and reversed depth, such that all lit surfaces
/// are inside; and the extent of both, metres.
fn shadow_from_world(scene: &Scene) -> (DMat4, DVec3) {
    let towards_sun = scene.light.sun_direction.as_dvec3().normalize_or(DVec3::Y);
    let side = if towards_sun.y.abs() < 0.99 { DVec3::Y } else { DVec3::Z }.cross(towards_sun).normalize();
    let up = towards_sun.cross(side);
    let sun_from_world =
        DMat4::from_cols(side.extend(0.0), up.extend(0.0), towards_sun.extend(0.0), glam::DVec4::W).transpose();
    let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    let lit = scene.meshes.iter().filter(|mesh| mesh.motion.is_none() && !scene.materials[mesh.material].unlit);
    for position in lit.flat_map(|mesh| &mesh.positions).filter(|position| position.is_finite()) {
        let place = sun_from_world.transform_point3(position.as_dvec3());
        (low, high) = (low.min(place), high.max(place));
    }
    if !low.is_finite() {
        // Nothing is lit, so nothing is looked up.
        return (DMat4::IDENTITY, DVec3::ONE);
    }
    // A flat scene has no extent along one axis.
    let extent = (high - low).max(DVec3::splat(LEAST_EXTENT * (high - low).max_element().max(f64::MIN_POSITIVE)));
    let texture_from_sun = DMat4::from_scale(DVec3::new(1.0, -1.0, 1.0) / extent)
        * DMat4::from_translation(DVec3::new(-low.x, -high.y, -low.z));
    (texture_from_sun * sun_from_world, extent)
}
