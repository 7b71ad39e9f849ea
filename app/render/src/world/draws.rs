//! Draws of a world: its surfaces and its sky, into the parts of a target.

use super::draw_list::Draw;
use super::pipelines::{Mode, VertexSource};
use super::scene_world::World;
use super::seen_draw::SeenDraw;
use crate::gpu::Gpu;
use crate::target::Format;
use glam::DVec3;
use scene::cut::SeenFrom;
use std::ops::Range;
use view::Sides;

/// Number of pixels for each triangle above which depth is drawn first: it saves the light of hidden pixels, and takes
/// the triangles once more. On a software driver frames of the old town, 1280 × 720 pixels, gain by it with 10 pixels
/// a triangle and more, and not with 7 and fewer.
const DEPTH_FIRST_PIXELS: f64 = 8.0;

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
    /// Sight of the resting scene, as it is drawn, then of each motion, in the order of the views of each part. Without
    /// those of the motions, moving bodies are not drawn.
    pub sights: &'a [SeenFrom],
    /// Place of the camera relative to the eye, observer's axes, metres, if it is not there.
    pub outside: Option<DVec3>,
    /// Number of pixels of all parts.
    pub pixels: f64,
    /// Carrier of which weights are drawn, over the depth that a draw of another carrier has left: opaque surfaces
    /// without light on it are left out. `None` draws all over a cleared depth.
    pub further_carrier: Option<usize>,
    /// True if the sky is drawn where there is no opaque surface. Otherwise the target keeps its values there.
    pub sky: bool,
}

/// A part of a target, with its own view.
pub struct TargetPart {
    /// Index of the view among those written.
    pub view: u32,
    /// Rectangle in the target: x, y, width and height in pixels. `None` stands for the whole target.
    pub place: Option<[u32; 4]>,
    /// Sides of the view, observer's axes: what lies beyond them is not drawn.
    pub sides: Sides,
}

/// A draw, and the ranges of the index buffer that each part of a target may show.
struct SeenInParts<'a> {
    draw: &'a Draw,
    ranges: Vec<Vec<Range<u32>>>,
}

impl<'a> SeenInParts<'a> {
    fn new(seen: SeenDraw<'a>, parts: &[TargetPart]) -> Self {
        Self { draw: seen.draw, ranges: parts.iter().map(|part| seen.ranges(&part.sides)).collect() }
    }

    /// Number of triangles in all parts together.
    fn triangle_count(&self) -> usize {
        self.ranges.iter().flatten().map(|range| range.len() / 3).sum()
    }
}

impl World {
    /// Draws surfaces and sky into each part of a target.
    pub fn draw(&self, gpu: &Gpu, pass: &mut wgpu::RenderPass<'_>, draws: &Draws<'_>, parts: &[TargetPart]) {
        let source = match draws.streams {
            None => VertexSource::Plain,
            Some(_) if draws.bends => VertexSource::Bent,
            Some(_) => VertexSource::Streams,
        };
        let Some(pipelines) = self.pipelines.get(draws.mode, source, draws.format) else { return };
        let Some(geometry) = &self.geometry else { return };
        let mut opaque = SeenDraw::all(&geometry.list.opaque, draws.sights, draws.outside, source);
        if let Some(carrier) = draws.further_carrier {
            opaque.retain(|seen| self.spectra.materials[seen.draw.material] == carrier);
        }
        let mut blended = SeenDraw::all(&geometry.list.blended, draws.sights, draws.outside, source);
        blended.sort_by(|a, b| b.distance.total_cmp(&a.distance));
        let opaque: Vec<_> = opaque.into_iter().map(|seen| SeenInParts::new(seen, parts)).collect();
        let blended: Vec<_> = blended.into_iter().map(|seen| SeenInParts::new(seen, parts)).collect();

        pass.set_index_buffer(geometry.indices.slice(..), wgpu::IndexFormat::Uint32);
        let is_animated = |motion: usize| self.animated[motion].is_some();
        let stride = geometry.stream_stride;
        if let Some(streams) = draws.streams {
            for axis in 0..3 {
                let start = stride * u64::from(axis);
                pass.set_vertex_buffer(axis, streams.slice(start..start + stride));
            }
            if (0..draws.sights.len() - 1).any(is_animated) {
                pass.set_vertex_buffer(4, streams.slice(3 * stride..));
            }
        }
        let attributes = [&geometry.uvs, &geometry.emissive_uvs, &geometry.colours];
        for (slot, buffer) in [(3, &geometry.surface)].into_iter().chain((5..).zip(attributes)) {
            pass.set_vertex_buffer(slot, buffer.slice(..));
        }

        // Draw each material for all parts in turn: a change of part is cheap, a change of material is not.
        let draw_all = |pass: &mut wgpu::RenderPass<'_>, seen: &SeenInParts<'_>| {
            let (draw, mut bound) = (seen.draw, false);
            for (part, ranges) in parts.iter().zip(&seen.ranges) {
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
                ranges.iter().for_each(|indices| self.draw_range(pass, indices.clone()));
            }
        };
        let triangles: usize = opaque.iter().map(SeenInParts::triangle_count).sum();
        let pays = draws.further_carrier.is_none() && draws.pixels >= DEPTH_FIRST_PIXELS * triangles as f64;
        if let Some(depth) = pipelines.depth.as_ref().filter(|_| pays) {
            for (sides, pipeline) in depth.by_sides.iter().enumerate() {
                // What brings its own Doppler factors comes from other streams.
                let hides = |seen: &&SeenInParts<'_>| {
                    depth.of_material[seen.draw.material] == Some(sides) && !seen.draw.motion.is_some_and(is_animated)
                };
                let hiding: Vec<_> = opaque.iter().filter(hides).collect();
                pass.set_pipeline(pipeline);
                self.draw_depth(gpu, pass, draws.sights.len() - 1, parts, &hiding);
            }
        }
        opaque.iter().for_each(|draw| draw_all(pass, draw));
        if draws.sky {
            pass.set_pipeline(&pipelines.sky);
            for part in parts {
                self.go_to(gpu, pass, part, None);
                pass.draw(0..3, 0..1);
            }
        }
        blended.iter().for_each(|draw| draw_all(pass, draw));
    }

    /// Draws the depth of draws with the pipeline that is set; ranges that follow each other take one call.
    fn draw_depth(
        &self,
        gpu: &Gpu,
        pass: &mut wgpu::RenderPass<'_>,
        motions: usize,
        parts: &[TargetPart],
        drawn: &[&SeenInParts<'_>],
    ) {
        for (number, part) in parts.iter().enumerate() {
            for motion in std::iter::once(None).chain((0..motions).map(Some)) {
                let mut seen = drawn
                    .iter()
                    .filter(|seen| seen.draw.motion == motion)
                    .flat_map(|seen| seen.ranges[number].iter().cloned())
                    .peekable();
                if seen.peek().is_none() {
                    continue;
                }
                self.go_to(gpu, pass, part, motion);
                while let Some(mut range) = seen.next() {
                    while let Some(next) = seen.next_if(|next| next.start == range.end) {
                        range.end = next.end;
                    }
                    self.draw_range(pass, range);
                }
            }
        }
    }

    fn draw_range(&self, pass: &mut wgpu::RenderPass<'_>, indices: Range<u32>) {
        self.drawn.set(self.drawn.get().with(indices.len() as u64 / 3));
        pass.draw_indexed(indices, 0, 0..1);
    }

    fn go_to(&self, gpu: &Gpu, pass: &mut wgpu::RenderPass<'_>, part: &TargetPart, motion: Option<usize>) {
        self.bind_view(gpu, pass, part.view, motion);
        if let Some([x, y, width, height]) = part.place {
            pass.set_viewport(x as f32, y as f32, width as f32, height as f32, 0.0, 1.0);
            pass.set_scissor_rect(x, y, width, height);
        }
    }
}
