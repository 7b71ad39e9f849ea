//! Cutting edges one by one, until none is drawn further from its place than the picture allows.

use std::cell::RefCell;
use std::collections::{HashMap, HashSet};
use std::hash::{BuildHasher, BuildHasherDefault, DefaultHasher};
use std::sync::atomic::{AtomicUsize, Ordering};

use glam::{DVec3, Vec2, Vec3};
use physics::Observer;
use physics::interpolation_error::InterpolationBound;
use rayon::prelude::*;

use super::sight::{Chord, Sight};
use crate::mesh::Mesh;
use crate::motion::{Course, Seen};
use crate::refine::divide;
use crate::scene::Scene;
use view::Camera;

/// Length below which no edge is cut, metres.
const SHORTEST_M: f64 = 1e-9;

/// Largest error allowed beside the picture, at any distance from it, radians: with a larger one a thing could be
/// drawn anywhere.
const LARGEST_ERROR_RAD: f64 = 0.5;

/// Largest interpolation error allowed in log2 D of animated bodies: 1 % of D⁴.
const LOG2_DOPPLER: f64 = 0.0035;

/// Chords no longer than this many times the allowed error are not cut for the sake of their Doppler factor, which
/// may jump at a key.
const DOPPLER_LENGTH: f64 = 8.0;

/// Number of triangles that are cut together and share their new vertices.
const BATCH: usize = 1024;

/// Accuracy and limits of a cut.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fineness {
    /// Largest allowed distance of anything from its exact place in the picture, pixels.
    pub tolerance_px: f64,
    /// Angle by which the camera may turn until the next cut, radians.
    pub turn_rad: f64,
    /// Largest number of triangles. The tolerance is doubled until the cut stays within it.
    pub triangles: usize,
}

/// Pictures that a cut is for: one, or all that one eye sees.
#[derive(Clone, Debug, PartialEq)]
pub struct Viewpoint {
    /// Observer whose eye sees the pictures.
    pub observer: Observer,
    /// Camera and size in pixels of each picture.
    pub pictures: Vec<(Camera, [u32; 2])>,
}

impl Viewpoint {
    /// Makes a viewpoint with one picture.
    pub fn new(observer: Observer, camera: Camera, size: [u32; 2]) -> Self {
        Self { observer, pictures: vec![(camera, size)] }
    }
}

/// Vertex of a cut.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CutVertex {
    /// Position, metres, relative to the scene's origin.
    pub place: DVec3,
    /// Normal, unit vector, world axes.
    pub normal: Vec3,
    /// Texture coordinates.
    pub uv: Vec2,
    /// Linear colour and opacity of the vertex.
    pub colour: [f32; 4],
}

/// Cut triangles of a scene.
#[derive(Clone, Debug, Default)]
pub struct Cut {
    /// Cut meshes, one for each mesh of the scene, in the same order.
    pub meshes: Vec<CutMesh>,
    /// Tolerance that was kept, pixels: the requested one, unless that would have made too many triangles.
    pub tolerance_px: f64,
    /// Edges that were cut, as [`edge_key`]s. The next cut keeps them cut until their error is below half the allowed
    /// one.
    pub split: HashSet<u64, Plain>,
}

/// Cut triangles of a mesh.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CutMesh {
    /// Vertices that triangles use.
    pub vertices: Vec<CutVertex>,
    /// Indices of vertices, three per triangle.
    pub indices: Vec<u32>,
}

/// Hasher for keys that are hashes already.
pub type Plain = BuildHasherDefault<DefaultHasher>;

impl Cut {
    /// Cuts the scene for its pictures. `before`: the preceding cut, so that edges near the limit stay as they were.
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

    /// Number of triangles of all meshes.
    pub fn triangle_count(&self) -> usize {
        self.meshes.iter().map(|mesh| mesh.indices.len() / 3).sum()
    }

    /// Number of vertices of all meshes.
    pub fn vertex_count(&self) -> usize {
        self.meshes.iter().map(|mesh| mesh.vertices.len()).sum()
    }
}

/// Key of an edge, the same from either end.
pub fn edge_key(a: DVec3, b: DVec3) -> u64 {
    let end = |at: DVec3| Plain::default().hash_one(at.to_array().map(f64::to_bits));
    end(a).wrapping_add(end(b))
}

/// Rule that decides which edges are cut.
struct Rule<'a> {
    sights: Vec<Sight>,
    /// Visible part of the sky, for each picture.
    frames: Vec<Frame>,
    fineness: Fineness,
    before: Option<&'a Cut>,
}

/// Part of the observer's sky that a picture shows.
struct Frame {
    /// Direction straight ahead, unit vector, observer's axes.
    forward: DVec3,
    /// Inward unit normals of the planes through the eye and the picture's sides.
    planes: [DVec3; 4],
    /// Focal length: pixels per radian straight ahead.
    focal_length: f64,
    /// Cosine of the angle from straight ahead to the farthest corner.
    corner_cosine: f64,
}

impl Frame {
    fn new(camera: &Camera, size: [u32; 2]) -> Self {
        let tangents = camera.tangents(size);
        let (low, high, farthest) = (tangents.low, tangents.high, tangents.farthest());
        // Inward normal of the side where x or y is that tangent.
        let side = |x: f64, y: f64, tan: f64| camera.observer_from_eye * DVec3::new(x, y, tan).normalize();
        Self {
            forward: camera.observer_from_eye * DVec3::NEG_Z,
            planes: [side(1.0, 0.0, low.x), side(-1.0, 0.0, -high.x), side(0.0, 1.0, low.y), side(0.0, -1.0, -high.y)],
            focal_length: tangents.focal_length(size).max_element(),
            corner_cosine: 1.0 / (1.0 + farthest.length_squared()).sqrt(),
        }
    }

    /// Half the allowed error in a corner of the picture, radians. No place has a smaller limit, not even an edge
    /// that was cut before.
    fn least_allowed(&self, fineness: &Fineness) -> f64 {
        0.5 * fineness.tolerance_px * self.corner_cosine * self.corner_cosine / self.focal_length
    }

    /// Allowed error of things within a cone, radians.
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

    /// Smallest allowed error over all pictures, radians.
    fn least_allowed(&self) -> f64 {
        self.frames.iter().map(|frame| frame.least_allowed(&self.fineness)).fold(f64::INFINITY, f64::min)
    }

    /// Smallest allowed error of things within a cone over all pictures, radians.
    fn allowed(&self, direction: DVec3, radius: f64) -> f64 {
        let each = self.frames.iter().map(|frame| frame.allowed(direction, radius, &self.fineness));
        each.fold(f64::INFINITY, f64::min)
    }

    /// View of a mesh by the observer.
    fn sight(&self, mesh: &Mesh) -> &Sight {
        &self.sights[mesh.motion.unwrap_or(self.sights.len() - 1)]
    }

    /// Midpoint of an edge, the same from either end; `None` if the edge is not to be cut.
    fn middle(&self, sight: &Sight, known: &Known, a: DVec3, b: DVec3) -> Option<DVec3> {
        let (middle, length) = (0.5 * a + 0.5 * b, a.distance(b));
        // Not cut either: edges with a non-finite end, and edges with no f64 position between their ends.
        if !(length > SHORTEST_M && length.is_finite()) || middle == a || middle == b {
            return None;
        }
        if let Some(course) = &sight.course {
            return self.is_cut(course, known, [a, b]).then_some(middle);
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

    /// Cuts all meshes; `None` if that makes more triangles than `limit`.
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

    /// Cuts a few triangles, which share their vertices; `None` if the limit is exceeded.
    fn cut_batch(&self, mesh: &Mesh, corners: &[u32], total: &AtomicUsize, limit: usize) -> Option<Batch> {
        let sight = self.sight(mesh);
        let mut batch = Batch::default();
        let known = Known::default();
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
struct Known(RefCell<HashMap<[u64; 3], Option<Seen>, Plain>>);

impl Known {
    fn seen(&self, course: &Course, place: DVec3) -> Option<Seen> {
        let key = place.to_array().map(f64::to_bits);
        *self.0.borrow_mut().entry(key).or_insert_with(|| course.seen(place))
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
        colour: mesh.colours[index],
    }
}

/// Vertex half way between two others.
fn between(a: &CutVertex, b: &CutVertex, place: DVec3) -> CutVertex {
    CutVertex {
        place,
        normal: (a.normal + b.normal).normalize_or(a.normal),
        uv: a.uv.midpoint(b.uv),
        colour: std::array::from_fn(|channel| 0.5 * (a.colour[channel] + b.colour[channel])),
    }
}
