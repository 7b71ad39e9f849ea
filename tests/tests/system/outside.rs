//! From outside, the photo-surface is an object in space: every point of it must be drawn where its apparent position,
//! taken about the eye, stands for the camera (W 5.1.5). Cuts must be as fine for that camera, nothing may be left out
//! at its edges, and colours are those of the direction from the eye.
//!
//! A wrong program draws the world instead of the photo-surface, puts the camera in the world's axes, cuts for the eye
//! alone, leaves out what the eye does not look at, or shifts light by where the camera looks.
#![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

use built_in::lattice::Lattice;
use glam::{DVec2, DVec3, Vec3};
use image::{Rgb32FImage, RgbaImage};
use physics::{Aberration, Celerity, Event, Observer, apparent};
use render::SceneRenderer;
use render::display::Development;
use scene::motion::{Motion, Uniform};
use scene::refine::refine;
use scene::{Material, Mesh, Scene};
use studio::Studio;
use system_tests::bodies::{celerity, cuboid, exact, observer, sphere, unlit};
use system_tests::exact::differing;
use system_tests::photographer::{AS_GIVEN, DEFAULT_MAP, gpu};
use view::{Colouring, Dial, Effects, Gaze, Occasion, OutsideView, Shot};

const SIZE: [u32; 2] = [480, 320];

/// Vertical field of view, degrees.
const FOV: f64 = 60.0;

/// Distance of a small body's middle in the picture from its exact place, pixels.
const PLACE_PX: f64 = 0.5;

/// Largest share of pixels that may differ between a cut that is fine everywhere and one for the picture.
const SHARE_AT_MOST: f64 = 0.004;

/// Relative tolerance of light and of colours: f32 and the table of shifts.
const LIGHT_TOLERANCE: f64 = 0.01;

const CUT: Dial = Dial::tolerance(0.3);

struct Onlooker {
    renderer: SceneRenderer,
    studio: Studio,
}

impl Onlooker {
    fn new(scene: &Scene, dial: Dial) -> Self {
        Self::with(scene, dial, 1)
    }

    fn with(scene: &Scene, dial: Dial, samples: u32) -> Self {
        let format = Studio::format(gpu());
        let renderer = SceneRenderer::new(gpu(), scene.clone(), format, None, dial, Occasion::Still).unwrap();
        Self { renderer, studio: Studio::new(gpu(), SIZE, samples) }
    }

    fn light(&mut self, shot: &Shot) -> Rgb32FImage {
        let pending = self.renderer.submit(gpu(), &shot.observer, shot.effects).unwrap();
        self.studio.expose(gpu(), &mut self.renderer, shot, pending).unwrap()
    }

    fn picture(&mut self, shot: &Shot) -> RgbaImage {
        let pending = self.renderer.submit(gpu(), &shot.observer, shot.effects).unwrap();
        self.studio.photograph(gpu(), &mut self.renderer, shot, pending, &Development::default(), None).unwrap()
    }
}

fn shot(who: &Observer, view: &OutsideView, effects: Effects) -> Shot {
    let gaze = Gaze { observer: *who, observer_from_eye: glam::DQuat::IDENTITY };
    gaze.shot(FOV, effects).from_outside(view)
}

fn view(place: DVec3, look: Option<DVec3>, colouring: Colouring) -> OutsideView {
    OutsideView { place, look, colouring }
}

/// Place in the picture of a place relative to the eye, observer's axes; pixels from the upper left corner. First
/// principles: world's up is up.
fn pixel(view: &OutsideView, at: DVec3) -> DVec2 {
    let ahead = view.look.unwrap_or(-view.place).normalize();
    let right = ahead.cross(DVec3::Y).normalize();
    let up = right.cross(ahead);
    let towards = at - view.place;
    let focal = 0.5 * f64::from(SIZE[1]) / (0.5 * FOV.to_radians()).tan();
    let depth = towards.dot(ahead);
    DVec2::new(
        0.5 * f64::from(SIZE[0]) + focal * towards.dot(right) / depth,
        0.5 * f64::from(SIZE[1]) - focal * towards.dot(up) / depth,
    )
}

/// Mean place of the pixels for which a weight is given, pixels.
fn centre_of_gravity(light: &Rgb32FImage, weight: impl Fn([f32; 3]) -> f64) -> (DVec2, f64) {
    let (mut sum, mut weights) = (DVec2::ZERO, 0.0);
    for (column, row, pixel) in light.enumerate_pixels() {
        let weight = weight(pixel.0);
        sum += weight * DVec2::new(f64::from(column) + 0.5, f64::from(row) + 0.5);
        weights += weight;
    }
    (sum / weights, weights)
}

/// Small unlit ball of one colour.
fn ball(centre: DVec3, radius: f32, colour: [f32; 4]) -> Mesh {
    let mut mesh = sphere(DVec3::ZERO, 0.4).meshes.remove(0);
    mesh.positions.iter_mut().for_each(|at| *at = *at * radius + centre.as_vec3());
    mesh.colours.iter_mut().for_each(|of_vertex| *of_vertex = colour);
    mesh
}

/// Cameras beside, above, behind and far ahead of an observer, looking at the eye or past it.
fn cameras() -> [OutsideView; 4] {
    [
        view(DVec3::new(14.0, 5.0, 3.0), None, Colouring::Light),
        view(DVec3::new(-6.0, 13.0, 2.0), Some(DVec3::new(0.3, -1.0, -0.4)), Colouring::Light),
        view(DVec3::new(3.0, 4.0, 12.0), Some(DVec3::new(-0.2, -0.3, -1.0)), Colouring::Light),
        view(DVec3::new(2.0, 3.0, -40.0), None, Colouring::Light),
    ]
}

#[test]
fn small_bodies_are_drawn_where_their_apparent_positions_stand() {
    // One at rest, and one that passes across, whose axes are turned. Both are pure colours that no mark has.
    let resting = DVec3::new(-1.2, 1.0, -2.5);
    let anchor = Event { ct: -2.0, position: DVec3::new(1.0, 0.6, -3.0) };
    let motion = Uniform { celerity: celerity(DVec3::new(0.3, 0.0, 0.5)), anchor };
    let mut scene = unlit(
        vec![ball(resting, 0.12, [1.0, 0.0, 1.0, 1.0]), ball(anchor.position, 0.12, [0.0, 1.0, 1.0, 1.0])],
        &[motion],
    );
    scene.meshes[0].motion = None;
    scene.meshes[1].motion = Some(0);
    let white = scene.white_luminance();
    let magenta = |[r, g, b]: [f32; 3]| if r > 20.0 * g && b > 20.0 * g { f64::from(r) / white } else { 0.0 };
    let cyan = |[r, g, b]: [f32; 3]| if g > 20.0 * r && b > 20.0 * r { f64::from(g) / white } else { 0.0 };
    let mut tested = 0;
    for beta in [DVec3::ZERO, DVec3::NEG_Z * 0.8, DVec3::new(0.5, 0.1, -0.6)] {
        let who = observer(DVec3::new(0.3, 0.2, -0.1), celerity(beta));
        let at = [apparent::at_rest(&who, resting).position, exact(&who, &motion, anchor.position).position];
        for method in [AS_GIVEN, CUT, Dial::vertex_stage(1.0), DEFAULT_MAP] {
            let mut onlooker = Onlooker::with(&scene, method, 16);
            for camera in cameras() {
                let light = onlooker.light(&shot(&who, &camera, Effects::GEOMETRY));
                for (place, (found, weight)) in
                    at.into_iter().zip([centre_of_gravity(&light, magenta), centre_of_gravity(&light, cyan)])
                {
                    let expected = pixel(&camera, place);
                    let inside = expected.cmpge(DVec2::splat(8.0)).all()
                        && expected.cmple(DVec2::new(f64::from(SIZE[0]), f64::from(SIZE[1])) - 8.0).all();
                    // Some pixels must say where the middle is.
                    if inside && weight > 4.0 {
                        tested += 1;
                        assert!(
                            found.distance(expected) < PLACE_PX,
                            "{method}, {beta}, {camera}: {found} not {expected}"
                        );
                    }
                }
            }
        }
    }
    assert!(tested > 40, "only {tested} places were tested");
}

#[test]
fn a_cut_for_the_camera_outside_is_as_good_as_a_fine_scene() {
    let lattice = Lattice { count: [4, 4, 4], spacing: 4.0, side: 1.0 };
    let coarse = lattice.build();
    let fine = refine(&coarse, 0.06).unwrap();
    for beta in [0.6, 0.95] {
        let who =
            observer(DVec3::new(0.375, -0.21875, 0.53125), celerity(DVec3::new(-0.4, 0.1, -0.9).normalize() * beta));
        let mut reference = Onlooker::new(&fine, AS_GIVEN);
        for method in [CUT, DEFAULT_MAP] {
            let mut onlooker = Onlooker::new(&coarse, method);
            for camera in cameras() {
                let shot = shot(&who, &camera, Effects::GEOMETRY);
                let (drawn, expected) = (onlooker.picture(&shot), reference.picture(&shot));
                let share = differing(&drawn, &expected).len() as f64 / f64::from(SIZE[0] * SIZE[1]);
                assert!(share < SHARE_AT_MOST, "{method} at {beta} c, {camera}: {share} of the pixels differ");
                let lit = drawn.pixels().filter(|pixel| pixel.0[..3] != [0, 0, 0]).count();
                assert!(lit > 2000, "{camera}: {lit} pixels show anything");
            }
            // The eye's own picture comes back.
            let seen = Shot { outside: None, ..shot(&who, &cameras()[0], Effects::GEOMETRY) };
            let seen = Shot { camera: view::Camera::looking(DVec3::NEG_Z, DVec3::Y, 1.0), ..seen };
            let before = Onlooker::new(&coarse, method).picture(&seen);
            let again = onlooker.picture(&seen);
            let share = differing(&before, &again).len() as f64 / f64::from(SIZE[0] * SIZE[1]);
            assert!(share < SHARE_AT_MOST, "{method}: {share} of the eye's own picture changed");
        }
    }
}

/// Two large walls of one grey, before and behind the eye, a little aside.
fn walls() -> Scene {
    let at = |z: f64| cuboid(DVec3::new(0.0, 0.0, z), 0.75, 0);
    let mut scene = unlit(vec![at(-4.0), at(4.0)], &[]);
    scene.meshes.iter_mut().for_each(|mesh| {
        mesh.motion = None;
        mesh.colours.iter_mut().for_each(|colour| *colour = [0.5, 0.5, 0.5, 1.0]);
    });
    scene
}

#[test]
fn light_is_shifted_by_the_direction_from_the_eye() {
    let who = observer(DVec3::ZERO, celerity(DVec3::NEG_Z * 0.5));
    let scene = refine(&walls(), 0.1).unwrap();
    let effects = Effects { searchlight: true, ..Effects::GEOMETRY };
    // A camera abeam of the wall ahead, then of the one astern, looks across the motion, where D of its own look is 1.
    for (z, method) in [-4.0, 4.0].into_iter().flat_map(|z| [AS_GIVEN, CUT, DEFAULT_MAP].map(|method| (z, method))) {
        let place = DVec3::new(0.75, 0.0, z);
        let seen = apparent::at_rest(&who, place).position;
        let camera = view(seen + DVec3::X * 4.0, Some(DVec3::NEG_X), Colouring::Light);
        let light = Onlooker::new(&scene, method).light(&shot(&who, &camera, effects));
        let found = f64::from(light.get_pixel(SIZE[0] / 2, SIZE[1] / 2)[1]);
        let (_, doppler) = Aberration::new(who.celerity).observer_from_world(place);
        let expected = 0.5 * scene.white_luminance() * doppler.powi(4);
        assert!((found / expected - 1.0).abs() < LIGHT_TOLERANCE, "{method} at {z}: {found}, not {expected}");
    }
}

#[test]
fn colours_show_doppler_factors_and_delays() {
    let who = observer(DVec3::ZERO, celerity(DVec3::NEG_Z * 0.5));
    let scene = refine(&walls(), 0.1).unwrap();
    let colour = |z: f64, colouring: Colouring, lift: f64| {
        let seen = apparent::at_rest(&who, DVec3::new(0.75, 0.0, z)).position;
        let camera = view(seen + DVec3::new(4.0, 0.0, lift), Some(DVec3::new(-4.0, 0.0, -lift)), colouring);
        let light = Onlooker::new(&scene, CUT).light(&shot(&who, &camera, Effects::ALL));
        Vec3::from_array(light.get_pixel(SIZE[0] / 2, SIZE[1] / 2).0)
    };
    let (ahead, astern) = (colour(-4.0, Colouring::Doppler, 0.0), colour(4.0, Colouring::Doppler, 0.0));
    assert!(ahead.z > 2.0 * ahead.x, "light from ahead is blue: {ahead}");
    assert!(astern.x > 2.0 * astern.z, "light from astern is red: {astern}");
    // The lamp is at the camera: a face looked at aslant is darker, by the exact normal.
    let aslant = colour(-4.0, Colouring::Doppler, 6.0);
    assert!(aslant.length() < 0.85 * ahead.length(), "{aslant} {ahead}");

    // Along a wall the rings of delay take turns: pale and dark, as often as the distance says.
    let camera = view(DVec3::new(6.0, 0.0, -7.0), Some(DVec3::NEG_X), Colouring::Delay);
    let light = Onlooker::new(&scene, CUT).light(&shot(&who, &camera, Effects::ALL));
    let row: Vec<f32> = (0..SIZE[0]).map(|column| light.get_pixel(column, SIZE[1] / 2)[0]).collect();
    let lit: Vec<f32> = row.into_iter().filter(|value| *value > 0.0).collect();
    let turns = lit.windows(2).filter(|pair| (pair[0] / pair[1]).max(pair[1] / pair[0]) > 1.25).count();
    assert!(lit.len() > 60 && turns >= 2, "{turns} turns over {} pixels", lit.len());
}

#[test]
fn the_observer_is_a_ball_with_axes_and_its_field_of_view() {
    let scene = Scene { materials: vec![Material::default()], ..Scene::default() };
    let who = observer(DVec3::ZERO, Celerity::new(DVec3::NEG_Z).unwrap());
    let camera = view(DVec3::new(5.0, 6.0, 7.0), None, Colouring::Light);
    let light = Onlooker::new(&scene, CUT).light(&shot(&who, &camera, Effects::GEOMETRY));
    let at = |place: DVec3| {
        let at = pixel(&camera, place);
        Vec3::from_array(light.get_pixel(at.x as u32, at.y as u32).0)
    };
    // The ball is grey, its axes red to the right, green up, blue ahead.
    let ball = at(DVec3::ZERO);
    assert!(ball.x > 0.0 && (ball.x / ball.z - 1.0).abs() < 0.05, "{ball}");
    let (right, up, ahead) = (at(DVec3::X), at(DVec3::Y), at(DVec3::NEG_Z));
    assert!(
        right.x > 3.0 * right.y.max(right.z) && up.y > 3.0 * up.x.max(up.z) && ahead.z > 2.0 * ahead.x.max(ahead.y),
        "{right} {up} {ahead}"
    );
    // An edge of its field of view leads to the upper right corner of its picture.
    let tan = (0.5 * FOV.to_radians()).tan();
    let corner = DVec3::new(tan * f64::from(SIZE[0]) / f64::from(SIZE[1]), tan, -1.0).normalize();
    let edge = at(corner * 4.0);
    assert!(edge.x > 1.5 * edge.z && edge.y > edge.z, "{edge}");
    assert_eq!(at(DVec3::new(-1.0, -1.0, 0.0)), Vec3::ZERO);
}

#[test]
fn what_is_measured_has_an_outside_too() {
    let lattice = Lattice { count: [4, 4, 4], spacing: 4.0, side: 1.0 };
    let scene = lattice.build();
    let who = observer(DVec3::new(0.375, -0.21875, 0.53125), celerity(DVec3::NEG_Z * 0.8));
    let camera = cameras()[0];
    // Contracted scene at rest, about the eye.
    let mut contracted = scene.clone();
    for mesh in &mut contracted.meshes {
        for position in &mut mesh.positions {
            let d = position.as_dvec3() + scene.origin - who.event.position;
            *position = (DVec3::new(d.x, d.y, 0.6 * d.z) - scene.origin).as_vec3();
        }
    }
    let still = observer(DVec3::ZERO, Celerity::ZERO);
    for method in [AS_GIVEN, CUT, DEFAULT_MAP] {
        let drawn = Onlooker::new(&scene, method).picture(&shot(&who, &camera, Effects::MEASURED));
        let expected = Onlooker::new(&contracted, method).picture(&shot(&still, &camera, Effects::NONE));
        let share = differing(&drawn, &expected).len() as f64 / f64::from(SIZE[0] * SIZE[1]);
        assert!(share < SHARE_AT_MOST, "{method}: {share} of the pixels differ");
    }
}

#[test]
fn a_moving_body_is_the_same_from_streams_in_either_axes() {
    // Streams of moving parts are in their own axes with one way of cutting, in the observer's with the other.
    let motion =
        Uniform { celerity: celerity(DVec3::X * 0.8), anchor: Event { ct: 0.0, position: DVec3::new(0.0, 0.0, -5.0) } };
    let mut scene = unlit(vec![cuboid(motion.anchor.position, 1.0, 0)], &[]);
    scene.motions = vec![Motion::Uniform(motion)];
    let fine = refine(&scene, 0.05).unwrap();
    let who = observer(DVec3::ZERO, celerity(DVec3::new(0.0, 0.7, -0.4)));
    for colouring in Colouring::ALL {
        let camera = view(DVec3::new(7.0, 4.0, 6.0), None, colouring);
        let shot = shot(&who, &camera, Effects::ALL);
        let [own, observers] =
            [(&fine, AS_GIVEN), (&scene, CUT)].map(|(scene, dial)| Onlooker::new(scene, dial).light(&shot));
        let off = own.pixels().zip(observers.pixels()).filter(|(a, b)| {
            (0..3).any(|channel| (a[channel] - b[channel]).abs() > 0.05 * a[channel].abs().max(b[channel].abs()) + 1e-3)
        });
        let share = off.count() as f64 / f64::from(SIZE[0] * SIZE[1]);
        assert!(share < SHARE_AT_MOST, "{}: {share} of the pixels differ", colouring.name());
    }
}
