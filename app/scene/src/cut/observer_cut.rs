//! Cutting of a scene's edges one by one, until none is drawn further from its exact place than the pictures allow.

use std::cell::RefCell;
use std::collections::HashMap;
use std::sync::atomic::{AtomicUsize, Ordering};

use glam::{DVec3, Vec3};
use physics::DirectionCone;
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

/// Factor above one that is larger than the rounding of a length in f32.
const ROUNDED_UP: f64 = 1.0 + 1e-5;

/// Largest number of triangles that animated bodies are cut into, unless they have nearly as many. Each corner of them
/// is sought on its worldline, which takes a thousand times as long as one at rest.
const ANIMATED_TRIANGLES: usize = 100_000;

/// Number of triangles that are cut together and share their new vertices.
const BATCH: usize = 1024;

/// Number of triangles that a batch makes between two looks at the total of all batches.
const COUNTED_TOGETHER: usize = 1024;

/// Number of tries after which the tolerance grows faster than twofold, since little is left of the accuracy.
const PATIENT_TRIES: u32 = 6;

/// Number of tries after which nothing is cut.
const MOST_TRIES: u32 = 16;

/// Share of all triangles that may be made by cuts of edges without a claimed error; a try that makes more has gone
/// astray, and ends at once.
const UNCLAIMED_SHARE: f64 = 1.0 / 16.0;

/// Length over distance above which edges without a claimed error are cut in the second try; it grows with the
/// tolerance.
const FIRST_UNCLAIMED: f64 = 1e-3;

impl Cut {
    /// Cuts the scene for its pictures. `before`: the preceding cut, so that edges near the limit stay as they were.
    ///
    /// The work is bounded for every scene. Where the eye is on a triangle or close to its plane, no error is claimed
    /// for edges that are long beside their distance, however coarse the picture may be. If cutting them all makes too
    /// many triangles, those are cut to a share of their distance that grows with the tolerance, and what remains is
    /// drawn as it is. In the end nothing is cut, and the tolerance is infinite.
    pub fn new(scene: &Scene, viewpoint: &CutViewpoint, fineness: CutFineness, before: Option<&Self>) -> Self {
        let limit = fineness.triangles.max(scene.triangle_count());
        let mut growth = 1.0;
        for tries in 0..MOST_TRIES {
            let tolerance_px = growth * fineness.tolerance_px;
            let unclaimed = if tries == 0 { 0.0 } else { growth * FIRST_UNCLAIMED };
            let rule = CutRule::new(scene, viewpoint, CutFineness { tolerance_px, ..fineness }, unclaimed, before);
            if let Some(cut) = rule.cut(scene, limit) {
                return cut;
            }
            growth *= if tries < PATIENT_TRIES { 2.0 } else { 8.0 };
        }
        let anything = CutFineness { tolerance_px: f64::INFINITY, ..fineness };
        let rule = CutRule::new(scene, viewpoint, anything, f64::INFINITY, before);
        rule.cut(scene, usize::MAX).expect("no number is above the largest")
    }
}

/// Rule that decides which edges are cut.
struct CutRule<'a> {
    sights: Vec<SeenFrom>,
    /// Visible part of the sky, for each picture.
    skies: Vec<ShownSky>,
    /// Place of the cameras relative to the eye, observer's axes, metres, if they are not there.
    outside: Option<DVec3>,
    fineness: CutFineness,
    /// Smallest allowed error over all pictures, radians.
    least_allowed: f64,
    /// Length over distance up to which an edge stays for which no error is claimed.
    unclaimed: f64,
    /// Number of edges that were cut because no error is claimed for them.
    unclaimed_cuts: AtomicUsize,
    before: Option<&'a Cut>,
}

impl<'a> CutRule<'a> {
    fn new(
        scene: &Scene,
        viewpoint: &CutViewpoint,
        fineness: CutFineness,
        unclaimed: f64,
        before: Option<&'a Cut>,
    ) -> Self {
        let sight = |motion| SeenFrom::for_cutting(scene, &viewpoint.observer, motion);
        let skies: Vec<_> = viewpoint.pictures.iter().map(|(camera, size)| ShownSky::new(camera, *size)).collect();
        Self {
            sights: (0..scene.motions.len()).map(Some).chain([None]).map(sight).collect(),
            least_allowed: skies.iter().map(|sky| sky.least_allowed(&fineness)).fold(f64::INFINITY, f64::min),
            skies,
            outside: viewpoint.outside,
            fineness,
            unclaimed,
            unclaimed_cuts: AtomicUsize::new(0),
            before,
        }
    }

    /// Smallest allowed error of things within a cone over all pictures, radians.
    fn allowed(&self, cone: &DirectionCone) -> f64 {
        let each = self.skies.iter().map(|sky| sky.allowed(cone, &self.fineness));
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
        let seen = sight.towards(middle);
        if self.is_short(sight, seen.length(), length) {
            return None;
        }
        let InterpolationBound { error_rad, cone } = match self.outside {
            None => sight.bend.bound(seen, length),
            Some(place) => sight.bend.bound_from(sight.observer_from_group.inverse() * place, seen, length),
        };
        let stays_unclaimed = || self.unclaimed == f64::INFINITY || length <= self.unclaimed * seen.length();
        if error_rad == 0.0 || error_rad == f64::INFINITY && stays_unclaimed() {
            return None;
        }
        if error_rad == f64::INFINITY {
            self.unclaimed_cuts.fetch_add(1, Ordering::Relaxed);
        }
        let allowed = self.allowed(&cone.turned(sight.observer_from_group));
        let stays = || self.before.is_some_and(|before| before.split.contains(&edge_key(a, b)));
        (error_rad > allowed || error_rad > 0.5 * allowed && stays()).then_some(middle)
    }

    /// True if a quick bound shows that no edge is to be cut whose middle is at least this far and which is at most
    /// this long, metres. Most edges are so small beside their distance.
    fn is_short(&self, sight: &SeenFrom, distance: f64, length: f64) -> bool {
        if self.outside.is_some() && !sight.bend.is_straight() {
            return false;
        }
        sight.body.is_none() && sight.bend.bound_anywhere(distance, length) <= self.least_allowed
    }

    /// True if no edge of these triangles is to be cut, and all their corners are finite.
    fn is_whole(&self, mesh: &Mesh, corners: &[u32]) -> bool {
        let sight = self.sight(mesh);
        if sight.body.is_some() || sight.pose.is_some() {
            return false;
        }
        let (mut low, mut high) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
        let mut longest = 0.0_f32;
        let mut sum = Vec3::ZERO;
        for triangle in corners.as_chunks::<3>().0 {
            let [a, b, c] = triangle.map(|corner| mesh.positions[corner as usize]);
            (low, high) = (low.min(a).min(b).min(c), high.max(a).max(b).max(c));
            let edges = [a.distance_squared(b), b.distance_squared(c), c.distance_squared(a)];
            longest = edges.into_iter().fold(longest, f32::max);
            sum += a + b + c;
        }
        // Minimum and maximum pass over what is not a number, the sum does not.
        if !(sum.is_finite() && longest.is_finite()) {
            return false;
        }
        if sight.bend.is_straight() {
            return true;
        }
        let (low, high) = (low.as_dvec3(), high.as_dvec3());
        let nearest = (sight.place - sight.place.clamp(low, high)).length();
        self.is_short(sight, nearest, f64::from(longest).sqrt() * ROUNDED_UP)
    }

    /// True if an edge of an animated body is to be cut.
    fn is_cut(&self, body: &ObservedBody, known: &SeenCache, ends: [DVec3; 2]) -> bool {
        let from = self.outside.unwrap_or(DVec3::ZERO);
        let seen = |place| known.seen(body, place).map(|seen| SeenPoint { apparent: seen.apparent - from, ..seen });
        let Some(chord) = EdgeChord::of(seen, ends, self.least_allowed) else { return false };
        let allowed = self.allowed(&chord.cone);
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
        let mut cut = Cut { tolerance_px: self.fineness.tolerance_px, ..Cut::default() };
        for mesh in &scene.meshes {
            let batches: Option<Vec<Batch>> = mesh
                .indices
                .par_chunks(3 * BATCH)
                .map(|corners| match animated(&mesh) {
                    true => self.cut_batch(mesh, corners, &animated_total, animated_limit),
                    false => self.cut_batch(mesh, corners, &total, limit),
                })
                .collect();
            let batches = batches?;
            let own = mesh.positions.len() as u32;
            let mut whole = CutMesh::default();
            if batches.iter().any(|batch| batch.cut.is_some()) {
                let length = |(batch, corners): (&Batch, &[u32])| batch.cut.as_ref().map_or(corners.len(), Vec::len);
                let length = batches.iter().zip(mesh.indices.chunks(3 * BATCH)).map(length).sum();
                let mut changed = Vec::with_capacity(length);
                for (batch, corners) in batches.into_iter().zip(mesh.indices.chunks(3 * BATCH)) {
                    let first = whole.added.len() as u32;
                    let shifted = |index: u32| if index < own { index } else { index + first };
                    match batch.cut {
                        None => changed.extend_from_slice(corners),
                        Some(indices) => changed.extend(indices.into_iter().map(shifted)),
                    }
                    whole.added.extend(batch.added);
                    cut.split.extend(batch.split);
                }
                whole.changed = Some(changed);
            }
            cut.triangles += whole.indices(mesh).len() / 3;
            cut.vertices += mesh.positions.len() + whole.added.len();
            cut.meshes.push(whole);
        }
        Some(cut)
    }

    /// Cuts a few triangles, which share their new vertices; `None` if the limit is exceeded.
    fn cut_batch(&self, mesh: &Mesh, corners: &[u32], total: &AtomicUsize, limit: usize) -> Option<Batch> {
        let sight = self.sight(mesh);
        let mut batch = Batch::default();
        let most_unclaimed = (UNCLAIMED_SHARE * limit as f64) as usize;
        let count = |made: usize| {
            total.fetch_add(made, Ordering::Relaxed) + made <= limit
                && self.unclaimed_cuts.load(Ordering::Relaxed) <= most_unclaimed
        };
        if self.is_whole(mesh, corners) {
            return count(corners.len() / 3).then_some(batch);
        }
        let mut indices = Vec::with_capacity(corners.len());
        let known = SeenCache::default();
        // None: the edge is not cut.
        let mut middles = HashMap::<(u32, u32), Option<u32>, FixedHasher>::default();
        let mut stack = Vec::new();
        // Triangles that the total has.
        let mut counted = 0;
        for corners in corners.as_chunks::<3>().0 {
            // A corner without a finite place would be drawn at the eye.
            if !corners.iter().all(|&corner| mesh.positions[corner as usize].is_finite()) {
                continue;
            }
            stack.push(*corners);
            while let Some([a, b, c]) = stack.pop() {
                let [at_a, at_b, at_c] = [a, b, c].map(|corner| batch.place(mesh, corner));
                let short = |from: DVec3, to: DVec3| {
                    !sight.is_sought()
                        && self.is_short(sight, sight.towards(0.5 * from + 0.5 * to).length(), from.distance(to))
                };
                if short(at_a, at_b) && short(at_b, at_c) && short(at_c, at_a) {
                    indices.extend([a, b, c]);
                    continue;
                }
                let midpoints = [(a, b), (b, c), (c, a)].map(|(a, b)| {
                    *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
                        let [from, to] = [a, b].map(|end| batch.vertex(mesh, end));
                        let middle = self.middle(sight, &known, from.place, to.place)?;
                        batch.split.push(edge_key(from.place, to.place));
                        batch.added.push(between(&from, &to, middle));
                        Some((mesh.positions.len() + batch.added.len() - 1) as u32)
                    })
                });
                if midpoints == [None; 3] {
                    indices.extend([a, b, c]);
                } else {
                    let place = |vertex: u32| batch.place(mesh, vertex);
                    let distance = |a, b| place(a).distance_squared(place(b));
                    divide([a, b, c], midpoints, distance, |child| stack.push(child));
                }
                let made = indices.len() / 3 + stack.len() - counted;
                if made >= COUNTED_TOGETHER {
                    counted += made;
                    if !count(made) {
                        return None;
                    }
                }
            }
        }
        if !count((indices.len() / 3).saturating_sub(counted)) {
            return None;
        }
        // Nothing is kept of triangles that are as they were.
        if indices != corners {
            batch.cut = Some(indices);
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
    /// Added vertices, numbered after the mesh's own.
    added: Vec<CutVertex>,
    /// Indices of vertices, three per triangle; `None` if they are the mesh's own.
    cut: Option<Vec<u32>>,
    split: Vec<u64>,
}

impl Batch {
    fn place(&self, mesh: &Mesh, index: u32) -> DVec3 {
        let index = index as usize;
        match mesh.positions.get(index) {
            Some(position) => position.as_dvec3(),
            None => self.added[index - mesh.positions.len()].place,
        }
    }

    fn vertex(&self, mesh: &Mesh, index: u32) -> CutVertex {
        let index = index as usize;
        let Some(position) = mesh.positions.get(index) else { return self.added[index - mesh.positions.len()] };
        CutVertex {
            place: position.as_dvec3(),
            normal: mesh.normals[index],
            uv: mesh.uv(index),
            emissive_uv: mesh.emissive_uv(index),
            colour: mesh.colour(index),
        }
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

#[cfg(test)]
#[path = "near_triangle_tests.rs"]
mod tests;
