//! A scene's buffers, textures and pipelines, and draws of its views.

use super::draw_list::DrawList;
use super::geometry::{Geometry, OwnAttributes};
use super::materials::Materials;
use super::pipelines::{Mode, Pipelines, VertexSource};
use super::shadow_and_light::{Light, casters, draw_map, with_falling};
use super::{panorama, shift_table};
use crate::gpu::Gpu;
use crate::stats::DrawCounts;
use crate::target::Format;
use bytemuck::bytes_of;
use glam::{DAffine3, DMat3, DVec3};
use physics::Observer;
use scene::carriers::SceneCarriers;
use scene::cut::Cut;
use scene::irradiance::Irradiance;
use scene::motion::Animated;
use scene::{Lighting, Scene, Texture};
use std::cell::Cell;
use std::sync::Arc;
use view::Places;

/// Number of views that one submission may draw at first. The buffer grows if more are needed.
const VIEWS: u64 = 64;

/// A scene that is ready to be drawn.
pub struct World {
    /// Geometry drawn now; `None` until it is first needed.
    pub(super) geometry: Option<Geometry>,
    /// Scene whose geometry may be needed as a whole; `None` if it is there for good.
    scene: Option<Arc<Scene>>,
    own: OwnAttributes,
    /// Materials that cast shadows, until the sun's depth map is drawn.
    undrawn_casters: Option<Vec<bool>>,
    pub(super) materials: Materials,
    pub(super) pipelines: Pipelines,
    /// Carriers of the scene, to which the weights belong.
    pub spectra: SceneCarriers,
    /// World position of the scene's origin, metres. Plain positions are relative to it.
    pub origin: DVec3,
    /// Light that falls on the resting scene, then on each motion. The groups of views have the same order.
    lightings: Vec<wgpu::Buffer>,
    /// Light of the scene that every picture needs: it falls on animated bodies differently each time.
    light: Lighting,
    lit_at_rest: shaders::LightingUniforms,
    /// Animated body of each motion, if it is animated.
    pub(super) animated: Vec<Option<Arc<Animated>>>,
    bindings: Bindings,
    views: wgpu::Buffer,
    view_groups: Vec<wgpu::BindGroup>,
    /// Triangles and calls drawn since they were asked for last.
    pub(super) drawn: Cell<DrawCounts>,
}

/// Resources of group 0 that stay the same.
struct Bindings {
    shadow_map: wgpu::TextureView,
    shadow_sampler: wgpu::Sampler,
    shift_table: wgpu::TextureView,
    panorama: (wgpu::TextureView, wgpu::Sampler),
}

impl World {
    /// Uploads `scene` with its textures, which are dropped one by one. `background` is a linear radiance that replaces
    /// the scene's sky.
    pub fn new(gpu: &Gpu, scene: &Scene, textures: Vec<Texture>, background: Option<[f32; 3]>) -> Self {
        let mut world = Self::without_geometry(gpu, scene, textures, background);
        world.geometry = Some(Geometry::new(gpu, scene, world.own, None, DrawList::of(scene, None)));
        world.draw_shadows(gpu);
        world
    }

    /// Uploads all but the geometry of a scene, which is to be cut; the whole is uploaded only if it is needed.
    pub fn to_be_cut(gpu: &Gpu, scene: &Arc<Scene>, textures: Vec<Texture>, background: Option<[f32; 3]>) -> Self {
        let mut world = Self::without_geometry(gpu, scene, textures, background);
        world.scene = Some(Arc::clone(scene));
        world
    }

    fn without_geometry(gpu: &Gpu, scene: &Scene, textures: Vec<Texture>, background: Option<[f32; 3]>) -> Self {
        let spectra = SceneCarriers::of(scene);
        let own = OwnAttributes::of(scene);
        let materials = Materials::new(gpu, scene, textures, &spectra);
        let pipelines = Pipelines::new(gpu, scene, own, &spectra, background.is_some());
        let Light { at_rest: lit_at_rest, uniforms: lightings, map, sampler } =
            Light::new(gpu, scene, &spectra, background);
        let bindings = Bindings {
            shadow_map: map,
            shadow_sampler: sampler,
            shift_table: shift_table::upload(gpu, &spectra),
            panorama: panorama::upload(gpu, scene.panorama.as_ref()),
        };
        let views = views(gpu, VIEWS);
        let view_groups = bindings.groups(gpu, &pipelines.view_layout, &views, &lightings);
        let animated = scene.motions.iter().map(|motion| motion.animated().map(Arc::clone)).collect();
        Self {
            geometry: None,
            scene: None,
            own,
            undrawn_casters: casters(scene),
            materials,
            pipelines,
            spectra,
            origin: scene.origin,
            lightings,
            light: scene.light,
            lit_at_rest,
            animated,
            bindings,
            views,
            view_groups,
            drawn: Cell::default(),
        }
    }

    /// Number of triangles of a draw of the whole scene.
    pub fn triangle_count(&self) -> u64 {
        let whole = || self.scene.as_ref().map_or(0, |scene| scene.triangle_count() as u64);
        self.geometry.as_ref().map_or_else(whole, |geometry| geometry.list.triangle_count())
    }

    /// Triangles and calls drawn since the last call of this function.
    pub fn take_drawn(&self) -> DrawCounts {
        self.drawn.take()
    }

    /// Replaces the triangles by those of a cut of the same scene, with its draws.
    pub fn replace(&mut self, gpu: &Gpu, scene: &Scene, cut: &Cut, list: DrawList) {
        self.geometry = Some(Geometry::new(gpu, scene, self.own, Some(cut), list));
        self.draw_shadows(gpu);
    }

    /// Replaces the triangles of a cut by those of the whole scene.
    pub fn restore(&mut self, gpu: &Gpu, scene: &Scene) {
        self.geometry = Some(Geometry::new(gpu, scene, self.own, None, DrawList::of(scene, None)));
    }

    /// Uploads the whole scene, if nothing of it is there.
    pub fn complete(&mut self, gpu: &Gpu) {
        if let (None, Some(scene)) = (&self.geometry, &self.scene) {
            self.geometry = Some(Geometry::new(gpu, scene, self.own, None, DrawList::of(scene, None)));
            self.draw_shadows(gpu);
        }
    }

    /// Draws the sun's depth map, unless it is drawn.
    fn draw_shadows(&mut self, gpu: &Gpu) {
        if let (Some(geometry), Some(casters)) = (&self.geometry, self.undrawn_casters.take()) {
            draw_map(gpu, (&self.bindings.shadow_map, &self.lightings[0]), &casters, geometry, &self.pipelines);
        }
    }

    /// Writes the light that falls on animated bodies, for the pictures of the next submissions.
    pub fn light_animated(&self, gpu: &Gpu, observer: &Observer, places: Places) {
        let sky = &self.spectra.carriers[self.spectra.sky];
        // No shadow falls on what moves.
        let sun_direction = self.lit_at_rest.sun_direction.with_w(0.0);
        let lighting = shaders::LightingUniforms { sun_direction, ..self.lit_at_rest };
        for (animated, uniform) in self.animated.iter().zip(&self.lightings[1..]) {
            // Clockwork is luminous.
            let Some(animated) = animated.as_ref().filter(|body| !body.is_clockwork()) else { continue };
            let falling = Irradiance::on_animated(&self.light, animated, observer, places, sky);
            gpu.queue.write_buffer(uniform, 0, bytes_of(&with_falling(&lighting, &falling)));
        }
    }

    /// Poses in which clockwork is seen, one for each motion; empty unless all that moves is clockwork. A body that is
    /// not seen has shrunk to nothing.
    pub fn clockwork(&self, observer: &Observer) -> Vec<DAffine3> {
        let stands = |motion: &Option<Arc<Animated>>| motion.as_ref().is_some_and(|body| body.stands_in_maps());
        if !self.animated.iter().all(stands) {
            return Vec::new();
        }
        let unseen = DAffine3 { matrix3: DMat3::ZERO, translation: DVec3::ZERO };
        self.animated.iter().flatten().map(|body| body.pose_shown(observer, Places::Seen).unwrap_or(unseen)).collect()
    }

    /// Layout of the bind group that holds view, light and spectra.
    pub fn view_layout(&self) -> &wgpu::BindGroupLayout {
        &self.pipelines.view_layout
    }

    /// Compiles the pipelines of a mode. A draw in a mode that was not prepared shows nothing.
    pub fn prepare(&mut self, gpu: &Gpu, mode: Mode, source: VertexSource, format: Format) {
        self.pipelines.prepare(gpu, &self.materials, mode, source, format);
    }

    /// Writes the views of the next submission, numbered in order. A submission sees only one writing.
    pub fn write_views(&mut self, gpu: &Gpu, written: &[shaders::ViewUniforms]) {
        let stride = view_stride(gpu);
        if written.len() as u64 * stride > self.views.size() {
            self.views = views(gpu, (written.len() as u64).next_power_of_two());
            self.view_groups = self.bindings.groups(gpu, &self.pipelines.view_layout, &self.views, &self.lightings);
        }
        let mut bytes = vec![0; written.len() * stride as usize];
        for (place, view) in bytes.chunks_exact_mut(stride as usize).zip(written) {
            place[..size_of::<shaders::ViewUniforms>()].copy_from_slice(bytes_of(view));
        }
        gpu.queue.write_buffer(&self.views, 0, &bytes);
    }

    /// Binds group 0 for the view with index `view` of the resting scene (`None`), or for view `view` + 1 + i of
    /// motion i.
    pub fn bind_view(&self, gpu: &Gpu, pass: &mut wgpu::RenderPass<'_>, view: u32, motion: Option<usize>) {
        let further = motion.map_or(0, |motion| 1 + motion);
        let offset = (view + further as u32) * view_stride(gpu) as u32;
        pass.set_bind_group(shaders::VIEW_GROUP, &self.view_groups[further], &[offset]);
    }
}

/// Bytes from one view to the next.
fn view_stride(gpu: &Gpu) -> u64 {
    let alignment = u64::from(gpu.device.limits().min_uniform_buffer_offset_alignment);
    (size_of::<shaders::ViewUniforms>() as u64).next_multiple_of(alignment)
}

fn views(gpu: &Gpu, count: u64) -> wgpu::Buffer {
    gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("views"),
        size: count * view_stride(gpu),
        usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    })
}

impl Bindings {
    fn groups(
        &self,
        gpu: &Gpu,
        layout: &wgpu::BindGroupLayout,
        views: &wgpu::Buffer,
        lightings: &[wgpu::Buffer],
    ) -> Vec<wgpu::BindGroup> {
        lightings.iter().map(|lighting| self.group(gpu, layout, views, lighting)).collect()
    }

    fn group(
        &self,
        gpu: &Gpu,
        layout: &wgpu::BindGroupLayout,
        views: &wgpu::Buffer,
        lighting: &wgpu::Buffer,
    ) -> wgpu::BindGroup {
        let one_view = wgpu::BufferBinding {
            buffer: views,
            offset: 0,
            size: wgpu::BufferSize::new(size_of::<shaders::ViewUniforms>() as u64),
        };
        let resources = [
            wgpu::BindingResource::Buffer(one_view),
            lighting.as_entire_binding(),
            wgpu::BindingResource::TextureView(&self.shadow_map),
            wgpu::BindingResource::Sampler(&self.shadow_sampler),
            wgpu::BindingResource::TextureView(&self.shift_table),
            wgpu::BindingResource::TextureView(&self.panorama.0),
            wgpu::BindingResource::Sampler(&self.panorama.1),
        ];
        bind_group(gpu, "view", layout, resources)
    }
}

/// Bind group with bindings 0, 1, 2….
pub fn bind_group<'a>(
    gpu: &Gpu,
    label: &str,
    layout: &wgpu::BindGroupLayout,
    resources: impl IntoIterator<Item = wgpu::BindingResource<'a>>,
) -> wgpu::BindGroup {
    let entry = |(binding, resource)| wgpu::BindGroupEntry { binding, resource };
    let entries: Vec<_> = (0..).zip(resources).map(entry).collect();
    gpu.device.create_bind_group(&wgpu::BindGroupDescriptor { label: Some(label), layout, entries: &entries })
}
