//! Refinement: cuts triangles, so that straight edges may bend.
//!
//! The photo-surface is exact at vertices only (W 5.1): between them a renderer draws straight lines where light draws
//! hyperbolas. Here every edge longer than a given length is split, again and again, until none is left.
//!
//! The decision to split an edge depends on its two end points and on nothing else, and the midpoint is the same to
//! the last bit from either side. Two triangles that share an edge therefore split it alike even if they belong to
//! different meshes, so no cracks and no T-junctions appear where there were none. A triangle with three split edges
//! becomes four (red), with two three, with one two (green).
//!
//! If a scene has a circuit, observers stay near it, and edges further away than [`NEAR_M`] may be longer in
//! proportion to their distance. The angle under which an edge is seen counts: a hill on the horizon need not be cut
//! as finely as a kerb.
//!
//! Refinement ends: every new edge is half an old one, or at most √3/2 of the longest edge of the triangle it cuts.

use std::collections::HashMap;
use std::sync::atomic::{AtomicUsize, Ordering};

use glam::{DVec3, Vec3};
use rayon::prelude::*;

use crate::mesh::Mesh;
use crate::scene::{MAX_TRIANGLES, Scene};
use crate::validate::SceneFault;

/// Distance from the circuit within which edges are as short as asked for, metres.
pub const NEAR_M: f64 = 4.0;

/// Number of f32 steps that an edge must span at least. Rounding of midpoints then stays well below the amount by
/// which a split shortens an edge.
const STEPS_PER_EDGE: f32 = 16.0;

/// Reason why a scene cannot be refined.
#[derive(Debug, thiserror::Error)]
pub enum RefineError {
    /// A length that is not a finite number above 0.
    #[error("an edge cannot be {0} m long; use a length above 0, such as --edge 0.5")]
    Edge(f32),
    /// A result with too many triangles.
    #[error(
        "edges of {edge} m would make at least {triangles} triangles of scene \"{scene}\" ({limit} are possible); \
         use --edge {enough} or more"
    )]
    TooMany {
        /// Name of the scene.
        scene: String,
        /// Requested length of edges, metres.
        edge: f32,
        /// Lower bound of their number.
        triangles: u64,
        /// Largest number allowed.
        limit: usize,
        /// Length that stays within the limit, metres.
        enough: f32,
    },
    /// Coordinates that are too large for edges so short.
    #[error(
        "edges of {edge} m are shorter than the coordinates of mesh \"{mesh}\" can resolve; use --edge {enough} or more, \
         or move the mesh closer to the scene's origin"
    )]
    TooFine {
        /// Name of the mesh.
        mesh: String,
        /// Requested length of edges, metres.
        edge: f32,
        /// Shortest length that this mesh allows, metres.
        enough: f32,
    },
    /// A scene that breaks a promise of its types.
    #[error(transparent)]
    Damaged(#[from] SceneFault),
}

/// Refined scene: no edge is longer than `edge` metres. If the scene has a circuit, edges further away from it than
/// [`NEAR_M`] may be longer by their distance over [`NEAR_M`].
///
/// Positions, texture coordinates and colours of new vertices are the means of their edge's ends; normals are too,
/// and are normalised. Vertices are shared within a mesh as they were. Edges with a non-finite end stay as they are,
/// and triangles without area are split like others (they may close a seam). The result does not depend on the number
/// of threads.
///
/// # Errors
/// [`RefineError`], before any memory is taken for the result.
pub fn refine(scene: &Scene, edge: f32) -> Result<Scene, RefineError> {
    refine_within(scene, edge, MAX_TRIANGLES)
}

/// True if [`refine`] would make more than `limit` triangles.
pub fn cut_beyond(scene: &Scene, edge: f32, limit: usize) -> bool {
    let circuit: Vec<DVec3> = scene.circuit.iter().map(|&place| place - scene.origin).collect();
    scene.validate().is_ok() && Rule::new(f64::from(edge), &circuit).count(scene, limit).is_none()
}

fn refine_within(scene: &Scene, edge: f32, limit: usize) -> Result<Scene, RefineError> {
    if !(edge.is_finite() && edge > 0.0) {
        return Err(RefineError::Edge(edge));
    }
    scene.validate()?;
    let circuit: Vec<DVec3> = scene.circuit.iter().map(|&place| place - scene.origin).collect();
    let rule = Rule::new(f64::from(edge), &circuit);
    for mesh in &scene.meshes {
        let enough = STEPS_PER_EDGE * rule.coarsest_step(mesh);
        if edge < enough {
            return Err(RefineError::TooFine { mesh: mesh.name.clone(), edge, enough });
        }
    }
    let limit = limit.max(scene.triangle_count());
    if rule.count(scene, limit).is_none() {
        let triangles = rule.at_least(scene).max(limit as u64 + 1);
        let enough = round_lengths_above(edge)
            .find(|&length| Rule::new(f64::from(length), &circuit).count(scene, limit).is_some())
            .expect("a length above all edges splits none");
        return Err(RefineError::TooMany { scene: scene.name.clone(), edge, triangles, limit, enough });
    }
    Ok(Scene {
        name: scene.name.clone(),
        origin: scene.origin,
        textures: scene.textures.clone(),
        materials: scene.materials.clone(),
        meshes: scene.meshes.par_iter().map(|mesh| refine_mesh(mesh, rule)).collect(),
        motions: scene.motions.clone(),
        light: scene.light,
        lamps: scene.lamps.clone(),
        start: scene.start,
        circuit: scene.circuit.clone(),
        notices: scene.notices.clone(),
        illuminant: scene.illuminant.clone(),
        white: scene.white,
        panorama: scene.panorama.clone(),
    })
}

/// Rule that decides which edges are split: those of finite length above `edge`, or above the longer limit at their
/// distance.
#[derive(Clone, Copy)]
struct Rule<'a> {
    edge: f64,
    squared: f64,
    /// Corners of the circuit, relative to the scene's origin; empty if the scene has none.
    circuit: &'a [DVec3],
}

impl<'a> Rule<'a> {
    fn new(edge: f64, circuit: &'a [DVec3]) -> Self {
        Self { edge, squared: edge * edge, circuit }
    }

    /// True if an edge is to be split; the same from either end, as differences and sums of two do not depend on
    /// their order.
    fn splits(self, a: Vec3, b: Vec3) -> bool {
        let length_squared = distance_squared(a, b);
        length_squared > self.squared
            && length_squared.is_finite()
            && length_squared > self.squared * self.leniency(self.distance(midpoint(a, b).as_dvec3()))
    }

    /// Distance from the circuit's nearest corner, metres; 0 if there is none.
    fn distance(self, place: DVec3) -> f64 {
        let squared = self.circuit.iter().map(|corner| corner.distance_squared(place)).reduce(f64::min);
        squared.unwrap_or(0.0).sqrt()
    }

    /// Square of the factor by which an edge may be longer at a distance from the circuit.
    fn leniency(self, distance: f64) -> f64 {
        (distance / NEAR_M).max(1.0).powi(2)
    }

    /// Midpoints of a triangle's edges (0–1, 1–2, 2–0) that are split.
    fn midpoints(self, [a, b, c]: [Vec3; 3]) -> [Option<Vec3>; 3] {
        [(a, b), (b, c), (c, a)].map(|(a, b)| self.splits(a, b).then(|| midpoint(a, b)))
    }

    /// Number of triangles of the refined scene, or `None` as soon as it exceeds the limit.
    fn count(self, scene: &Scene, limit: usize) -> Option<usize> {
        if self.at_least(scene) > limit as u64 {
            return None;
        }
        let total = AtomicUsize::new(0);
        scene.meshes.par_iter().try_for_each(|mesh| {
            let mut stack = Vec::new();
            triangles(mesh).try_for_each(|triangle| {
                stack.push(triangle);
                let mut count = 0;
                while let Some(triangle) = stack.pop() {
                    let midpoints = self.midpoints(triangle);
                    if midpoints == [None; 3] {
                        count += 1;
                    } else {
                        divide(triangle, midpoints, distance_squared, |child| {
                            stack.push(child);
                        });
                    }
                    if count > limit {
                        return None;
                    }
                }
                (total.fetch_add(count, Ordering::Relaxed) + count <= limit).then_some(())
            })
        })?;
        Some(total.into_inner())
    }

    /// Lower bound of that number without counting: no triangle of the result has more area than the equilateral one.
    fn at_least(self, scene: &Scene) -> u64 {
        let equilateral = 3.0_f64.sqrt() / 4.0 * self.squared;
        let bound = |triangle: [Vec3; 3]| {
            // No place of a triangle is further from the circuit than one corner is, plus the longest way from there.
            let [a, b, c] = triangle;
            let longest = distance_squared(a, b).max(distance_squared(a, c)).sqrt();
            let largest = equilateral * self.leniency(self.distance(a.as_dvec3()) + longest);
            let share = area(triangle) / largest;
            if share.is_finite() { share.max(1.0) } else { 1.0 }
        };
        scene.meshes.iter().flat_map(triangles).map(bound).sum::<f64>() as u64
    }

    /// Distance to the next f32 at the largest coordinate of a triangle that is to be split; 0 if none is.
    fn coarsest_step(self, mesh: &Mesh) -> f32 {
        let split = triangles(mesh).filter(|&triangle| self.midpoints(triangle).iter().any(Option::is_some));
        let largest = split
            .flatten()
            .filter(|corner| corner.is_finite())
            .map(|corner| corner.abs().max_element())
            .fold(0.0, f32::max);
        if f64::from(largest) < self.edge { 0.0 } else { largest.next_up() - largest }
    }
}

/// Triangles of a mesh as positions.
fn triangles(mesh: &Mesh) -> impl Iterator<Item = [Vec3; 3]> {
    mesh.indices.chunks_exact(3).map(|corners| [0, 1, 2].map(|corner| mesh.positions[corners[corner] as usize]))
}

fn distance_squared(a: Vec3, b: Vec3) -> f64 {
    a.as_dvec3().distance_squared(b.as_dvec3())
}

fn area([a, b, c]: [Vec3; 3]) -> f64 {
    let [a, b, c] = [a, b, c].map(|corner| corner.as_dvec3());
    (b - a).cross(c - a).length() / 2.0
}

fn midpoint(a: Vec3, b: Vec3) -> Vec3 {
    a * 0.5 + b * 0.5
}

/// Calls `child` with each of the triangles that one is divided into at its edges' midpoints (0–1, 1–2, 2–0). Winding
/// is kept.
///
/// A quadrilateral is cut along its shorter diagonal, which keeps the angles wide.
pub(crate) fn divide<V: Copy>(
    [a, b, c]: [V; 3],
    midpoints: [Option<V>; 3],
    distance: impl Fn(V, V) -> f64,
    mut child: impl FnMut([V; 3]),
) {
    let mut halves = |a, middle, b, c| {
        child([a, middle, c]);
        child([middle, b, c]);
    };
    match midpoints {
        [None, None, None] => return child([a, b, c]),
        [Some(p), None, None] => return halves(a, p, b, c),
        [None, Some(p), None] => return halves(b, p, c, a),
        [None, None, Some(p)] => return halves(c, p, a, b),
        _ => {}
    }
    // The split edges are a–b at p and b–c at q.
    let mut thirds = |a, p, b, q, c| {
        child([p, b, q]);
        if distance(a, q) <= distance(p, c) {
            child([a, p, q]);
            child([a, q, c]);
        } else {
            child([a, p, c]);
            child([p, q, c]);
        }
    };
    match midpoints {
        [Some(p), Some(q), None] => thirds(a, p, b, q, c),
        [None, Some(p), Some(q)] => thirds(b, p, c, q, a),
        [Some(q), None, Some(p)] => thirds(c, p, a, q, b),
        [Some(p), Some(q), Some(r)] => [[a, p, r], [p, b, q], [r, q, c], [p, q, r]].into_iter().for_each(child),
        _ => {}
    }
}

/// Refines one mesh triangle by triangle, so that neighbours in space stay neighbours in memory.
fn refine_mesh(mesh: &Mesh, rule: Rule<'_>) -> Mesh {
    let mut refined = Mesh { indices: Vec::new(), ..mesh.clone() };
    let mut midpoint_of_edge = HashMap::new();
    let mut stack = Vec::new();
    for corners in mesh.indices.chunks_exact(3) {
        stack.push([corners[0], corners[1], corners[2]]);
        while let Some(corners) = stack.pop() {
            let [a, b, c] = corners;
            let midpoints = [(a, b), (b, c), (c, a)].map(|(a, b)| {
                let ends = [a, b].map(|end| refined.positions[end as usize]);
                rule.splits(ends[0], ends[1]).then(|| {
                    *midpoint_of_edge.entry((a.min(b), a.max(b))).or_insert_with(|| add_midpoint(&mut refined, a, b))
                })
            });
            if midpoints == [None; 3] {
                refined.indices.extend(corners);
            } else {
                let position = |vertex: u32| refined.positions[vertex as usize];
                divide(
                    corners,
                    midpoints,
                    |a, b| distance_squared(position(a), position(b)),
                    |child| stack.push(child),
                );
            }
        }
    }
    refined
}

/// Adds the vertex half way between two others.
fn add_midpoint(mesh: &mut Mesh, a: u32, b: u32) -> u32 {
    let middle = u32::try_from(mesh.positions.len()).expect("MAX_TRIANGLES keeps vertices countable in 32 bits");
    let [a, b] = [a as usize, b as usize];
    mesh.positions.push(midpoint(mesh.positions[a], mesh.positions[b]));
    mesh.normals.push((mesh.normals[a] + mesh.normals[b]).normalize_or(mesh.normals[a]));
    mesh.uvs.push(mesh.uvs[a].midpoint(mesh.uvs[b]));
    mesh.colours.push(std::array::from_fn(|channel| 0.5 * (mesh.colours[a][channel] + mesh.colours[b][channel])));
    middle
}

/// Round lengths above `length`, rising: 1, 2, 5 times a power of ten.
fn round_lengths_above(length: f32) -> impl Iterator<Item = f32> {
    let exponent = length.log10().floor() as i32;
    (exponent..)
        .flat_map(|exponent| [1, 2, 5].map(|digit| format!("{digit}e{exponent}").parse().expect("a decimal number")))
        .filter(move |&round| round > length)
}

#[cfg(test)]
mod tests {
    //! Laws under test: refinement may change where edges run, never what the surface is. No edge is too long; area,
    //! winding and linear attributes are conserved; closed surfaces stay closed, across meshes too. A program that
    //! decides by a triangle instead of an edge leaves T-junctions; one whose midpoints depend on direction leaves
    //! hairline cracks.

    use std::collections::HashMap;

    use glam::{Vec2, Vec3};
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    use super::*;
    use crate::material::Material;

    /// Relative tolerance of areas; each split rounds positions to f32.
    const AREA_TOLERANCE: f64 = 1e-5;

    #[test]
    fn edges_far_from_the_circuit_may_be_longer_in_proportion() {
        let corners = [(-400.0, -400.0), (400.0, -400.0), (400.0, 400.0), (-400.0, 400.0)];
        let positions = corners.map(|(x, z)| Vec3::new(x, 0.0, z)).to_vec();
        let mut scene = Scene { meshes: vec![mesh(positions, vec![0, 2, 1, 0, 3, 2])], ..Default::default() };
        scene.materials.push(Material::default());
        scene.circuit = vec![DVec3::new(-20.0, 0.0, 0.0), DVec3::new(20.0, 0.0, 0.0), DVec3::new(0.0, 0.0, 30.0)];
        let refined = refine(&scene, 0.5).unwrap();
        let mesh = &refined.meshes[0];
        let (mut near, mut far) = (0, 0);
        for [a, b, c] in triangles(mesh) {
            for (a, b) in [(a, b), (b, c), (c, a)] {
                let middle = midpoint(a, b).as_dvec3();
                let distance = scene.circuit.iter().map(|corner| corner.distance(middle)).fold(f64::MAX, f64::min);
                let length = distance_squared(a, b).sqrt();
                assert!(length <= 0.5 * (distance / NEAR_M).max(1.0), "{length} m at {distance} m");
                near += usize::from(distance < NEAR_M);
                far += usize::from(length > 5.0);
            }
        }
        assert!(near > 1000 && far > 100, "{near} near edges, {far} long ones");
        // The whole scene at half a metre would have about ten million triangles.
        assert!(refined.triangle_count() < 200_000, "{}", refined.triangle_count());
    }

    /// Mesh whose texture coordinates and colours are linear in the position.
    fn mesh(positions: Vec<Vec3>, indices: Vec<u32>) -> Mesh {
        Mesh {
            name: "test".into(),
            normals: vec![Vec3::Y; positions.len()],
            uvs: positions.iter().map(|p| linear_uv(*p)).collect(),
            colours: positions.iter().map(|p| linear_colour(*p)).collect(),
            positions,
            indices,
            ..Mesh::default()
        }
    }

    fn linear_uv(p: Vec3) -> Vec2 {
        Vec2::new(0.5 * p.x - p.z, 2.0 + p.y)
    }

    fn linear_colour(p: Vec3) -> [f32; 4] {
        [p.x, p.y, p.z, 1.0 - 0.25 * p.x]
    }

    fn scene(meshes: Vec<Mesh>) -> Scene {
        Scene { name: "test".into(), materials: vec![Material::default()], meshes, ..Scene::default() }
    }

    /// Closed box with shared corners.
    fn cuboid(size: Vec3) -> Mesh {
        let corners = (0..8).map(|i| size * Vec3::new((i & 1) as f32, (i >> 1 & 1) as f32, (i >> 2) as f32));
        let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let indices = quads.iter().flat_map(|q| [q[0], q[1], q[2], q[0], q[2], q[3]]).collect();
        mesh(corners.collect(), indices)
    }

    /// Box as twelve meshes that share no vertices.
    fn exploded(cuboid: &Mesh) -> Vec<Mesh> {
        triangles(cuboid).map(|triangle| mesh(triangle.to_vec(), vec![0, 1, 2])).collect()
    }

    fn longest_edge(scene: &Scene) -> f64 {
        let edges = |[a, b, c]: [Vec3; 3]| [(a, b), (b, c), (c, a)];
        let lengths =
            scene.meshes.iter().flat_map(triangles).flat_map(edges).map(|(a, b)| distance_squared(a, b).sqrt());
        lengths.fold(0.0, f64::max)
    }

    fn total_area(scene: &Scene) -> f64 {
        scene.meshes.iter().flat_map(triangles).map(area).sum()
    }

    /// Count of each directed edge, by the bits of its ends.
    fn directed_edges(scene: &Scene) -> HashMap<[[u32; 3]; 2], usize> {
        let bits = |p: Vec3| p.to_array().map(f32::to_bits);
        let mut edges = HashMap::new();
        for [a, b, c] in scene.meshes.iter().flat_map(triangles) {
            for (from, to) in [(a, b), (b, c), (c, a)] {
                *edges.entry([bits(from), bits(to)]).or_insert(0) += 1;
            }
        }
        edges
    }

    fn assert_watertight(scene: &Scene) {
        let edges = directed_edges(scene);
        for ([from, to], count) in &edges {
            assert_eq!(*count, 1);
            assert_eq!(edges.get(&[*to, *from]), Some(&1), "a crack at {from:?}–{to:?}");
        }
    }

    #[test]
    fn one_long_edge_halves_the_triangle() {
        let triangle = mesh(vec![Vec3::ZERO, Vec3::X * 4.0, Vec3::new(2.0, 1.0, 0.0)], vec![0, 1, 2]);
        let refined = refine(&scene(vec![triangle]), 3.0).unwrap();
        assert_eq!(refined.meshes[0].positions[3], Vec3::X * 2.0);
        assert_eq!(refined.meshes[0].indices.len(), 6);
    }

    #[test]
    fn three_long_edges_make_four_triangles() {
        let triangle = mesh(vec![Vec3::ZERO, Vec3::X * 2.0, Vec3::Y * 2.0], vec![0, 1, 2]);
        let refined = refine(&scene(vec![triangle]), 1.5).unwrap();
        assert_eq!(refined.triangle_count(), 4);
        assert_eq!(refined.vertex_count(), 6, "midpoints are shared");
    }

    #[test]
    fn short_edges_stay_as_they_are() {
        let before = scene(vec![cuboid(Vec3::ONE)]);
        let after = refine(&before, 2.0).unwrap();
        assert_eq!(after.meshes[0].positions, before.meshes[0].positions);
        assert_eq!(after.meshes[0].indices, before.meshes[0].indices);
    }

    #[test]
    fn no_edge_is_longer_and_area_is_conserved() {
        let mut random = ChaCha8Rng::seed_from_u64(1);
        for edge in [0.11_f32, 0.3, 0.77, 2.0] {
            let positions: Vec<Vec3> = (0..30).map(|_| Vec3::from_array(random.random::<[f32; 3]>()) * 9.0).collect();
            let before = scene(vec![mesh(positions, (0..30).collect())]);
            let after = refine(&before, edge).unwrap();
            assert!(longest_edge(&after) <= f64::from(edge));
            let change = total_area(&after) / total_area(&before) - 1.0;
            assert!(change.abs() < AREA_TOLERANCE, "edge {edge}: area changed by {change}");
            assert_eq!(Rule::new(f64::from(edge), &[]).count(&before, MAX_TRIANGLES), Some(after.triangle_count()));
        }
    }

    #[test]
    fn closed_surfaces_stay_closed() {
        let cuboid = cuboid(Vec3::new(3.1, 0.7, 11.3));
        for edge in [0.31, 0.9, 4.0] {
            assert_watertight(&refine(&scene(vec![cuboid.clone()]), edge).unwrap());
        }
    }

    #[test]
    fn meshes_that_meet_are_split_alike() {
        let cuboid = cuboid(Vec3::new(3.1, 0.7, 11.3));
        let whole = refine(&scene(vec![cuboid.clone()]), 0.4).unwrap();
        let parts = refine(&scene(exploded(&cuboid)), 0.4).unwrap();
        assert_watertight(&parts);
        assert_eq!(directed_edges(&whole), directed_edges(&parts));
    }

    #[test]
    fn midpoints_are_the_same_from_either_end() {
        let mut random = ChaCha8Rng::seed_from_u64(2);
        for _ in 0..1000 {
            let [a, b] = [(); 2].map(|()| Vec3::from_array(random.random::<[f32; 3]>()) * 1e3);
            assert_eq!(midpoint(a, b).to_array().map(f32::to_bits), midpoint(b, a).to_array().map(f32::to_bits));
            let rule = Rule::new(500.0, &[]);
            assert_eq!(rule.splits(a, b), rule.splits(b, a));
        }
    }

    #[test]
    fn linear_attributes_stay_linear() {
        let refined = refine(&scene(vec![cuboid(Vec3::new(3.0, 2.0, 5.0))]), 0.2).unwrap();
        let mesh = &refined.meshes[0];
        for (vertex, &position) in mesh.positions.iter().enumerate() {
            assert!(mesh.uvs[vertex].distance(linear_uv(position)) < 1e-5);
            for (given, expected) in mesh.colours[vertex].iter().zip(linear_colour(position)) {
                assert!((given - expected).abs() < 1e-5);
            }
        }
    }

    #[test]
    fn normals_stay_unit_vectors() {
        let mut triangle = mesh(vec![Vec3::ZERO, Vec3::X, Vec3::Z], vec![0, 1, 2]);
        triangle.normals = vec![Vec3::X, Vec3::Y, Vec3::NEG_X];
        let refined = refine(&scene(vec![triangle]), 0.1).unwrap();
        assert!(refined.meshes[0].normals.iter().all(|normal| (normal.length() - 1.0).abs() < 1e-5));
    }

    #[test]
    fn winding_is_kept() {
        let positions = vec![Vec3::ZERO, Vec3::X * 5.0, Vec3::new(1.0, 3.0, 0.0)];
        let refined = refine(&scene(vec![mesh(positions, vec![0, 1, 2])]), 0.6).unwrap();
        for [a, b, c] in triangles(&refined.meshes[0]) {
            assert!((b - a).cross(c - a).z > 0.0);
        }
    }

    #[test]
    fn triangles_without_area_or_numbers_come_to_an_end() {
        let positions = vec![Vec3::ZERO, Vec3::X * 4.0, Vec3::X * 8.0, Vec3::NAN, Vec3::INFINITY, Vec3::Y];
        let indices = vec![0, 1, 2, 0, 0, 2, 1, 1, 1, 0, 2, 3, 0, 4, 5, 3, 4, 3];
        let refined = refine(&scene(vec![mesh(positions, indices)]), 1.0).unwrap();
        for edge in triangles(&refined.meshes[0]).flat_map(|[a, b, c]| [(a, b), (b, c), (c, a)]) {
            let length = distance_squared(edge.0, edge.1).sqrt();
            assert!(length <= 1.0 || !length.is_finite());
        }
    }

    #[test]
    fn thread_count_does_not_change_a_bit() {
        let before = scene(exploded(&cuboid(Vec3::new(3.1, 0.7, 11.3))));
        let with = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            let refined = pool.install(|| refine(&before, 0.4).unwrap());
            refined.meshes.into_iter().map(|mesh| (mesh.positions, mesh.indices)).collect::<Vec<_>>()
        };
        let one = with(1);
        assert_eq!(one, with(2));
        assert_eq!(one, with(8));
    }

    #[test]
    fn too_many_triangles_are_refused_with_a_length_that_works() {
        let before = scene(vec![cuboid(Vec3::splat(10.0))]);
        let error = refine_within(&before, 0.01, 1000).unwrap_err();
        let RefineError::TooMany { triangles, enough, .. } = error else { panic!("{error}") };
        assert!(triangles > 1000);
        let refined = refine_within(&before, enough, 1000).unwrap();
        assert!(refined.triangle_count() <= 1000);
    }

    #[test]
    fn a_whole_town_at_a_micrometre_is_refused_at_once() {
        let error = refine(&scene(vec![cuboid(Vec3::splat(1.0))]), 1e-5).unwrap_err().to_string();
        assert!(error.contains("--edge 0.001 or more"), "{error}");
    }

    #[test]
    fn edges_below_the_resolution_of_f32_are_refused() {
        let far = mesh(vec![Vec3::X * 1e6, Vec3::X * 1e6 + Vec3::Y, Vec3::X * 1e6 + Vec3::Z], vec![0, 1, 2]);
        let error = refine(&scene(vec![far.clone()]), 0.5).unwrap_err();
        assert!(matches!(error, RefineError::TooFine { enough, .. } if enough == 1.0), "{error}");
        assert!(refine(&scene(vec![far]), 1.0).is_ok());
    }

    #[test]
    fn lengths_that_are_none_are_refused() {
        for edge in [0.0, -1.0, f32::NAN, f32::INFINITY] {
            assert!(matches!(refine(&scene(Vec::new()), edge), Err(RefineError::Edge(_))));
        }
    }

    #[test]
    fn damaged_scenes_are_refused() {
        let broken = mesh(vec![Vec3::ZERO], vec![0, 0, 7]);
        let error = refine(&scene(vec![broken]), 1.0).unwrap_err().to_string();
        assert!(error.contains("uses vertex 7 of 1"), "{error}");
    }
}
