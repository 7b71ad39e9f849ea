//! A moving body must be seen where its light comes from, with its light's own shift. A sphere that passes keeps a
//! circular outline (Penrose 1959). A cube that passes shows its back. Two boxes that fly apart each have the Doppler
//! factor of their own motion relative to the observer.
//!
//! A wrong program shows contracted ovals; no back; or both boxes in one brightness, that of the world at rest or of
//! subtracted velocities. The expected values come from worldlines in the world (`physics::apparent::moving`), not
//! from the objects' own frames, in which the program works.
#![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

use glam::DVec3;
use physics::{Celerity, Event};
use scene::motion::{Motion, Uniform};
use scene::refine::refine;
use system_tests::bodies::{Cone, GREY, celerity, cuboid, exact, observer, outline, sphere, unlit};
use system_tests::photographer::{AS_GIVEN, DEFAULT_MAP, Photographer, RAYS};
use system_tests::view::{View, middle};
use view::{Dial, Effects};

const SIZE: [u32; 2] = [320, 240];

/// Root mean square distance from a circle, pixels: an even spread over one pixel, 0.29, and a margin for triangles.
const RESIDUAL_TOLERANCE: f64 = 0.4;

/// Largest distance of the outline from the outermost exact places, pixels: the search for it is uncertain by half a
/// pixel.
const OUTLINE_TOLERANCE: f64 = 0.8;

/// Largest distance of anything drawn from its exact place, pixels.
const PLACE_TOLERANCE: f64 = 0.1;

/// Relative tolerance of light: the table's own error, and f32.
const LIGHT_TOLERANCE: f64 = 0.002;

fn methods() -> [Dial; 4] {
    let adaptive = Dial::tolerance(0.05);
    [AS_GIVEN, adaptive, DEFAULT_MAP, RAYS]
}

#[test]
fn a_sphere_that_passes_keeps_a_circular_outline() {
    for along in [4.0, 0.0, -6.0] {
        let anchor = Event { ct: -3.0, position: DVec3::new(along, 0.8, -3.0) };
        let motion = Uniform { celerity: celerity(DVec3::X * 0.9), anchor };
        let mut scene = sphere(anchor.position, 0.05);
        scene.motions = vec![Motion::Uniform(motion)];
        scene.meshes[0].motion = Some(0);
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
                let outline = outline(&view, |column, row| picture.get_pixel(column, row)[0] > 127);
                let what = format!("{method}, {along} m along, observer at {speed} c");
                assert!(outline.len() > 300, "{what}: {} pixels of outline", outline.len());

                let circle = Cone::through(&outline);
                let residual = circle.residual(&outline, &view);
                assert!(residual < RESIDUAL_TOLERANCE, "{what}: {residual} pixels off a circle");
                let size = (widest(circle.axis) - circle.half_angle()).abs() * view.focal_length();
                assert!(size < OUTLINE_TOLERANCE, "{what}: {size} pixels from the exact outline");
            }
        }
    }
}

#[test]
fn a_cube_that_passes_shows_its_back() {
    // The cube is abeam when the light leaves it that arrives now.
    let anchor = Event { ct: -10.0, position: DVec3::NEG_Z * 10.0 };
    let view = View { look: DVec3::NEG_Z, up: DVec3::Y, fov_degrees: 30.0, size: SIZE };
    for method in methods() {
        for (speed, back) in [(0.9, true), (0.0, false)] {
            let motion = Uniform { celerity: celerity(DVec3::X * speed), anchor };
            let scene = unlit(vec![cuboid(anchor.position, 1.0, 0)], &[motion]);
            let scene = refine(&scene, 0.2).unwrap();
            let mut photographer = Photographer::with(&scene, SIZE, 1, Some([0.0; 3]), method);
            let picture = photographer.moving(&view, DVec3::ZERO, Celerity::ZERO);
            let count = |is: fn(&[u8; 4]) -> bool| picture.pixels().filter(|pixel| is(&pixel.0)).count();
            let (red, green) =
                (count(|rgba| rgba[0] > 200 && rgba[1] < 50), count(|rgba| rgba[1] > 200 && rgba[0] < 50));
            // The cube appears turned by arcsin β, so it shows 0.9 of its back's width: more than of its side.
            assert_eq!(red > 2000, back, "{method} at {speed} c: {red} pixels of its back");
            assert_eq!(green, 0, "{method} at {speed} c: pixels of its front");
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
    let whole = unlit(meshes, &[away, hither]);
    let scene = refine(&whole, 0.1).unwrap();
    let searchlight = Effects { searchlight: true, ..Effects::GEOMETRY };
    // The observer is at rest; is as fast as one body, so that the other approaches at 0.8 c; or moves across, where
    // axes turn.
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
            for (pixel, shown) in pixels.zip(places).filter_map(|(pixel, shown)| Some((pixel, shown?))) {
                let body = shown.motion.unwrap();
                let expected = exact(&who, &[away, hither][body], shown.position + scene.origin);
                let what = format!("{method}, body {body}, observer at {speed} c, pixel {pixel:?}");

                let direction = view.direction(middle(pixel));
                let off = expected.position.angle_between(direction) * view.focal_length();
                assert!(off < PLACE_TOLERANCE, "{what}: {off} pixels from its place");

                // The brightest channel of red and green faces has the brightness of the face.
                let rgb = light.get_pixel(pixel[0], pixel[1]).0;
                let at_rest = if rgb[0] == rgb[1] { GREY } else { 1.0 };
                let found = f64::from(rgb[0].max(rgb[1]) / at_rest);
                let error = (found / expected.doppler.powi(4) - 1.0).abs();
                assert!(error < LIGHT_TOLERANCE, "{what}: {found} instead of {}^4", expected.doppler);
                if speed == half {
                    // Bounds of D for relative velocities of 0 and of 0.8 c.
                    let range = [0.9999..1.0001, 2.8..3.0001];
                    assert!(range[body].contains(&found.powf(0.25)), "{what}: D = {}", found.powf(0.25));
                }
                seen[body] += 1;
            }
            // At D = 3 a box appears three times as far away.
            assert!(seen.iter().all(|&count| count > 30), "{method} at {speed} c: {seen:?} pixels");
        }
    }
}

#[test]
fn the_plain_picture_shows_a_body_shorter_at_its_place_now() {
    // At world time 0 the body is ten metres further on than at −20.
    let anchor = Event { ct: -20.0, position: DVec3::new(-12.0, 0.0, -10.0) };
    let motion = Uniform { celerity: celerity(DVec3::X * 0.6), anchor };
    let scene = unlit(vec![cuboid(anchor.position, 1.0, 0)], &[motion]);
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
        // The near face is nine metres away: 0.8 m to either side, 1 m up and down.
        let scale = view.focal_length() / 9.0;
        for (axis, half) in [(0, 0.8), (1, 1.0)] {
            let (low, high) = span(axis);
            let centre = 0.5 * f64::from(SIZE[axis]);
            let off =
                (f64::from(low) - (centre - half * scale)).abs().max((f64::from(high) - centre - half * scale).abs());
            assert!(off < 1.0, "{method}: from {low} to {high} along axis {axis}");
        }
    }
}
