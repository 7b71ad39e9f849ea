//! Laws under test: a cut ends, within its number of triangles, wherever the eye is beside a triangle of whatever size,
//! and keeps the surface: the area that was there is there. A program that cuts wherever no error is claimed never
//! ends with the eye in the plane of a large triangle at a high speed.

use std::time::{Duration, Instant};

use glam::Vec2;
use physics::{Celerity, Event, Observer};
use view::Camera;

use super::*;

/// Largest number of triangles.
const LIMIT: usize = 8_000;

/// Time that a cut may take on a loaded machine; one of a million pieces takes a second.
const SOON: Duration = Duration::from_secs(20);

const SIZE: [u32; 2] = [640, 480];

/// Scene of one triangle with these corners.
fn triangle(corners: [Vec3; 3]) -> Scene {
    let mesh = Mesh {
        positions: corners.to_vec(),
        normals: vec![Vec3::Y; 3],
        uvs: vec![Vec2::ZERO; 3],
        colours: vec![[1.0; 4]; 3],
        indices: vec![0, 1, 2],
        ..Mesh::default()
    };
    Scene { meshes: vec![mesh], ..Scene::default() }
}

/// Corners of a triangle of the ground, which is `size` metres wide and lies around the origin.
fn ground(size: f32) -> [Vec3; 3] {
    [Vec3::new(-size, 0.0, -size), Vec3::new(size, 0.0, -size), Vec3::new(0.0, 0.0, size)]
}

fn viewpoint(eye: DVec3, celerity: DVec3, look: DVec3) -> CutViewpoint {
    let celerity = Celerity::new(celerity).expect("a finite celerity");
    CutViewpoint::new(
        Observer { event: Event { ct: 0.0, position: eye }, celerity },
        Camera::looking(look, DVec3::Y, 1.2),
        SIZE,
    )
}

/// Cuts a triangle, and checks that the result is the same surface and small enough.
fn cut(corners: [Vec3; 3], eye: DVec3, celerity: DVec3, look: DVec3) -> Cut {
    let scene = triangle(corners);
    let fineness = CutFineness { tolerance_px: 0.25, turn_rad: 0.0, triangles: LIMIT };
    let started = Instant::now();
    let cut = Cut::new(&scene, &viewpoint(eye, celerity, look), fineness, None);
    let (took, case) = (started.elapsed(), format!("{corners:?} from {eye} at {celerity}"));
    assert!(took < SOON, "{case}: {took:?}");
    assert!((1..=LIMIT).contains(&cut.triangles), "{case}: {} triangles", cut.triangles);
    let (mesh, of) = (&scene.meshes[0], &cut.meshes[0]);
    let doubled = |[a, b, c]: [DVec3; 3]| (b - a).cross(c - a).length();
    let places = |corners: &[u32; 3]| corners.map(|corner| of.place(mesh, corner as usize));
    let area: f64 = of.indices(mesh).as_chunks::<3>().0.iter().map(|corners| doubled(places(corners))).sum();
    let whole = doubled(corners.map(|corner| corner.as_dvec3()));
    assert!((area - whole).abs() <= 1e-6 * whole, "{case}: an area of {area} became {whole}");
    cut
}

#[test]
fn a_cut_ends_with_the_eye_in_the_plane_of_a_triangle_of_any_size() {
    for size in [1e3, 1e7, 1e12, 1e30_f32] {
        let far = f64::from(size);
        // Within it, on an edge, at a corner, and in its plane beside it.
        for eye in [
            DVec3::new(0.3, 0.0, 0.1),
            DVec3::new(0.0, 0.0, -far),
            DVec3::new(0.0, 0.0, far),
            DVec3::new(0.0, 0.0, 1.001 * far),
            DVec3::ZERO,
        ] {
            for speed in [1.0, 1e3, 1e6] {
                for look in [DVec3::Z, DVec3::NEG_Z + 1e-9 * DVec3::X] {
                    cut(ground(size), eye, speed * DVec3::NEG_Z, look);
                }
            }
        }
    }
}

#[test]
fn a_wall_right_behind_at_a_high_speed_needs_few_cuts_without_a_claim() {
    let corners = [Vec3::new(-50.0, -50.0, 0.1), Vec3::new(50.0, -50.0, 0.1), Vec3::new(0.0, 50.0, 0.1)];
    for (away, speed) in [(0.1, 1e6), (1.0, 1e6), (0.1, 1e3), (10.0, 1e6), (0.01, 1e6)] {
        let scene = triangle(corners);
        for eye in [DVec3::new(0.0, 0.0, 0.1 - away), DVec3::new(3.1, 0.7, 0.1 - away)] {
            let viewpoint = viewpoint(eye, speed * DVec3::NEG_Z, DVec3::Z + 1e-9 * DVec3::X);
            let fineness = CutFineness { tolerance_px: 0.5, turn_rad: 0.0, triangles: 8_000_000 };
            let rule = CutRule::new(&scene, &viewpoint, fineness, 0.0, None);
            let cut = rule.cut(&scene, fineness.triangles).expect("few triangles do");
            let unclaimed = rule.unclaimed_cuts.into_inner();
            assert!(unclaimed < 62_500 / 4, "{unclaimed} cuts without a claim for {} triangles", cut.triangles);
        }
    }
}

#[test]
fn a_triangle_without_area_is_cut_to_an_end() {
    for size in [1.0, 1e7, 1e12_f32] {
        let line = [Vec3::NEG_X * size, Vec3::ZERO, Vec3::X * size];
        for eye in [DVec3::ZERO, DVec3::X * 0.5, DVec3::X * f64::from(size), DVec3::Y] {
            for speed in [1.0, 1e6] {
                cut(line, eye, speed * DVec3::X, DVec3::NEG_X);
            }
        }
    }
}

#[test]
fn a_cut_that_is_within_its_number_keeps_its_tolerance() {
    let seen = cut(ground(10.0), DVec3::new(0.2, 3.0, 0.1), DVec3::X, DVec3::NEG_Y);
    assert!(seen.tolerance_px == 0.25 && seen.triangles > 10, "{} px, {}", seen.tolerance_px, seen.triangles);
    // Said where it is not.
    let seen = cut(ground(1e9), DVec3::new(0.3, 0.0, 0.1), 1e6 * DVec3::NEG_Z, DVec3::Z);
    assert!(seen.tolerance_px > 0.25, "{} px", seen.tolerance_px);
}
