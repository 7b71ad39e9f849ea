//! Law: the old town as data has the properties that every other part relies on.
//!
//! A wrong program would build another town from the same seed, point a triangle at a missing vertex, leave a normal
//! unnormalised (too bright or black), or put a wall into the rider's way.

use std::collections::BTreeSet;
use std::sync::OnceLock;

use built_in::town;
use glam::{DVec2, DVec3, Vec3, dvec2};
use scene::Scene;

/// Scene built once: painting takes seconds without optimisation.
fn scene() -> &'static Scene {
    static SCENE: OnceLock<Scene> = OnceLock::new();
    SCENE.get_or_init(|| town::build(1))
}

/// Tolerance of a normal's length: a few rounding errors in f32.
const UNIT: f32 = 1e-5;
/// Limit of texture coordinates: one this large has lost a pixel of a 2048-pixel picture to rounding.
const UV: f32 = 1000.0;
/// Limit of tints, which may brighten a dark picture a little.
const TINT: f32 = 1.3;
/// Distance that a rider's shoulders keep from walls, and their range of heights, metres.
const CLEARANCE: f64 = 1.5;
const BODY: [f64; 2] = [0.3, 1.9];

/// Hashes of everything in a scene that is drawn.
fn bits(scene: &Scene) -> Vec<u64> {
    use std::hash::{DefaultHasher, Hash, Hasher};
    let hash = |write: &dyn Fn(&mut DefaultHasher)| {
        let mut hasher = DefaultHasher::new();
        write(&mut hasher);
        hasher.finish()
    };
    let meshes = scene.meshes.iter().map(|mesh| {
        hash(&|hasher| {
            mesh.name.hash(hasher);
            mesh.indices.hash(hasher);
            for (position, normal) in mesh.positions.iter().zip(&mesh.normals) {
                [*position, *normal].map(|v| v.to_array().map(f32::to_bits)).hash(hasher);
            }
            for (uv, colour) in mesh.uvs.iter().zip(&mesh.colours) {
                (uv.to_array().map(f32::to_bits), colour.map(f32::to_bits)).hash(hasher);
            }
        })
    });
    let textures = scene.textures.iter().map(|texture| hash(&|hasher| texture.rgba.hash(hasher)));
    let circuit = hash(&|hasher| scene.circuit.iter().for_each(|p| p.to_array().map(f64::to_bits).hash(hasher)));
    meshes.chain(textures).chain([circuit]).collect()
}

/// Distance on the ground from a point to a segment.
fn distance_to_segment(p: DVec2, a: DVec2, b: DVec2) -> f64 {
    let axis = b - a;
    let along = if axis == DVec2::ZERO { 0.0 } else { ((p - a).dot(axis) / axis.length_squared()).clamp(0.0, 1.0) };
    p.distance(a + along * axis)
}

/// Edges, on the ground, of the part of a solid triangle between two heights; empty if it lies outside them.
fn outline_between(corners: [DVec3; 3], low: f64, high: f64) -> Vec<DVec2> {
    let mut kept = corners.to_vec();
    for (sign, level) in [(1.0, high), (-1.0, -low)] {
        let before = std::mem::take(&mut kept);
        for (k, &p) in before.iter().enumerate() {
            let q = before[(k + 1) % before.len()];
            let (a, b) = (sign * p.y - level, sign * q.y - level);
            if a <= 0.0 {
                kept.push(p);
            }
            if (a < 0.0) != (b < 0.0) && a != b {
                kept.push(p.lerp(q, a / (a - b)));
            }
        }
    }
    kept.iter().map(|p| dvec2(p.x, p.z)).collect()
}

#[test]
fn the_same_seed_builds_the_same_bits() {
    assert_eq!(bits(scene()), bits(&town::build(1)));
}

#[test]
fn another_seed_builds_another_town() {
    let other = town::build(2);
    assert_ne!(bits(scene()), bits(&other));
    assert_eq!(scene().materials.len(), other.materials.len());
}

#[test]
fn it_is_as_coarse_as_a_modeller_would_make_it() {
    let triangles = scene().triangle_count();
    assert!((15_000..=25_000).contains(&triangles), "{triangles} triangles");
    let meshes = scene().meshes.len();
    assert!((30..=400).contains(&meshes), "{meshes} meshes");
}

#[test]
fn every_mesh_is_well_formed() {
    assert_eq!(scene().validate(), Ok(()));
    for mesh in &scene().meshes {
        let count = mesh.positions.len();
        assert_eq!([mesh.normals.len(), mesh.uvs.len(), mesh.colours.len()], [count; 3], "{}", mesh.name);
        assert!(mesh.indices.len().is_multiple_of(3) && !mesh.indices.is_empty(), "{}", mesh.name);
        assert!(mesh.indices.iter().all(|&index| (index as usize) < count), "{}", mesh.name);
        assert!(mesh.material < scene().materials.len(), "{}", mesh.name);
        assert!(mesh.positions.iter().all(|p| p.is_finite() && p.length() < 1000.0), "{}", mesh.name);
        assert!(mesh.normals.iter().all(|n| (n.length() - 1.0).abs() < UNIT), "{}", mesh.name);
        assert!(mesh.uvs.iter().all(|uv| uv.is_finite() && uv.abs().max_element() < UV), "{}", mesh.name);
        assert!(mesh.colours.iter().flatten().all(|value| (0.0..=TINT).contains(value)), "{}", mesh.name);
    }
}

#[test]
fn front_faces_agree_with_their_normals() {
    for mesh in &scene().meshes {
        for triangle in mesh.indices.chunks_exact(3) {
            let [a, b, c] = [0, 1, 2].map(|k| mesh.positions[triangle[k] as usize]);
            let face = (b - a).cross(c - a);
            let normal: Vec3 = triangle.iter().map(|&index| mesh.normals[index as usize]).sum();
            // Leaves have the normals of their crown.
            if !scene().materials[mesh.material].double_sided {
                assert!(face.dot(normal) > 0.0, "{}: {a} {b} {c}", mesh.name);
            }
        }
    }
}

#[test]
fn everything_has_a_name_of_its_own() {
    let names = |names: Vec<&String>| {
        let distinct: BTreeSet<_> = names.iter().collect();
        assert_eq!(distinct.len(), names.len());
        assert!(names.iter().all(|name| !name.is_empty()));
    };
    names(scene().meshes.iter().map(|mesh| &mesh.name).collect());
    names(scene().materials.iter().map(|material| &material.name).collect());
    names(scene().textures.iter().map(|texture| &texture.name).collect());
}

#[test]
fn pictures_are_powers_of_two_within_a_hundred_megabytes() {
    let mut bytes = 0;
    for texture in &scene().textures {
        assert!(texture.width.is_power_of_two() && texture.height.is_power_of_two(), "{}", texture.name);
        assert_eq!(texture.rgba.len(), (texture.width * texture.height * 4) as usize, "{}", texture.name);
        bytes += texture.rgba.len();
    }
    assert!(bytes <= 100_000_000, "{bytes} bytes");
    let used: Vec<usize> = scene().materials.iter().filter_map(|material| material.base_colour_texture).collect();
    assert_eq!(used, (0..scene().textures.len()).collect::<Vec<_>>());
}

#[test]
fn the_circuit_is_closed_smooth_and_nearly_level() {
    let way = &scene().circuit;
    let length: f64 = (0..way.len()).map(|k| way[k].distance(way[(k + 1) % way.len()])).sum();
    assert!((350.0..=600.0).contains(&length), "{length} m");
    for k in 0..way.len() {
        let [a, b, c] = [0, 1, 2].map(|step| way[(k + step) % way.len()]);
        assert!((1.0..=3.0).contains(&a.distance(b)), "step {k}");
        // Radius of the circle through three points of the way.
        let area = (b - a).cross(c - a).length();
        let radius = a.distance(b) * b.distance(c) * c.distance(a) / (2.0 * area);
        assert!(radius >= 6.0, "radius {radius} m at {b}");
        let slope = (b.y - a.y).abs() / a.distance(b);
        assert!(slope < 0.04, "slope {slope} at {b}");
    }
    assert_eq!(scene().start.position, way[0]);
    assert!(scene().start.look.dot((way[1] - way[0]).normalize()) > 0.99);
}

#[test]
fn nothing_solid_stands_in_the_way() {
    let way = &scene().circuit;
    for mesh in scene().meshes.iter().filter(|mesh| mesh.solid) {
        for triangle in mesh.indices.chunks_exact(3) {
            let corners = [0, 1, 2].map(|k| mesh.positions[triangle[k] as usize].as_dvec3());
            for p in way {
                if corners.iter().all(|corner| (*corner - *p).length() > 60.0) {
                    continue;
                }
                let outline = outline_between(corners, p.y + BODY[0], p.y + BODY[1]);
                for (k, &a) in outline.iter().enumerate() {
                    let distance = distance_to_segment(dvec2(p.x, p.z), a, outline[(k + 1) % outline.len()]);
                    assert!(distance >= CLEARANCE, "{} is {distance} m from {p}", mesh.name);
                }
            }
        }
    }
}

#[test]
fn the_ground_carries_the_rider_all_the_way() {
    let way = &scene().circuit;
    for p in way {
        let carried = scene().meshes.iter().filter(|mesh| mesh.solid).any(|mesh| {
            mesh.indices.chunks_exact(3).any(|triangle| {
                let [a, b, c] = [0, 1, 2].map(|k| mesh.positions[triangle[k] as usize].as_dvec3() - *p);
                let side = |p: DVec3, q: DVec3| p.x * q.z - p.z * q.x;
                let (u, v, w) = (side(b, c), side(c, a), side(a, b));
                let sum = u + v + w;
                let inside = sum.abs() > 1e-9 && [u, v, w].iter().all(|part| part / sum >= -1e-6);
                inside && ((u * a.y + v * b.y + w * c.y) / sum).abs() < 0.12
            })
        });
        assert!(carried, "no ground at {p}");
    }
}
