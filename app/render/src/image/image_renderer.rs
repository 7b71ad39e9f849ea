//! The `image` method: the bent map, and moving objects over it.

use super::map_quality::MapQuality;
use super::map_renderer::MapRenderer;
use super::moving_parts::MovingParts;
use crate::certainty::{Certainty, Edges, EdgesDrawn};
use crate::gpu::Gpu;
use crate::method::{Method, Sample};
use crate::moving_objects::Axes;
use crate::stats::{DrawCounts, MapStats};
use crate::subject::Subject;
use crate::target::Format;
use crate::world::World;
use glam::DVec2;
use scene::Scene;
use view::{Occasion, Shot};

/// Map of a scene around the eye, and the objects that move over it.
pub struct ImageRenderer {
    map: MapRenderer,
    moving: Option<MovingParts>,
    quality: MapQuality,
}

impl ImageRenderer {
    /// Map of `scene`, for pictures in targets of `format`.
    pub fn new(gpu: &Gpu, scene: &Scene, format: Format, quality: MapQuality) -> Self {
        let moving = MovingParts::of(gpu, scene, quality);
        Self { map: MapRenderer::new(gpu, format, quality, moving.is_some()), moving, quality }
    }
}

impl Method for ImageRenderer {
    fn name(&self) -> &'static str {
        "image"
    }

    fn axes(&self) -> Axes {
        Axes::Observer
    }

    fn maps(&self) -> bool {
        true
    }

    fn prepare_eye(&mut self, gpu: &Gpu, _world: &mut World, shots: &[(Shot, [u32; 2])]) {
        if let Some(moving) = &mut self.moving {
            moving.cut(gpu, shots);
        }
    }

    fn shows_bent_screens(&self) -> bool {
        self.moving.is_none()
    }

    fn prepare_picture(
        &mut self,
        gpu: &Gpu,
        world: &mut World,
        shots: &[(Shot, [u32; 2])],
        pixels: f64,
        subject: Subject,
    ) {
        self.map.draw_map(gpu, world, shots, pixels, subject);
    }

    fn draw(&mut self, gpu: &Gpu, encoder: &mut wgpu::CommandEncoder, sample: Sample<'_>) {
        sample.world.write_views(gpu, &sample.views[..1]);
        if let Some(moving) = &mut self.moving {
            moving.prepare(gpu, &sample);
        }
        let mut pass = sample.target.begin(encoder);
        self.map.draw(gpu, sample.world, &mut pass, (sample.shot.effects, sample.subject), sample.points);
        if let Some(moving) = &self.moving {
            moving.draw(gpu, &mut pass, &sample);
        }
    }

    fn certainty(&self, edges: &Edges, estimate: &dyn Fn(&Edges, EdgesDrawn) -> Certainty) -> Certainty {
        let texels_per_pixel = self.map.stats().texels_per_pixel;
        let of_map = estimate(edges, EdgesDrawn::FromMap { texels_per_pixel });
        let moving = self.moving.as_ref().and_then(MovingParts::edges);
        moving.map_or(of_map, |edges| of_map.or_worse(estimate(edges, EdgesDrawn::InFull)))
    }

    fn take_drawn(&self) -> DrawCounts {
        self.moving.as_ref().map(MovingParts::take_drawn).unwrap_or_default()
    }

    fn map_stats(&self) -> Option<MapStats> {
        Some(self.map.stats())
    }

    fn set_map_texels(&mut self, texels_per_pixel: f64, shift: DVec2) {
        self.quality.texels_per_pixel = texels_per_pixel;
        self.map.set_texels(texels_per_pixel, shift);
    }

    fn draw_in(&mut self, gpu: &Gpu, format: Format, occasion: Occasion, map_scale: Option<f64>) {
        if let Some(texels_per_pixel) = map_scale {
            self.quality = MapQuality { texels_per_pixel, smooth: occasion == Occasion::Ride };
            self.map = MapRenderer::new(gpu, format, self.quality, self.moving.is_some());
        }
    }
}
