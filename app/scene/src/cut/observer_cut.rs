//! Cutting of a scene's edges one by one, until none is drawn further from its exact place than the pictures allow.

use std::cell::RefCell;
use std::collections::{HashMap, HashSet};
use std::sync::atomic::{AtomicUsize, Ordering};

use glam::DVec3;
use physics::interpolation_error::InterpolationBound;
use rayon::prelude::*;

use super::cut_scene::{Cut, CutMesh, CutVertex, FixedHasher, edge_key};
use super::edge_chord::EdgeChord;
use super::fineness::{CutFineness, CutViewpoint};
use super::seen_from::SeenFrom;
use super::shown_sky::ShownSky;
use crate::mesh::Mesh;
use crate::motion::{ObservedBody, SeenPoint};
use crate::refine::divide;
use crate::scene::Scene;

/// Length below which no edge is cut, metres.
const SHORTEST_M: f64 = 1e-9;

/// Largest interpolation error allowed in log2 D of animated bodies: 1 % of D⁴.
const LOG2_DOPPLER: f64 = 0.0035;

/// Chords no longer than this many times the allowed error are not cut for the sake of their Doppler factor, which
/// may jump at a key.
const DOPPLER_LENGTH: f64 = 8.0;

/// Largest number of triangles that animated bodies are cut into, unless they have nearly as many. Each corner of them
/// is sought on its worldline, which takes a thousand times as long as one at rest.
const ANIMATED_TRIANGLES: usize = 100_000;

/// Number of triangles that are cut together and share their new vertices.
const BATCH: usize = 1024;

impl Cut {
    /// Cuts the scene for its pictures. `before`: the preceding cut, so that edges near the limit stay as they were.
    pub fn new(scene: &Scene, viewpoint: &CutViewpoint, fineness: CutFineness, before: Option<&Self>) -> Self {
        let mut tolerance_px = fineness.tolerance_px;
        loop {
            let rule = CutRule::new(scene, viewpoint, CutFineness { tolerance_px, ..fineness }, before);
            if let Some(cut) = rule.cut(scene, fineness.triangles.max(scene.triangle_count())) {
                return cut;
            }
            tolerance_px *= 2.0;
        }
    }
}

/// Rule that decides which edges are cut.
struct CutRule<'a> {
    sights: Vec<SeenFrom>,
    /// Visible part of the sky, for each picture.
    skies: Vec<ShownSky>,
    fineness: CutFineness,
    before: Option<&'a Cut>,
}

impl<'a> CutRule<'a> {
    fn new(scene: &Scene, viewpoint: &CutViewpoint, fineness: CutFineness, before: Option<&'a Cut>) -> Self {
        let sight = |motion| SeenFrom::new(scene, &viewpoint.observer, motion);
        Self {
            sights: (0..scene.motions.len()).map(Some).chain([None]).map(sight).collect(),
            skies: viewpoint.pictures.iter().map(|(camera, size)| ShownSky::new(camera, *size)).collect(),
            fineness,
            before,
        }
    }

    /// Smallest allowed error over all pictures, radians.
    fn least_allowed(&self) -> f64 {
        self.skies.iter().map(|sky| sky.least_allowed(&self.fineness)).fold(f64::INFINITY, f64::min)
    }

    /// Smallest allowed error of things within a cone over all pictures, radians.
    fn allowed(&self, direction: DVec3, radius: f64) -> f64 {
        let each = self.skies.iter().map(|sky| sky.allowed(direction, radius, &self.fineness));
        each.fold(f64::INFINITY, f64::min)
    }

    /// View of a mesh by the observer.
    fn sight(&self, mesh: &Mesh) -> &SeenFrom {
        &self.sights[mesh.motion.unwrap_or(self.sights.len() - 1)]
    }

    /// Midpoint of an edge, the same from either end; `None` if the edge is not to be cut.
    fn middle(&self, sight: &SeenFrom, known: &SeenCache, a: DVec3, b: DVec3) -> Option<DVec3> {
        let (middle, length) = (0.5 * a + 0.5 * b, a.distance(b));
        // Not cut either: edges with a non-finite end, and edges with no f64 position between their ends.
        if !(length > SHORTEST_M && length.is_finite()) || middle == a || middle == b {
            return None;
        }
        if let Some(body) = &sight.body {
            return self.is_cut(body, known, [a, b]).then_some(middle);
        }
        // Most edges are so small beside their distance that this quick bound is enough.
        let seen = middle - sight.place;
        if sight.bend.bound_anywhere(seen.length(), length) <= self.least_allowed() {
            return None;
        }
        let InterpolationBound { error_rad, direction, radius_rad } = sight.bend.bound(seen, length);
        if error_rad == 0.0 {
            return None;
        }
        let allowed = self.allowed(sight.observer_from_group * direction, radius_rad);
        let stays = || self.before.is_some_and(|before| before.split.contains(&edge_key(a, b)));
        (error_rad > allowed || error_rad > 0.5 * allowed && stays()).then_some(middle)
    }

    /// True if an edge of an animated body is to be cut.
    fn is_cut(&self, body: &ObservedBody, known: &SeenCache, ends: [DVec3; 2]) -> bool {
        let seen = |place| known.seen(body, place);
        let Some(chord) = EdgeChord::of(seen, ends, self.least_allowed()) else { return false };
        let allowed = self.allowed(chord.direction, chord.radius_rad);
        let doppler = chord.error_log2_doppler / LOG2_DOPPLER * allowed;
        let error =
            if chord.length_rad > DOPPLER_LENGTH * allowed { chord.error_rad.max(doppler) } else { chord.error_rad };
        let stays = || self.before.is_some_and(|before| before.split.contains(&edge_key(ends[0], ends[1])));
        error > allowed || error > 0.5 * allowed && stays()
    }

    /// Cuts all meshes; `None` if that makes more triangles than `limit`.
    fn cut(&self, scene: &Scene, limit: usize) -> Option<Cut> {
        let (total, animated_total) = (AtomicUsize::new(0), AtomicUsize::new(0));
        let animated = |mesh: &&Mesh| self.sight(mesh).body.is_some();
        let animated_count: usize = scene.meshes.iter().filter(animated).map(|mesh| mesh.indices.len() / 3).sum();
        let animated_limit = ANIMATED_TRIANGLES.max(2 * animated_count).min(limit);
        let mut split = HashSet::default();
        let mut meshes = Vec::with_capacity(scene.meshes.len());
        for mesh in &scene.meshes {
            let batches: Option<Vec<Batch>> = mesh
                .indices
                .par_chunks(3 * BATCH)
                .map(|corners| match animated(&mesh) {
                    true => self.cut_batch(mesh, corners, &animated_total, animated_limit),
                    false => self.cut_batch(mesh, corners, &total, limit),
                })
                .collect();
            let mut whole = CutMesh::default();
            for batch in batches? {
                let first = whole.vertices.len() as u32;
                whole.vertices.extend(batch.mesh.vertices);
                whole.indices.extend(batch.mesh.indices.into_iter().map(|index| first + index));
                split.extend(batch.split);
            }
            meshes.push(whole);
        }
        Some(Cut { meshes, tolerance_px: self.fineness.tolerance_px, split })
    }

    /// Cuts a few triangles, which share their vertices; `None` if the limit is exceeded.
    fn cut_batch(&self, mesh: &Mesh, corners: &[u32], total: &AtomicUsize, limit: usize) -> Option<Batch> {
        let sight = self.sight(mesh);
        let mut batch = Batch::default();
        let known = SeenCache::default();
        let mut vertex_of_mesh = HashMap::<u32, u32>::new();
        // None: the edge is not cut.
        let mut middles = HashMap::<(u32, u32), Option<u32>>::new();
        let mut stack = Vec::new();
        for corners in corners.chunks_exact(3) {
            let before = batch.mesh.indices.len();
            stack.push([0, 1, 2].map(|corner: usize| {
                let index = corners[corner];
                *vertex_of_mesh.entry(index).or_insert_with(|| batch.push(vertex(mesh, index as usize)))
            }));
            while let Some([a, b, c]) = stack.pop() {
                let midpoints = [(a, b), (b, c), (c, a)].map(|(a, b)| {
                    *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
                        let [from, to] = [a, b].map(|end| batch.mesh.vertices[end as usize]);
                        let middle = self.middle(sight, &known, from.place, to.place)?;
                        batch.split.push(edge_key(from.place, to.place));
                        Some(batch.push(between(&from, &to, middle)))
                    })
                });
                if midpoints == [None; 3] {
                    batch.mesh.indices.extend([a, b, c]);
                } else {
                    let place = |vertex: u32| batch.mesh.vertices[vertex as usize].place;
                    let distance = |a, b| place(a).distance_squared(place(b));
                    divide([a, b, c], midpoints, distance, |child| stack.push(child));
                }
                if batch.mesh.indices.len() / 3 + stack.len() > limit {
                    return None;
                }
            }
            let made = (batch.mesh.indices.len() - before) / 3;
            if total.fetch_add(made, Ordering::Relaxed) + made > limit {
                return None;
            }
        }
        Some(batch)
    }
}

/// Cache of how places of an animated body are seen.
#[derive(Default)]
struct SeenCache(RefCell<HashMap<[u64; 3], Option<SeenPoint>, FixedHasher>>);

impl SeenCache {
    fn seen(&self, body: &ObservedBody, place: DVec3) -> Option<SeenPoint> {
        let key = place.to_array().map(f64::to_bits);
        *self.0.borrow_mut().entry(key).or_insert_with(|| body.seen(place))
    }
}

/// Cut part of a mesh.
#[derive(Default)]
struct Batch {
    mesh: CutMesh,
    split: Vec<u64>,
}

impl Batch {
    fn push(&mut self, vertex: CutVertex) -> u32 {
        self.mesh.vertices.push(vertex);
        self.mesh.vertices.len() as u32 - 1
    }
}

fn vertex(mesh: &Mesh, index: usize) -> CutVertex {
    CutVertex {
        place: mesh.positions[index].as_dvec3(),
        normal: mesh.normals[index],
        uv: mesh.uvs[index],
        emissive_uv: mesh.emissive_uv(index),
        colour: mesh.colours[index],
    }
}

/// Vertex half way between two others.
fn between(a: &CutVertex, b: &CutVertex, place: DVec3) -> CutVertex {
    CutVertex {
        place,
        normal: (a.normal + b.normal).normalize_or(a.normal),
        uv: a.uv.midpoint(b.uv),
        emissive_uv: a.emissive_uv.midpoint(b.emissive_uv),
        colour: std::array::from_fn(|channel| 0.5 * (a.colour[channel] + b.colour[channel])),
    }
}
