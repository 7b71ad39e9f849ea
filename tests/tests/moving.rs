//! Law: what moves is seen where its light comes from, in the light's own shift. A sphere that passes keeps a circular outline (Penrose 1959), a cube
//! that passes shows its back, and of two boxes that fly apart each has the Doppler factor of its own motion relative to the observer.
//!
//! A wrong program shows: contracted ovals; no back; both boxes in one brightness, that of the world at rest, or of velocities that were subtracted.
//! What is expected comes from worldlines in the world (`physics::apparent::moving`), not from the objects' own frames, in which the
//! program works.
#![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

use glam::{DVec3, Vec2, Vec3};
use physics::apparent::{Apparent, moving};
use physics::{Beta, Celerity, Event, Observer, Source};
use rapidity::renderers::polygon::{Pace, Tolerance};
use rapidity::renderers::{Effects, Method};
use rapidity::scene::motion::{Motion, Uniform};
use rapidity::scene::refine::refine;
use rapidity::scene::{Material, Mesh, Scene};
use system_tests::photographer::Photographer;
use system_tests::view::{View, middle};

const SIZE: [u32; 2] = [320, 240];

/// Pixels off a circle, root mean square: an even spread over one pixel, 0.29, and a margin for triangles.
const RESIDUAL_TOLERANCE: f64 = 0.4;

/// Pixels that the outline may be from the outermost exact places: half a pixel is lost in looking for it.
const OUTLINE_TOLERANCE: f64 = 0.8;

/// Pixels that anything may be drawn from its exact place.
const PLACE_TOLERANCE: f64 = 0.1;

/// Of light: the table's own error, and f32.
const LIGHT_TOLERANCE: f64 = 0.002;

const GREY: f32 = 0.5;

fn celerity(beta: DVec3) -> Celerity {
    Beta::new(beta).unwrap().celerity()
}

fn methods() -> [Method; 2] {
    [Method::Polygon, Method::Adaptive(Tolerance { pixels: 0.05, pace: Pace::Still })]
}

/// A box about `centre`, of which a face's colour tells where it looks: red to −x, green to +x, grey elsewhere.
fn cuboid(centre: DVec3, half: f64, motion: usize) -> Mesh {
    let mut mesh = Mesh { motion: Some(motion), ..Mesh::default() };
    for axis in [DVec3::X, DVec3::Y, DVec3::Z] {
        for normal in [axis, -axis] {
            let side = normal.any_orthonormal_vector();
            let other = normal.cross(side);
            let first = mesh.positions.len() as u32;
            for (a, b) in [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)] {
                mesh.positions.push((centre + half * (normal + a * side + b * other)).as_vec3());
            }
            let colour = match normal.x {
                x if x < -0.5 => [1.0, 0.0, 0.0, 1.0],
                x if x > 0.5 => [0.0, 1.0, 0.0, 1.0],
                _ => [GREY, GREY, GREY, 1.0],
            };
            mesh.normals.extend([normal.as_vec3(); 4]);
            mesh.colours.extend([colour; 4]);
            mesh.indices.extend([0, 1, 2, 0, 2, 3].map(|corner| first + corner));
        }
    }
    mesh.uvs = vec![Vec2::ZERO; mesh.positions.len()];
    mesh
}

fn scene(meshes: Vec<Mesh>, motions: &[Uniform]) -> Scene {
    let materials = vec![Material { unlit: true, ..Material::default() }];
    Scene { materials, meshes, motions: motions.iter().copied().map(Motion::Uniform).collect(), ..Scene::default() }
}

/// What an observer sees of a place of an object, which its own frame gives: from its worldline in the world.
fn exact(observer: &Observer, motion: &Uniform, place: DVec3) -> Apparent {
    let beta = motion.celerity.beta().vector();
    let gamma = motion.celerity.gamma();
    let along = motion.celerity.direction().unwrap_or(DVec3::X);
    let q = place - motion.anchor.position;
    let now = motion.anchor.position + q - along * (q.dot(along) * (1.0 - 1.0 / gamma));
    let position = now - beta * motion.anchor.ct;
    moving(observer, &Source { position, celerity: motion.celerity })
}

fn observer(position: DVec3, celerity: Celerity) -> Observer {
    Observer { event: Event { ct: 0.0, position }, celerity }
}

#[test]
fn a_sphere_that_passes_keeps_a_circular_outline() {
    let positions = [Vec3::X, Vec3::Y, Vec3::Z, -Vec3::X, -Vec3::Y, -Vec3::Z];
    let octahedron = Mesh {
        positions: positions.to_vec(),
        normals: positions.to_vec(),
        uvs: vec![Vec2::ZERO; 6],
        colours: vec![[1.0; 4]; 6],
        indices: vec![0, 1, 2, 1, 3, 2, 3, 4, 2, 4, 0, 2, 1, 0, 5, 3, 1, 5, 4, 3, 5, 0, 4, 5],
        motion: Some(0),
        ..Mesh::default()
    };
    let sphere = |motion: Uniform| {
        let mut fine = refine(&scene(vec![octahedron.clone()], &[motion]), 0.05).unwrap();
        fine.origin = motion.anchor.position;
        fine.meshes[0].positions.iter_mut().for_each(|position| *position = position.normalize());
        fine
    };
    for along in [4.0, 0.0, -6.0] {
        let anchor = Event { ct: -3.0, position: DVec3::new(along, 0.8, -3.0) };
        let motion = Uniform { celerity: celerity(DVec3::X * 0.9), anchor };
        let scene = sphere(motion);
        for speed in [DVec3::ZERO, DVec3::new(0.1, 0.5, -0.4)] {
            let who = observer(DVec3::ZERO, celerity(speed));
            let mesh = &scene.meshes[0];
            let places = mesh.positions.iter().map(|place| scene.origin + place.as_dvec3());
            let directions: Vec<DVec3> = places.map(|place| exact(&who, &motion, place).position.normalize()).collect();
            let look = directions.iter().sum::<DVec3>().normalize();
            let widest = |axis: DVec3| directions.iter().map(|at| at.angle_between(axis)).fold(0.0, f64::max);
            let fov_degrees = (3.0 * widest(look)).to_degrees().min(120.0);
            let view = View { look, up: DVec3::new(0.3, 0.9, 0.2), fov_degrees, size: SIZE };
            for method in methods() {
                let mut photographer = Photographer::with(&scene, SIZE, 1, Some([0.0; 3]), method);
                let picture = photographer.moving(&view, DVec3::ZERO, who.celerity);
                let white = |column, row| picture.get_pixel(column, row)[0] > 127;
                let mut outline = Vec::new();
                for (column, row) in (0..SIZE[1] - 1).flat_map(|row| (0..SIZE[0] - 1).map(move |column| (column, row)))
                {
                    let [x, y] = middle([column, row]);
                    if white(column, row) != white(column + 1, row) {
                        outline.push(view.direction([x + 0.5, y]));
                    }
                    if white(column, row) != white(column, row + 1) {
                        outline.push(view.direction([x, y + 0.5]));
                    }
                }
                let what = format!("{method:?}, {along} m along, observer at {speed} c");
                assert!(outline.len() > 300, "{what}: {} pixels of outline", outline.len());

                // Points of a circle lie in a plane, n·m = 1.
                let outer = |n: DVec3| glam::DMat3::from_cols(n * n.x, n * n.y, n * n.z);
                let squares = outline.iter().fold(glam::DMat3::ZERO, |sum, &n| sum + outer(n));
                let normal = squares.inverse() * outline.iter().sum::<DVec3>();
                let (axis, radius) = (normal.normalize(), (1.0 / normal.length()).acos());
                let off = outline.iter().map(|n| (n.angle_between(axis) - radius).powi(2)).sum::<f64>();
                let residual = (off / outline.len() as f64).sqrt() * view.focal_length();
                assert!(residual < RESIDUAL_TOLERANCE, "{what}: {residual} pixels off a circle");
                let size = (widest(axis) - radius).abs() * view.focal_length();
                assert!(size < OUTLINE_TOLERANCE, "{what}: {size} pixels from the exact outline");
            }
        }
    }
}

#[test]
fn a_cube_that_passes_shows_its_back() {
    // It is abeam when the light leaves it that arrives now.
    let anchor = Event { ct: -10.0, position: DVec3::NEG_Z * 10.0 };
    let view = View { look: DVec3::NEG_Z, up: DVec3::Y, fov_degrees: 30.0, size: SIZE };
    for method in methods() {
        for (speed, back) in [(0.9, true), (0.0, false)] {
            let motion = Uniform { celerity: celerity(DVec3::X * speed), anchor };
            let scene = scene(vec![cuboid(anchor.position, 1.0, 0)], &[motion]);
            let scene = refine(&scene, 0.2).unwrap();
            let mut photographer = Photographer::with(&scene, SIZE, 1, Some([0.0; 3]), method);
            let picture = photographer.moving(&view, DVec3::ZERO, Celerity::ZERO);
            let count = |is: fn(&[u8; 4]) -> bool| picture.pixels().filter(|pixel| is(&pixel.0)).count();
            let (red, green) =
                (count(|rgba| rgba[0] > 200 && rgba[1] < 50), count(|rgba| rgba[1] > 200 && rgba[0] < 50));
            // Turned by arcsin β, it shows 0.9 of its back's width: more than of its side.
            assert_eq!(red > 2000, back, "{method:?} at {speed} c: {red} pixels of its back");
            assert_eq!(green, 0, "{method:?} at {speed} c: pixels of its front");
        }
    }
}

#[test]
fn each_body_has_the_doppler_factor_of_its_own_relative_motion() {
    let half = DVec3::X * 0.5;
    let away = Uniform { celerity: celerity(half), anchor: Event { ct: 0.0, position: DVec3::new(24.0, 1.5, 0.0) } };
    let hither =
        Uniform { celerity: celerity(-half), anchor: Event { ct: 1.0, position: DVec3::new(20.0, -1.5, 1.0) } };
    let meshes = vec![cuboid(away.anchor.position, 1.0, 0), cuboid(hither.anchor.position, 1.0, 1)];
    let whole = scene(meshes, &[away, hither]);
    let scene = refine(&whole, 0.1).unwrap();
    let searchlight = Effects { searchlight: true, ..Effects::GEOMETRY };
    // At rest; as fast as the one, so that the other comes at 0.8 c; and across, where axes turn.
    for speed in [DVec3::ZERO, half, DVec3::new(0.3, 0.6, -0.2)] {
        let who = observer(DVec3::new(0.2, 0.1, -0.3), celerity(speed));
        let look = exact(&who, &hither, DVec3::new(20.0, -1.5, 1.0)).position.normalize()
            + exact(&who, &away, away.anchor.position).position.normalize();
        let view = View { look, up: DVec3::new(0.1, 0.9, 0.3), fov_degrees: 60.0, size: SIZE };
        for method in methods() {
            let mut photographer = Photographer::with(&scene, SIZE, 1, Some([0.0; 3]), method);
            let places = photographer.places(&view, who.event.position, who.celerity);
            let light = photographer.light(&view, who.event.position, who.celerity, searchlight);
            let mut seen = [0; 2];
            let pixels = (0..SIZE[1]).flat_map(|row| (0..SIZE[0]).map(move |column| [column, row]));
            for (pixel, place) in pixels.zip(places).filter_map(|(pixel, place)| Some((pixel, place?))) {
                let body = usize::from(place.y < 0.0);
                let expected = exact(&who, &[away, hither][body], place + scene.origin);
                let what = format!("{method:?}, body {body}, observer at {speed} c, pixel {pixel:?}");

                let direction = view.direction(middle(pixel));
                let off = expected.position.angle_between(direction) * view.focal_length();
                assert!(off < PLACE_TOLERANCE, "{what}: {off} pixels from its place");

                // Red and green faces have the luminance of their colour: the brightest channel tells.
                let rgb = light.get_pixel(pixel[0], pixel[1]).0;
                let at_rest = if rgb[0] == rgb[1] { GREY } else { 1.0 };
                let found = f64::from(rgb[0].max(rgb[1]) / at_rest);
                let error = (found / expected.doppler.powi(4) - 1.0).abs();
                assert!(error < LIGHT_TOLERANCE, "{what}: {found} instead of {}^4", expected.doppler);
                if speed == half {
                    // Relative velocities of 0 and of 0.8 c.
                    let range = [0.9999..1.0001, 2.8..3.0001];
                    assert!(range[body].contains(&found.powf(0.25)), "{what}: D = {}", found.powf(0.25));
                }
                seen[body] += 1;
            }
            // At D = 3 a box appears three times as far away.
            assert!(seen.iter().all(|&count| count > 30), "{method:?} at {speed} c: {seen:?} pixels");
        }
    }
}

#[test]
fn the_plain_picture_shows_a_body_shorter_at_its_place_now() {
    // At world time 0, ten metres further on than at −20.
    let anchor = Event { ct: -20.0, position: DVec3::new(-12.0, 0.0, -10.0) };
    let motion = Uniform { celerity: celerity(DVec3::X * 0.6), anchor };
    let scene = scene(vec![cuboid(anchor.position, 1.0, 0)], &[motion]);
    let view = View { look: DVec3::NEG_Z, up: DVec3::Y, fov_degrees: 30.0, size: SIZE };
    for method in methods() {
        let mut photographer = Photographer::with(&scene, SIZE, 1, Some([0.0; 3]), method);
        let picture = photographer.plain(&view, DVec3::ZERO);
        let lit: Vec<[u32; 2]> =
            picture.enumerate_pixels().filter(|(.., pixel)| pixel[0] > 50).map(|(x, y, _)| [x, y]).collect();
        let span = |axis: usize| {
            let of = lit.iter().map(|pixel| pixel[axis]);
            (of.clone().min().unwrap(), of.max().unwrap() + 1)
        };
        // Its near face is nine metres away: 0.8 m to either side, 1 m up and down.
        let scale = view.focal_length() / 9.0;
        for (axis, half) in [(0, 0.8), (1, 1.0)] {
            let (low, high) = span(axis);
            let centre = 0.5 * f64::from(SIZE[axis]);
            let off =
                (f64::from(low) - (centre - half * scale)).abs().max((f64::from(high) - centre - half * scale).abs());
            assert!(off < 1.0, "{method:?}: from {low} to {high} along axis {axis}");
        }
    }
}
