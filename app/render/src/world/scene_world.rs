//! A scene's buffers, textures and pipelines, and draws of its views.

use super::draw_list::{Draw, Group};
use super::geometry::{Geometry, OwnAttributes, Sorting};
use super::materials::Materials;
use super::pipelines::{Mode, Pipelines, VertexSource};
use super::shadow_and_light::{Light, casters, draw_map, with_falling};
use super::{panorama, shift_table};
use crate::gpu::Gpu;
use crate::target::Format;
use bytemuck::bytes_of;
use glam::DVec3;
use physics::Observer;
use scene::carriers::SceneCarriers;
use scene::cut::{Cut, SeenFrom};
use scene::irradiance::Irradiance;
use scene::motion::Animated;
use scene::{Lighting, Scene, Texture};
use std::ops::Range;
use std::sync::Arc;

/// Number of views that one submission may draw at first. The buffer grows if more are needed.
const VIEWS: u64 = 64;

/// Largest number of parts in which depth is drawn first: small parts show little that is hidden, and each takes draws
/// of its own. A map of the old town has 9 panes up to 0.5 c, where a frame gains by it, and 53 at 0.99 c, where it
/// loses.
const DEPTH_FIRST_PARTS: usize = 10;

/// A scene that is ready to be drawn.
pub struct World {
    /// Geometry drawn now; `None` until it is first needed.
    geometry: Option<Geometry>,
    /// Scene whose geometry may be needed as a whole; `None` if it is there for good.
    scene: Option<Arc<Scene>>,
    own: OwnAttributes,
    /// Materials that cast shadows, until the sun's depth map is drawn.
    undrawn_casters: Option<Vec<bool>>,
    materials: Materials,
    pipelines: Pipelines,
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
    animated: Vec<Option<Arc<Animated>>>,
    bindings: Bindings,
    views: wgpu::Buffer,
    view_groups: Vec<wgpu::BindGroup>,
}

/// Resources of group 0 that stay the same.
struct Bindings {
    shadow_map: wgpu::TextureView,
    shadow_sampler: wgpu::Sampler,
    shift_table: wgpu::TextureView,
    panorama: (wgpu::TextureView, wgpu::Sampler),
}

/// Settings of a draw.
pub struct Draws<'a> {
    /// Positions to draw: x, y and z streams, and one of log2 D if anything is animated, `stream_stride` bytes
    /// apart. `None` stands for the world's own positions, relative to its origin.
    pub streams: Option<&'a wgpu::Buffer>,
    /// True if the vertex stage bends the vertices that the streams do not hold.
    pub bends: bool,
    /// Kind of values drawn: light, weights or places.
    pub mode: Mode,
    /// Format of the target.
    pub format: Format,
    /// World position of the eye, metres; blended surfaces are drawn from far to near from it.
    pub eye: DVec3,
    /// Sight of each of the scene's motions, in the order of the views after each part's own view. If it is empty,
    /// moving bodies are not drawn.
    pub moving: &'a [SeenFrom],
    /// True if the sky is drawn where there is no opaque surface. Otherwise the target keeps its values there.
    pub sky: bool,
}

/// A part of a target, with its own view.
pub struct TargetPart {
    /// Index of the view among those written.
    pub view: u32,
    /// Rectangle in the target: x, y, width and height in pixels. `None` stands for the whole target.
    pub place: Option<[u32; 4]>,
    /// Planes through the eye that bound the view, as inward unit normals (world axes). `None` leaves nothing out.
    pub planes: Option<[DVec3; 5]>,
}

impl TargetPart {
    /// Whole target, with the view written first.
    pub const WHOLE: Self = Self { view: 0, place: None, planes: None };
}

impl World {
    /// Uploads `scene` with its textures, which are dropped one by one. `background` is a linear radiance that replaces
    /// the scene's sky.
    pub fn new(
        gpu: &Gpu,
        scene: &Scene,
        textures: Vec<Texture>,
        background: Option<[f32; 3]>,
        sorting: Sorting,
    ) -> Self {
        let mut world = Self::without_geometry(gpu, scene, textures, background);
        world.geometry = Some(Geometry::of(gpu, scene, world.own, sorting));
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
        }
    }

    /// Number of triangles of a draw of the whole scene.
    pub fn triangle_count(&self) -> u64 {
        let whole = || self.scene.as_ref().map_or(0, |scene| scene.triangle_count() as u64);
        self.geometry.as_ref().map_or_else(whole, |geometry| {
            let draws = geometry.opaque.iter().chain(&geometry.blended);
            draws.map(|draw| draw.indices.len() as u64 / 3).sum()
        })
    }

    /// Replaces the triangles by those of a cut of the same scene.
    pub fn replace(&mut self, gpu: &Gpu, scene: &Scene, cut: &Cut) {
        self.geometry = Some(Geometry::of_cut(gpu, scene, self.own, cut));
        self.draw_shadows(gpu);
    }

    /// Uploads the whole scene, if nothing of it is there.
    pub fn complete(&mut self, gpu: &Gpu) {
        if let (None, Some(scene)) = (&self.geometry, &self.scene) {
            self.geometry = Some(Geometry::of(gpu, scene, self.own, Sorting::AsTheyCome));
            self.draw_shadows(gpu);
        }
    }

    /// Draws the sun's depth map, unless it is drawn.
    fn draw_shadows(&mut self, gpu: &Gpu) {
        if let (Some(geometry), Some(casters)) = (&self.geometry, self.undrawn_casters.take()) {
            draw_map(gpu, (&self.bindings.shadow_map, &self.lightings[0]), &casters, geometry, &self.pipelines);
        }
    }

    /// Writes the light that falls on animated bodies, for the pictures of the next submissions. `delayed` is true if
    /// light takes its time.
    pub fn light_animated(&self, gpu: &Gpu, observer: &Observer, delayed: bool) {
        let sky = &self.spectra.carriers[self.spectra.sky];
        // No shadow falls on what moves.
        let sun_direction = self.lit_at_rest.sun_direction.with_w(0.0);
        let lighting = shaders::LightingUniforms { sun_direction, ..self.lit_at_rest };
        for (animated, uniform) in self.animated.iter().zip(&self.lightings[1..]) {
            let Some(animated) = animated else { continue };
            let falling = Irradiance::on_animated(&self.light, animated, observer, delayed, sky);
            gpu.queue.write_buffer(uniform, 0, bytes_of(&with_falling(&lighting, &falling)));
        }
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

    /// Draws surfaces and sky into each part of a target.
    pub fn draw(&self, gpu: &Gpu, pass: &mut wgpu::RenderPass<'_>, draws: &Draws<'_>, parts: &[TargetPart]) {
        let source = match draws.streams {
            None => VertexSource::Plain,
            Some(_) if draws.bends => VertexSource::Bent,
            Some(_) => VertexSource::Streams,
        };
        let Some(pipelines) = self.pipelines.get(draws.mode, source, draws.format) else { return };
        let Some(geometry) = &self.geometry else { return };
        let drawn = |draw: &&Draw| draw.motion.is_none_or(|motion| motion < draws.moving.len());
        let mut blended: Vec<&Draw> = geometry.blended.iter().filter(drawn).collect();
        // Moving bodies are sorted by their apparent distance; resting ones by their own place, like everything in a
        // scene at rest.
        let distance = |draw: &Draw| match draw.motion.map(|motion| &draws.moving[motion]) {
            Some(sight) => sight.apparent(draw.centre - self.origin).length(),
            None => draw.centre.distance(draws.eye),
        };
        blended.sort_by(|a, b| distance(b).total_cmp(&distance(a)));

        pass.set_index_buffer(geometry.indices.slice(..), wgpu::IndexFormat::Uint32);
        let is_animated = |motion: usize| self.animated[motion].is_some();
        let stride = geometry.stream_stride;
        if let Some(streams) = draws.streams {
            for axis in 0..3 {
                let start = stride * u64::from(axis);
                pass.set_vertex_buffer(axis, streams.slice(start..start + stride));
            }
            if (0..draws.moving.len()).any(is_animated) {
                pass.set_vertex_buffer(4, streams.slice(3 * stride..));
            }
        }
        let attributes = [&geometry.uvs, &geometry.emissive_uvs, &geometry.colours];
        for (slot, buffer) in [(3, &geometry.surface)].into_iter().chain((5..).zip(attributes)) {
            pass.set_vertex_buffer(slot, buffer.slice(..));
        }

        // Draw each material for all parts in turn: a change of part is cheap, a change of material is not.
        let draw_all = |pass: &mut wgpu::RenderPass<'_>, draw: &Draw| {
            let mut bound = false;
            for part in parts {
                let ranges = ranges(draw, part, draws.eye);
                if ranges.is_empty() {
                    continue;
                }
                if !bound {
                    bound = true;
                    let animated = pipelines.animated.as_ref().filter(|_| draw.motion.is_some_and(is_animated));
                    pass.set_pipeline(&animated.unwrap_or(&pipelines.surface)[draw.material]);
                    pass.set_bind_group(shaders::MATERIAL_GROUP, &self.materials.bind_groups[draw.material], &[]);
                }
                self.go_to(gpu, pass, part, draw.motion);
                ranges.into_iter().for_each(|indices| pass.draw_indexed(indices, 0, 0..1));
            }
        };
        if let Some(depth) = pipelines.depth.as_ref().filter(|_| parts.len() <= DEPTH_FIRST_PARTS) {
            for (sides, pipeline) in depth.by_sides.iter().enumerate() {
                // What brings its own Doppler factors comes from other streams.
                let hides = |draw: &&Draw| {
                    depth.of_material[draw.material] == Some(sides) && !draw.motion.is_some_and(is_animated)
                };
                let hiding: Vec<&Draw> = geometry.opaque.iter().filter(drawn).filter(hides).collect();
                pass.set_pipeline(pipeline);
                self.draw_depth(gpu, pass, draws, parts, &hiding);
            }
        }
        geometry.opaque.iter().filter(drawn).for_each(|draw| draw_all(pass, draw));
        if draws.sky {
            pass.set_pipeline(&pipelines.sky);
            for part in parts {
                self.go_to(gpu, pass, part, None);
                pass.draw(0..3, 0..1);
            }
        }
        blended.into_iter().for_each(|draw| draw_all(pass, draw));
    }

    /// Draws the depth of draws with the pipeline that is set; ranges that follow each other take one call.
    fn draw_depth(
        &self,
        gpu: &Gpu,
        pass: &mut wgpu::RenderPass<'_>,
        draws: &Draws<'_>,
        parts: &[TargetPart],
        drawn: &[&Draw],
    ) {
        for part in parts {
            for motion in std::iter::once(None).chain((0..draws.moving.len()).map(Some)) {
                let mut seen = drawn
                    .iter()
                    .filter(|draw| draw.motion == motion)
                    .flat_map(|draw| ranges(draw, part, draws.eye))
                    .peekable();
                if seen.peek().is_none() {
                    continue;
                }
                self.go_to(gpu, pass, part, motion);
                while let Some(mut range) = seen.next() {
                    while let Some(next) = seen.next_if(|next| next.start == range.end) {
                        range.end = next.end;
                    }
                    pass.draw_indexed(range, 0, 0..1);
                }
            }
        }
    }

    fn go_to(&self, gpu: &Gpu, pass: &mut wgpu::RenderPass<'_>, part: &TargetPart, motion: Option<usize>) {
        self.bind_view(gpu, pass, part.view, motion);
        if let Some([x, y, width, height]) = part.place {
            pass.set_viewport(x as f32, y as f32, width as f32, height as f32, 0.0, 1.0);
            pass.set_scissor_rect(x, y, width, height);
        }
    }
}

/// Ranges of a draw's groups that may be seen in a part. Successive groups form one range.
fn ranges(draw: &Draw, part: &TargetPart, eye: DVec3) -> Vec<Range<u32>> {
    let Some(planes) = &part.planes else { return vec![draw.indices.clone()] };
    let may_be_seen = |group: &&Group| {
        let centre = group.centre - eye;
        planes.iter().all(|plane| plane.dot(centre) >= -group.radius)
    };
    let mut ranges: Vec<Range<u32>> = Vec::new();
    for group in draw.groups.iter().filter(may_be_seen) {
        match ranges.last_mut() {
            Some(last) if last.end == group.indices.start => last.end = group.indices.end,
            _ => ranges.push(group.indices.clone()),
        }
    }
    ranges
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
