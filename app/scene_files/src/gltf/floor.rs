//! Floor of a scene that a person could stand on, and the place on it from which most is seen.

use glam::DVec3;
use rayon::prelude::*;
use scene::{Mesh, Scene, Start};

/// Widths of scenes that are walked on, metres. A smaller one is a thing to look at, a larger one a landscape.
const WALKED: std::ops::RangeInclusive<f64> = 4.0..=400.0;

/// Largest number of triangles of a scene that is searched for a floor, and through which rays are sent.
const MOST_TRIANGLES: usize = 2_000_000;

/// Height of a standing person's eyes above the floor, metres.
const EYE_HEIGHT_M: f64 = 1.6;

/// Share of the box's footprint that a floor covers at least.
const COVERED: f64 = 0.6;

/// Height of a floor above the bottom of the box, as a share of the box's height, at most.
const AT_THE_BOTTOM: f64 = 0.1;

/// Height above the floor that a scene reaches at least, metres: else it is a plate and not a place.
const LEAST_HEIGHT_M: f64 = 1.0;

/// Distance that is free before the eye, metres.
const FREE_M: f64 = 0.8;

/// Directions in which is looked from a place, as tangents to the right of straight ahead.
const DIRECTIONS: [f64; 7] = [-0.6, -0.4, -0.2, 0.0, 0.2, 0.4, 0.6];

/// Start on the floor of a scene with this box in the file's frame; `None` if there is no floor to stand on.
pub(super) fn start(scene: &Scene, [least, most]: [DVec3; 2]) -> Option<Start> {
    let size = most - least;
    let triangles = scene.triangle_count();
    if !WALKED.contains(&size.x.max(size.z)) || triangles > MOST_TRIANGLES {
        return None;
    }
    let solid: Vec<&Mesh> = scene.meshes.iter().filter(|mesh| mesh.solid).collect();
    let height = height(&solid, scene.origin, [least, most])?;
    if most.y - height < LEAST_HEIGHT_M {
        return None;
    }

    // Stand before the middle of each side, a little inside, and look across; or in the middle, if that is a room.
    let middle = (0.5 * (least + most)).with_y(height);
    let half = 0.5 * size * 0.96;
    let [z, x] = [DVec3::Z * half.z, DVec3::X * half.x];
    let [ahead, aside] = [DVec3::NEG_Z, DVec3::NEG_X];
    let places = [(z, ahead), (x, aside), (-z, -ahead), (-x, -aside)];
    let along = if size.x > size.z { aside } else { ahead };
    let inside = [(DVec3::ZERO, along), (DVec3::ZERO, -along)];
    let shapes: Vec<&Mesh> = scene.meshes.iter().filter(|mesh| mesh.motion.is_none()).collect();
    let sight = |eye, ray| nearest(scene, &shapes, eye, ray);
    let best = |places: &[(DVec3, DVec3)]| {
        let seen = places.iter().filter_map(|&(offset, look)| {
            let position = middle + offset;
            let eye = position + DVec3::Y * EYE_HEIGHT_M - scene.origin;
            let below = sight(eye, DVec3::NEG_Y).filter(|(distance, front)| *front && *distance < 1.5 * EYE_HEIGHT_M);
            let right = look.cross(DVec3::Y);
            let rays = DIRECTIONS.map(|aside| (look + aside * right).normalize());
            let met: Vec<(f64, bool)> = rays.iter().filter_map(|ray| sight(eye, *ray)).collect();
            let shown = met.iter().filter(|(_, front)| *front).count();
            let free = below.is_some() && shown > 0 && met.iter().all(|(distance, _)| *distance >= FREE_M);
            free.then_some((shown, Start { position, look, ..Start::default() }))
        });
        // Of places that see the same, the first.
        seen.reduce(|best, next| if next.0 > best.0 { next } else { best }).map(|(_, start)| start)
    };
    best(&places).or_else(|| best(&inside))
}

/// Height of the floor in the file's frame, metres: the mean of what faces up at the bottom of the box, if that covers
/// most of the footprint.
fn height(solid: &[&Mesh], origin: DVec3, [least, most]: [DVec3; 2]) -> Option<f64> {
    let top = least.y + AT_THE_BOTTOM * (most.y - least.y) + 1e-6;
    let (mut area, mut sum) = (0.0, 0.0);
    for mesh in solid {
        for corners in mesh.indices.as_chunks::<3>().0 {
            let [a, b, c] = corners.map(|corner| mesh.positions[corner as usize].as_dvec3() + origin);
            let face = (b - a).cross(c - a);
            let middle = (a.y + b.y + c.y) / 3.0;
            if face.y > 0.9 * face.length() && middle <= top {
                area += 0.5 * face.y;
                sum += 0.5 * face.y * middle;
            }
        }
    }
    let footprint = (most.x - least.x) * (most.z - least.z);
    (footprint > 0.0 && area >= COVERED * footprint).then(|| sum / area)
}

/// Distance along a ray (unit vector, from `eye` relative to the scene's origin) to the nearest triangle, and true if
/// its visible side is met.
fn nearest(scene: &Scene, meshes: &[&Mesh], eye: DVec3, ray: DVec3) -> Option<(f64, bool)> {
    let nearer = |a: (f64, bool), b: (f64, bool)| if b.0 < a.0 { b } else { a };
    let of_mesh = |mesh: &&Mesh| {
        let double_sided = scene.materials[mesh.material].double_sided;
        let met = mesh.indices.as_chunks::<3>().0.iter().filter_map(|corners| {
            let [a, b, c] = corners.map(|corner| mesh.positions[corner as usize].as_dvec3());
            let distance = crossing(eye, ray, [a, b, c])?;
            Some((distance, double_sided || (b - a).cross(c - a).dot(ray) < 0.0))
        });
        met.fold((f64::INFINITY, false), nearer)
    };
    let met = meshes.par_iter().map(of_mesh).reduce(|| (f64::INFINITY, false), nearer);
    met.0.is_finite().then_some(met)
}

/// Distance along a ray to a triangle (Möller and Trumbore 1997).
fn crossing(eye: DVec3, ray: DVec3, [a, b, c]: [DVec3; 3]) -> Option<f64> {
    let (ab, ac) = (b - a, c - a);
    let across = ray.cross(ac);
    let determinant = ab.dot(across);
    if determinant == 0.0 {
        return None;
    }
    let from = eye - a;
    let u = from.dot(across) / determinant;
    let turned = from.cross(ab);
    let v = ray.dot(turned) / determinant;
    let distance = ac.dot(turned) / determinant;
    (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && distance > 0.0).then_some(distance)
}
