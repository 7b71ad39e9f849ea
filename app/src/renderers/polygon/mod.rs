//! `polygon`: the photo-surface of every vertex (W 5.1), drawn with ordinary rasterisation.
//!
//! Exact at the vertices; between them edges are straight where they should bend, which is what refinement is for.
//! The transform runs beside the render thread (`photo_surface`); it does not depend on where the eye looks, so
//! one [`PolygonRenderer::submit`] serves any number of [`PolygonRenderer::draw`]s. Hidden surfaces by depth are
//! right as they stand: along one line of sight the nearer apparent position is the later emission (W 5.1.1).
//!
//! The plain draw, for comparison, binds the world's positions instead, and costs no transform.

mod geometry;
mod materials;
mod photo_surface;
mod pipelines;
mod sun;

pub use photo_surface::Transformed;

use super::target::{Format, Radiance};
use crate::gpu::{Gpu, GpuError};
use crate::scene::Scene;
use crate::views::matrix;
use bytemuck::bytes_of;
use geometry::{Draw, Geometry};
use glam::{DMat4, DVec3, Mat4};
use materials::Materials;
use photo_surface::PhotoSurface;
use physics::photo_surface::{Eye, PhotoSurfaceError};
use pipelines::Pipelines;
use sun::Light;

/// One scene, ready to be drawn into targets of one format.
pub struct PolygonRenderer {
    geometry: Geometry,
    materials: Materials,
    pipelines: Pipelines,
    photo_surface: PhotoSurface,
    origin: DVec3,
    view: wgpu::Buffer,
    view_group: wgpu::BindGroup,
}

/// Which positions are drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Positions {
    /// The photo-surface uploaded last.
    Apparent,
    /// The plain world around an eye at this world position.
    Plain(DVec3),
}

impl PolygonRenderer {
    /// Uploads `scene` and compiles what draws it. `background`: linear radiance instead of the scene's sky.
    ///
    /// # Errors
    /// [`PhotoSurfaceError::Origin`] if the scene's origin is not finite.
    pub fn new(
        gpu: &Gpu,
        scene: &Scene,
        format: Format,
        background: Option<[f32; 3]>,
    ) -> Result<Self, PhotoSurfaceError> {
        let geometry = Geometry::new(gpu, scene);
        let materials = Materials::new(gpu, scene);
        let pipelines = Pipelines::new(gpu, scene, format, &materials);
        let light = Light::new(gpu, scene, &geometry, &pipelines, background);
        let view = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("view"),
            size: size_of::<shaders::View>() as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let view_group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("view"),
            layout: &pipelines.view_layout,
            entries: &[
                wgpu::BindGroupEntry { binding: 0, resource: view.as_entire_binding() },
                wgpu::BindGroupEntry { binding: 1, resource: light.uniform.as_entire_binding() },
                wgpu::BindGroupEntry { binding: 2, resource: wgpu::BindingResource::TextureView(&light.map) },
                wgpu::BindGroupEntry { binding: 3, resource: wgpu::BindingResource::Sampler(&light.sampler) },
            ],
        });
        Ok(Self {
            photo_surface: PhotoSurface::new(gpu, scene)?,
            origin: scene.origin,
            geometry,
            materials,
            pipelines,
            view,
            view_group,
        })
    }

    /// Begins the transform for an eye, beside whatever is drawn meanwhile.
    ///
    /// # Errors
    /// [`GpuError::Lost`] if the device went away.
    pub fn submit(&mut self, gpu: &Gpu, eye: Eye) -> Result<(), GpuError> {
        self.photo_surface.submit(gpu, eye)
    }

    /// Photo-surfaces begun and not yet received.
    pub fn pending(&self) -> usize {
        self.photo_surface.pending()
    }

    /// Waits for the oldest photo-surface begun and not yet drawn.
    ///
    /// # Errors
    /// [`GpuError::Lost`] if there is none.
    pub fn receive(&mut self) -> Result<Transformed, GpuError> {
        self.photo_surface.receive()
    }

    /// Waits for the oldest photo-surface begun, and throws it away.
    ///
    /// # Errors
    /// [`GpuError::Lost`] if there is none.
    pub fn discard(&mut self) -> Result<(), GpuError> {
        self.photo_surface.discard()
    }

    /// Triangles that every draw takes.
    pub fn triangle_count(&self) -> u64 {
        self.geometry.indices.size() / 12
    }

    /// Makes a photo-surface the one that draws show.
    pub fn upload(&self, encoder: &mut wgpu::CommandEncoder, transformed: Transformed) {
        self.photo_surface.upload(encoder, transformed);
    }

    /// Draws one view. Views of one encoder share its `View`, so each view needs a submission of its own.
    ///
    /// # Arguments
    /// * `eye` — world position of the eye, to draw blended surfaces from far to near.
    pub fn draw(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        target: &Radiance,
        view: &shaders::View,
        positions: Positions,
        eye: DVec3,
    ) {
        let (streams, clip_from_position) = match positions {
            Positions::Apparent => (&self.photo_surface.streams, Mat4::IDENTITY),
            Positions::Plain(eye) => (&self.geometry.plain, matrix(&DMat4::from_translation(self.origin - eye))),
        };
        let view = shaders::View { clip_from_observer: view.clip_from_observer * clip_from_position, ..*view };
        gpu.queue.write_buffer(&self.view, 0, bytes_of(&view));

        let mut blended: Vec<&Draw> = self.geometry.blended.iter().collect();
        blended.sort_by(|a, b| b.centre.distance(eye).total_cmp(&a.centre.distance(eye)));

        let mut pass = target.begin(encoder);
        pass.set_bind_group(shaders::VIEW_GROUP, &self.view_group, &[]);
        pass.set_index_buffer(self.geometry.indices.slice(..), wgpu::IndexFormat::Uint32);
        for axis in 0..3 {
            let start = self.geometry.stream_stride * u64::from(axis);
            pass.set_vertex_buffer(axis, streams.slice(start..start + self.geometry.stream_stride));
        }
        pass.set_vertex_buffer(3, self.geometry.attributes.slice(..));
        self.draw_all(&mut pass, self.geometry.opaque.iter());
        pass.set_pipeline(&self.pipelines.sky);
        pass.draw(0..3, 0..1);
        self.draw_all(&mut pass, blended.into_iter());
    }

    fn draw_all<'a>(&self, pass: &mut wgpu::RenderPass<'_>, draws: impl Iterator<Item = &'a Draw>) {
        for draw in draws {
            pass.set_pipeline(&self.pipelines.surface[draw.material]);
            pass.set_bind_group(shaders::MATERIAL_GROUP, &self.materials.bind_groups[draw.material], &[]);
            pass.draw_indexed(draw.indices.clone(), 0, 0..1);
        }
    }
}
