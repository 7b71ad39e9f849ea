//! Moving bodies, drawn over a bent map: a scene of their own, cut for every picture as finely as the map is drawn.

use super::map_quality::MapQuality;
use crate::certainty::Edges;
use crate::gpu::Gpu;
use crate::method::Sample;
use crate::polygon::Adaptive;
use crate::stats::DrawCounts;
use crate::world::{Draws, VertexSource, World};
use scene::{Mesh, Scene};
use std::sync::Arc;
use view::{Occasion, Shot};

/// Tolerance of places, texels of the map: as much as the map's own error.
const TOLERANCE_TEXELS: f64 = 0.5;

/// The moving part of a scene.
pub struct MovingParts {
    world: World,
    adaptive: Adaptive,
}

impl MovingParts {
    /// Moving part of a scene, to be drawn over a map of this quality; `None` if nothing moves in the scene.
    pub fn of(gpu: &Gpu, scene: &Scene, quality: MapQuality) -> Option<Self> {
        let mut moving = moving_part(scene)?;
        // Pictures that are kept use single texels, and wait for their cut. Windows interpolate texels, and do not
        // wait.
        let occasion = if quality.smooth { Occasion::Ride } else { Occasion::Still };
        let tolerance_px = TOLERANCE_TEXELS / quality.texels_per_pixel;
        let textures = std::mem::take(&mut moving.textures);
        let moving = Arc::new(moving);
        let world = World::to_be_cut(gpu, &moving, textures, None);
        Some(Self { world, adaptive: Adaptive::new(moving, tolerance_px, occasion) })
    }

    /// Cuts the moving part for all pictures of one eye, and computes the light that falls on it then.
    pub fn cut(&mut self, gpu: &Gpu, shots: &[(Shot, [u32; 2])]) {
        let Some((shot, _)) = shots.first() else { return };
        self.world.light_animated(gpu, &shot.observer, shot.effects.places);
        self.adaptive.cut(gpu, &mut self.world, shots);
    }

    /// Triangles drawn since the last call of this function, and the calls that drew them.
    pub fn take_drawn(&self) -> DrawCounts {
        self.world.take_drawn()
    }

    /// Sample of the edges of the newest cut.
    pub fn edges(&self) -> Option<&Edges> {
        self.adaptive.edges()
    }

    /// Prepares the drawing of a sample.
    pub fn prepare(&mut self, gpu: &Gpu, sample: &Sample<'_>) {
        self.world.prepare(gpu, sample.mode(), VertexSource::Streams, sample.format);
        self.world.write_views(gpu, &sample.views);
    }

    /// Draws the moving part where nothing hides it.
    pub fn draw(&self, gpu: &Gpu, pass: &mut wgpu::RenderPass<'_>, sample: &Sample<'_>) {
        let streams = self.adaptive.streams();
        if streams.is_none() {
            return;
        }
        let draws = Draws {
            streams,
            bends: false,
            mode: sample.mode(),
            format: sample.format,
            sights: sample.sights,
            outside: None,
            pixels: sample.pixels(),
            further_carrier: None,
            sky: false,
        };
        self.world.draw(gpu, pass, &draws, &[sample.whole()]);
    }
}

/// Moving part of a scene, with the materials and textures that it uses, under the same light; `None` if nothing
/// but clockwork moves.
fn moving_part(scene: &Scene) -> Option<Scene> {
    // Clockwork alone stands in the map.
    if scene.motions.iter().all(|motion| motion.animated().is_some_and(|body| body.stands_in_maps())) {
        return None;
    }
    let mut meshes: Vec<Mesh> = scene.meshes.iter().filter(|mesh| mesh.motion.is_some()).cloned().collect();
    if meshes.is_empty() {
        return None;
    }
    let mut used = Used::default();
    meshes.iter_mut().for_each(|mesh| mesh.material = used.number(mesh.material));
    let mut materials: Vec<_> = used.kept.iter().map(|&index| scene.materials[index].clone()).collect();
    let mut used = Used::default();
    for texture in materials.iter_mut().flat_map(|one| [&mut one.base_colour_texture, &mut one.emissive_texture]) {
        *texture = texture.map(|index| used.number(index));
    }
    Some(Scene {
        name: scene.name.clone(),
        origin: scene.origin,
        textures: used.kept.iter().map(|&index| scene.textures[index].clone()).collect(),
        materials,
        meshes,
        motions: scene.motions.clone(),
        // No shadow falls on what moves.
        light: scene::Lighting { shadows: false, ..scene.light },
        illuminant: scene.illuminant.clone(),
        white: Some(scene.white_luminance()),
        ..Scene::default()
    })
}

/// Indices that are used out of many, in the order of first use.
#[derive(Default)]
struct Used {
    kept: Vec<usize>,
}

impl Used {
    /// New index of what had this old index.
    fn number(&mut self, index: usize) -> usize {
        self.kept.iter().position(|&kept| kept == index).unwrap_or_else(|| {
            self.kept.push(index);
            self.kept.len() - 1
        })
    }
}
