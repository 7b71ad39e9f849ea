//! A lamp's light must fall off with the square of the distance and with the cosine of its angle, and must not reach
//! what is in shadow. A moving body must receive it as an observer on it sees it: from the aberrated direction, in
//! the shifted colour, D² as much.
//!
//! In a wrong program, the direction of the world's frame makes a floor bright in the wrong place; another power of D
//! gives another brightness; shadow rays that continue beyond the lamp give shadows of things behind it.
#![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

use glam::{DVec3, Vec2, Vec3};
use physics::colour::Carrier;
use physics::{Beta, Event, Observer};
use scene::motion::{Motion, Uniform};
use scene::{Lamp, Lighting, Material, Mesh, Scene};
use std::sync::atomic::AtomicBool;
use system_tests::view::{View, middle};
use trace::RayTracer;
use view::Effects;

const SIZE: [u32; 2] = [64, 48];

/// Relative tolerance of light after f32 coordinates and colours.
const LIGHT_TOLERANCE: f64 = 1e-5;

const LAMP: DVec3 = DVec3::new(0.5, 1.0, -3.0);
const COLOUR: [f32; 3] = [3.0, 2.0, 1.0];

/// Level square about a place, facing up.
fn level(x: f32, y: f32, z: f32, half: f32) -> Mesh {
    let corners = [[-half, half], [half, half], [half, -half], [-half, -half]];
    Mesh {
        positions: corners.map(|[along, across]| Vec3::new(x + along, y, z + across)).to_vec(),
        normals: vec![Vec3::Y; 4],
        uvs: vec![Vec2::ZERO; 4],
        colours: vec![[1.0; 4]; 4],
        indices: vec![0, 1, 2, 0, 2, 3],
        ..Mesh::default()
    }
}

/// Floor under a lamp, without any other light.
fn scene(meshes: Vec<Mesh>) -> Scene {
    let lamp = Lamp { name: "lamp".into(), position: LAMP, colour: COLOUR, range: None, spot: None, spectrum: None };
    Scene {
        materials: vec![Material::default()],
        meshes,
        light: Lighting { sun: [0.0; 3], sky: [0.0; 3], ground: [0.0; 3], ..Lighting::default() },
        lamps: vec![lamp],
        ..Scene::default()
    }
}

/// Checks each pixel of the floor, a metre below the eye, against the light expected for its place in the world.
/// `None` marks a place too near an edge.
fn hold(scene: Scene, expected: impl Fn(DVec3) -> Option<DVec3>) -> [usize; 2] {
    let view = View { look: DVec3::new(0.0, -0.3, -1.0), up: DVec3::Y, fov_degrees: 40.0, size: SIZE };
    let tracer = RayTracer::new(scene, Some([0.0; 3]), true).unwrap();
    let shot = view.shot(&Observer::default(), Effects::GEOMETRY);
    let traced = tracer.trace(&shot, SIZE, 1, &AtomicBool::new(false), || {});
    let mut compared = [0; 2];
    let pixels = (0..SIZE[1]).flat_map(|row| (0..SIZE[0]).map(move |column| [column, row]));
    for (pixel, light) in pixels.zip(&traced.light) {
        let direction = view.direction(middle(pixel));
        if direction.y > -0.05 {
            continue;
        }
        let Some(expected) = expected(direction / -direction.y) else { continue };
        let off = (*light - expected).abs().max_element();
        assert!(off <= LIGHT_TOLERANCE * expected.abs().max_element(), "{light} instead of {expected} at {pixel:?}");
        compared[usize::from(expected != DVec3::ZERO)] += 1;
    }
    compared
}

#[test]
fn a_lamp_lights_the_floor_and_what_is_between_shades_it() {
    // One sheet lies between the lamp and the floor; one above the lamp shades nothing.
    let floor = level(0.0, -1.0, 0.0, 90.0);
    let scene = scene(vec![floor, level(0.7, 0.6, -3.1, 0.3), level(0.5, 2.0, -3.0, 4.0)]);
    let compared = hold(scene, |place| {
        let share = 0.4 / 2.0;
        let crossing = LAMP + (place - LAMP) * share;
        let inside = 0.3 - (crossing.x - 0.7).abs().max((crossing.z + 3.1).abs());
        // Shadow rays begin a little off the floor.
        if inside.abs() < 0.04 {
            return None;
        }
        let away = LAMP - place;
        let strength = away.y / away.length().powi(3);
        Some(if inside > 0.0 { DVec3::ZERO } else { Vec3::from_array(COLOUR).as_dvec3() * strength })
    });
    assert!(compared[0] > 50 && compared[1] > 500, "{compared:?} in shadow and in light");
}

#[test]
fn a_floor_that_moves_gets_the_lamp_as_it_sees_it() {
    for beta in [DVec3::X * 0.6, DVec3::new(-0.4, 0.0, 0.5)] {
        let velocity = Beta::new(beta).unwrap();
        let celerity = velocity.celerity();
        let mut scene = scene(vec![level(0.0, -1.0, 0.0, 900.0)]);
        let anchor = Event { ct: 0.0, position: DVec3::NEG_Y };
        scene.motions = vec![Motion::Uniform(Uniform { celerity, anchor })];
        scene.meshes[0].motion = Some(0);
        let white = Carrier::white();
        let compared = hold(scene, |place| {
            let away = LAMP - place;
            let (distance, towards) = (away.length(), away.normalize());
            let doppler = celerity.gamma() * (1.0 + beta.dot(towards));
            // Light per area across its direction has D² of the light, and meets the floor at an angle of cosine n_y
            // / D.
            let strength = doppler * towards.y / (distance * distance);
            Some(white.rgb_from_weights(doppler) * Vec3::from_array(COLOUR).as_dvec3() * strength)
        });
        assert!(compared[1] > 500, "{compared:?}");
    }
}
