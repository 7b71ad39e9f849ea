//! Cutting edges one by one, until none is drawn further from its place than the picture allows.

use std::cell::RefCell;
use std::collections::{HashMap, HashSet};
use std::hash::{BuildHasher, BuildHasherDefault, DefaultHasher};
use std::sync::atomic::{AtomicUsize, Ordering};

use glam::{DVec3, Vec2, Vec3};
use physics::Observer;
use physics::bend::Bound;
use rayon::prelude::*;

use super::sight::{Chord, Sight};
use crate::mesh::Mesh;
use crate::motion::{Course, Seen};
use crate::refine::divide;
use crate::scene::Scene;
use view::Camera;

/// Metres: no edge is cut that is shorter.
const SHORTEST_M: f64 = 1e-9;

/// However far beside the picture, radians: what is drawn further from its place than this could be anywhere.
const LARGEST_ERROR_RAD: f64 = 0.5;

/// By how much log2 D of what is animated may be interpolated wrongly: 1 % of D⁴.
const LOG2_DOPPLER: f64 = 0.0035;

/// Chords that are no longer than so many times what is allowed are not cut for their Doppler factor's sake: at a key it may jump.
const DOPPLER_LENGTH: f64 = 8.0;

/// Triangles that are cut together, and share the vertices that this makes.
const BATCH: usize = 1024;

/// How the edges to be cut are found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fineness {
    /// How far from its place anything may be drawn, pixels.
    pub tolerance_px: f64,
    /// How far the camera may turn until the next cut, radians.
    pub turn_rad: f64,
    /// The most triangles: where that is too few, the tolerance is doubled until it is not.
    pub triangles: usize,
}

/// The pictures that a cut is for: one, or all that one eye sees.
#[derive(Clone, Debug, PartialEq)]
pub struct Viewpoint {
    /// Who looks.
    pub observer: Observer,
    /// Where he looks, and pixels.
    pub pictures: Vec<(Camera, [u32; 2])>,
}

impl Viewpoint {
    /// Of one picture.
    pub fn new(observer: Observer, camera: Camera, size: [u32; 2]) -> Self {
        Self { observer, pictures: vec![(camera, size)] }
    }
}

/// A vertex of a cut.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CutVertex {
    /// Metres relative to the scene's origin.
    pub place: DVec3,
    /// Unit vector, world axes.
    pub normal: Vec3,
    /// Texture coordinates.
    pub uv: Vec2,
    /// Linear colour and opacity.
    pub colour: [f32; 4],
}

/// A scene's triangles, cut.
#[derive(Clone, Debug, Default)]
pub struct Cut {
    /// One a mesh of the scene, in its order.
    pub meshes: Vec<CutMesh>,
    /// The tolerance that was kept, pixels: the one asked for, unless that would have made too many triangles.
    pub tolerance_px: f64,
    /// Edges that were cut, as [`edge_key`]s: given to the next cut, they stay cut until they have no need of it by far.
    pub split: HashSet<u64, Plain>,
}

/// A mesh's triangles, cut.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CutMesh {
    /// Without those that no triangle uses any more.
    pub vertices: Vec<CutVertex>,
    /// Three per triangle.
    pub indices: Vec<u32>,
}

/// Keys are hashes already.
pub type Plain = BuildHasherDefault<DefaultHasher>;

impl Cut {
    /// Cuts the scene for a picture. `before`: the cut whose place this one takes, so that edges on the verge stay as they were.
    pub fn new(scene: &Scene, viewpoint: &Viewpoint, fineness: Fineness, before: Option<&Self>) -> Self {
        let mut tolerance_px = fineness.tolerance_px;
        loop {
            let rule = Rule::new(scene, viewpoint, Fineness { tolerance_px, ..fineness }, before);
            if let Some(cut) = rule.cut(scene, fineness.triangles.max(scene.triangle_count())) {
                return cut;
            }
            tolerance_px *= 2.0;
        }
    }

    /// Triangles of all meshes.
    pub fn triangle_count(&self) -> usize {
        self.meshes.iter().map(|mesh| mesh.indices.len() / 3).sum()
    }

    /// Vertices of all meshes.
    pub fn vertex_count(&self) -> usize {
        self.meshes.iter().map(|mesh| mesh.vertices.len()).sum()
    }
}

/// The same number for an edge from either end.
pub fn edge_key(a: DVec3, b: DVec3) -> u64 {
    let end = |at: DVec3| Plain::default().hash_one(at.to_array().map(f64::to_bits));
    end(a).wrapping_add(end(b))
}

/// Which edges are cut.
struct Rule<'a> {
    sights: Vec<Sight>,
    /// Of each picture.
    frames: Vec<Frame>,
    fineness: Fineness,
    before: Option<&'a Cut>,
}

/// What of the observer's sky the picture shows.
struct Frame {
    /// Unit vector.
    forward: DVec3,
    /// Through the eye and the picture's sides, inward unit normals.
    planes: [DVec3; 4],
    /// Pixels a radian straight ahead.
    focal_length: f64,
    /// Of the angle from its middle to its corners.
    corner_cosine: f64,
}

impl Frame {
    fn new(camera: &Camera, size: [u32; 2]) -> Self {
        let tangents = camera.tangents(size);
        let (low, high, farthest) = (tangents.low, tangents.high, tangents.farthest());
        // Inward, of the side where x or y is that tangent.
        let side = |x: f64, y: f64, tan: f64| camera.observer_from_eye * DVec3::new(x, y, tan).normalize();
        Self {
            forward: camera.observer_from_eye * DVec3::NEG_Z,
            planes: [side(1.0, 0.0, low.x), side(-1.0, 0.0, -high.x), side(0.0, 1.0, low.y), side(0.0, -1.0, -high.y)],
            focal_length: tangents.focal_length(size).max_element(),
            corner_cosine: 1.0 / (1.0 + farthest.length_squared()).sqrt(),
        }
    }

    /// Half the angle by which anything may be drawn wrongly in a corner of the picture: nowhere is less allowed, not even of what was cut
    /// before.
    fn least_allowed(&self, fineness: &Fineness) -> f64 {
        0.5 * fineness.tolerance_px * self.corner_cosine * self.corner_cosine / self.focal_length
    }

    /// The angle by which what lies in a cone may be drawn wrongly.
    fn allowed(&self, direction: DVec3, radius: f64, fineness: &Fineness) -> f64 {
        // A flat picture is a tangent of the angle from straight ahead: an angle there is 1/cos² as long.
        let aside = self.forward.dot(direction).clamp(-1.0, 1.0).acos() + radius;
        let cosine = aside.min(0.5 * std::f64::consts::PI).cos().max(self.corner_cosine);
        let allowed = fineness.tolerance_px * cosine * cosine / self.focal_length;
        let beyond = |plane: &DVec3| -plane.dot(direction).clamp(-1.0, 1.0).asin();
        let gap = self.planes.iter().map(beyond).fold(f64::NEG_INFINITY, f64::max) - radius - fineness.turn_rad;
        allowed.max(gap.min(LARGEST_ERROR_RAD))
    }
}

impl<'a> Rule<'a> {
    fn new(scene: &Scene, viewpoint: &Viewpoint, fineness: Fineness, before: Option<&'a Cut>) -> Self {
        let sight = |motion| Sight::new(scene, &viewpoint.observer, motion);
        Self {
            sights: (0..scene.motions.len()).map(Some).chain([None]).map(sight).collect(),
            frames: viewpoint.pictures.iter().map(|(camera, size)| Frame::new(camera, *size)).collect(),
            fineness,
            before,
        }
    }

    /// Of all pictures the least.
    fn least_allowed(&self) -> f64 {
        self.frames.iter().map(|frame| frame.least_allowed(&self.fineness)).fold(f64::INFINITY, f64::min)
    }

    /// Of all pictures the least.
    fn allowed(&self, direction: DVec3, radius: f64) -> f64 {
        let each = self.frames.iter().map(|frame| frame.allowed(direction, radius, &self.fineness));
        each.fold(f64::INFINITY, f64::min)
    }

    /// Of a mesh.
    fn sight(&self, mesh: &Mesh) -> &Sight {
        &self.sights[mesh.motion.unwrap_or(self.sights.len() - 1)]
    }

    /// The middle of an edge that is to be cut; the same from either end.
    fn middle(&self, sight: &Sight, known: &Known, a: DVec3, b: DVec3) -> Option<DVec3> {
        let (middle, length) = (0.5 * a + 0.5 * b, a.distance(b));
        // Also where an end is nowhere, and where f64 has no place between.
        if !(length > SHORTEST_M && length.is_finite()) || middle == a || middle == b {
            return None;
        }
        if let Some(course) = &sight.course {
            return self.is_cut(course, known, [a, b]).then_some(middle);
        }
        // Most edges are so small beside their distance that nothing more need be asked.
        let seen = middle - sight.place;
        if sight.bend.bound_anywhere(seen.length(), length) <= self.least_allowed() {
            return None;
        }
        let Bound { error_rad, direction, radius_rad } = sight.bend.bound(seen, length);
        if error_rad == 0.0 {
            return None;
        }
        let allowed = self.allowed(sight.observer_from_group * direction, radius_rad);
        let stays = || self.before.is_some_and(|before| before.split.contains(&edge_key(a, b)));
        (error_rad > allowed || error_rad > 0.5 * allowed && stays()).then_some(middle)
    }

    /// Whether an edge of what is animated is to be cut.
    fn is_cut(&self, course: &Course, known: &Known, ends: [DVec3; 2]) -> bool {
        let seen = |place| known.seen(course, place);
        let Some(chord) = Chord::of(seen, ends, self.least_allowed()) else { return false };
        let allowed = self.allowed(chord.direction, chord.radius_rad);
        let doppler = chord.error_log2_doppler / LOG2_DOPPLER * allowed;
        let error =
            if chord.length_rad > DOPPLER_LENGTH * allowed { chord.error_rad.max(doppler) } else { chord.error_rad };
        let stays = || self.before.is_some_and(|before| before.split.contains(&edge_key(ends[0], ends[1])));
        error > allowed || error > 0.5 * allowed && stays()
    }

    /// Cuts everything, unless that makes more triangles than `limit`.
    fn cut(&self, scene: &Scene, limit: usize) -> Option<Cut> {
        let total = AtomicUsize::new(0);
        let mut split = HashSet::default();
        let mut meshes = Vec::with_capacity(scene.meshes.len());
        for mesh in &scene.meshes {
            let batches: Option<Vec<Batch>> = mesh
                .indices
                .par_chunks(3 * BATCH)
                .map(|corners| self.cut_batch(mesh, corners, &total, limit))
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

    /// Cuts a few triangles, which share their vertices.
    fn cut_batch(&self, mesh: &Mesh, corners: &[u32], total: &AtomicUsize, limit: usize) -> Option<Batch> {
        let sight = self.sight(mesh);
        let mut batch = Batch::default();
        let known = Known::default();
        let mut vertex_of_mesh = HashMap::<u32, u32>::new();
        // None: the edge is whole.
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

/// Places of an animated body of which it is known how they are seen.
#[derive(Default)]
struct Known(RefCell<HashMap<[u64; 3], Option<Seen>, Plain>>);

impl Known {
    fn seen(&self, course: &Course, place: DVec3) -> Option<Seen> {
        let key = place.to_array().map(f64::to_bits);
        *self.0.borrow_mut().entry(key).or_insert_with(|| course.seen(place))
    }
}

/// A part of a mesh, cut.
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
        colour: mesh.colours[index],
    }
}

/// The vertex half way between two others.
fn between(a: &CutVertex, b: &CutVertex, place: DVec3) -> CutVertex {
    CutVertex {
        place,
        normal: (a.normal + b.normal).normalize_or(a.normal),
        uv: a.uv.midpoint(b.uv),
        colour: std::array::from_fn(|channel| 0.5 * (a.colour[channel] + b.colour[channel])),
    }
}
