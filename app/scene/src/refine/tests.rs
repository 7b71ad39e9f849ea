//! Laws under test: refinement may change where edges run, never what the surface is. No edge is too long; area,
//! winding and linear attributes are conserved; closed surfaces stay closed, across meshes too. A program that
//! decides by a triangle instead of an edge leaves T-junctions; one whose midpoints depend on direction leaves
//! hairline cracks.

use std::collections::HashMap;

use glam::{Vec2, Vec3};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::super::NEAR_M;
use super::super::split_rule::{area, triangles};
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
    let lengths = scene.meshes.iter().flat_map(triangles).flat_map(edges).map(|(a, b)| distance_squared(a, b).sqrt());
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
        assert_eq!(SplitRule::new(f64::from(edge), &[]).count(&before, MAX_TRIANGLES), Some(after.triangle_count()));
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
        let rule = SplitRule::new(500.0, &[]);
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
fn the_estimate_is_close_for_triangles_of_any_shape() {
    let mut random = ChaCha8Rng::seed_from_u64(9);
    let (mut counted, mut estimated) = (0.0, 0.0);
    for shape in 0..1000 {
        // From slivers to wide triangles, of a few edges to a hundred.
        let flat = 10.0_f32.powi(-(shape % 5));
        let corner =
            |random: &mut ChaCha8Rng| Vec3::from_array(random.random::<[f32; 3]>()) * Vec3::new(1.0, flat, 0.0);
        let positions = vec![corner(&mut random), corner(&mut random), corner(&mut random)];
        let before = scene(vec![mesh(positions, vec![0, 1, 2])]);
        let rule = SplitRule::new(10.0_f64.powf(random.random_range(-2.0..0.0)), &[]);
        let (count, estimate) = (rule.count(&before, MAX_TRIANGLES).unwrap() as f64, rule.estimate(&before));
        assert!((0.59 * count..=2.2 * count).contains(&estimate), "shape {shape}: {estimate} for {count} triangles");
        (counted, estimated) = (counted + count, estimated + estimate);
    }
    assert!((counted..1.5 * counted).contains(&estimated), "{estimated} for {counted} triangles");
}

#[test]
fn the_corners_of_the_circuit_that_are_kept_for_a_triangle_decide_like_all() {
    let mut random = ChaCha8Rng::seed_from_u64(10);
    let mut place = || Vec3::from_array(random.random::<[f32; 3]>()) * 90.0;
    let circuit: Vec<DVec3> = (0..50).map(|_| place().as_dvec3()).collect();
    let (mut near, mut fewest) = (Vec::new(), circuit.len());
    for _ in 0..300 {
        let (at, size) = (place(), place().x / 90.0 * 20.0);
        let triangle = [at, at + place() / 90.0 * size, at + place() / 90.0 * size];
        let rule = SplitRule::new(0.7, &circuit);
        let before = scene(vec![mesh(triangle.to_vec(), vec![0, 1, 2])]);
        let counted = rule.within(triangle, &mut near).count(&before, MAX_TRIANGLES);
        // Counted without leaving any corner out.
        let mut stack = vec![triangle];
        let mut count = 0;
        while let Some([a, b, c]) = stack.pop() {
            let middles = [(a, b), (b, c), (c, a)].map(|(a, b)| rule.splits(a, b).then(|| midpoint(a, b)));
            match middles {
                [None, None, None] => count += 1,
                _ => divide([a, b, c], middles, distance_squared, |child| stack.push(child)),
            }
        }
        assert_eq!(counted, Some(count));
        fewest = fewest.min(near.len());
    }
    assert!(fewest < 5, "{fewest} corners were kept at least");
}

#[test]
fn a_length_that_is_too_short_is_refused_at_once_beside_a_long_circuit() {
    // Counting 50 million triangles beside a thousand corners takes minutes.
    let mut before = scene(vec![cuboid(Vec3::splat(300.0))]);
    before.circuit = (0..1000).map(|n| DVec3::new(f64::from(n) * 0.3, 0.0, 150.0)).collect();
    let started = std::time::Instant::now();
    let error = refine(&before, 1e-3).unwrap_err();
    assert!(matches!(error, RefineError::TooMany { .. }), "{error}");
    assert!(started.elapsed().as_secs() < 5, "{:?}", started.elapsed());
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
