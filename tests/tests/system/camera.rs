//! A thin lens must blur a point to a circle of the diameter A |1/f − 1/d|, as a tangent, with A the aperture, d the
//! distance of the point and f that of the focal plane. An open shutter must smear a moving body over the angle that
//! it passes meanwhile. Both hold for apparent positions, in the observer's frame and by the observer's clock.
//!
//! In a wrong program, world distances in place of apparent ones give circles of another size; the world's time in
//! place of proper time gives streaks longer by γ; samples that leave holes give another mean.
#![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

use glam::{DVec3, Vec2, Vec3};
use physics::{Aberration, Beta, Celerity, Event, FourVector, Observer, apparent};
use scene::motion::{Motion, Uniform};
use scene::{Material, Mesh, Scene};
use std::sync::atomic::AtomicBool;
use system_tests::view::{View, middle};
use trace::{RayTracer, Traced};
use view::{CameraLens, Effects, Gaze, OpenShutter, Optics, Shot};

const BLACK: Option<[f32; 3]> = Some([0.0; 3]);

/// Relative tolerance of the blurred circle's diameter: a few thousand samples hit it.
const CIRCLE_TOLERANCE: f64 = 0.02;

/// Tolerance of a streak's ends, pixels: they lie between pixels.
const STREAK_TOLERANCE: f64 = 1.0;

fn at(beta: DVec3) -> Celerity {
    Beta::new(beta).unwrap().celerity()
}

/// White, unlit disc about `centre` that faces +z.
fn disc(centre: DVec3, radius: f32) -> Scene {
    const CORNERS: u32 = 24;
    let corner = |number: u32| {
        let (sine, cosine) = (std::f32::consts::TAU * number as f32 / CORNERS as f32).sin_cos();
        Vec3::new(cosine, sine, 0.0) * radius
    };
    let positions: Vec<Vec3> = (0..CORNERS).map(corner).collect();
    let count = positions.len();
    let mesh = Mesh {
        positions,
        normals: vec![Vec3::Z; count],
        uvs: vec![Vec2::ZERO; count],
        colours: vec![[1.0; 4]; count],
        indices: (1..CORNERS - 1).flat_map(|number| [0, number, number + 1]).collect(),
        ..Mesh::default()
    };
    let materials = vec![Material { unlit: true, ..Material::default() }];
    Scene { origin: centre, materials, meshes: vec![mesh], ..Scene::default() }
}

fn shot(view: &View, celerity: Celerity) -> Shot {
    view.shot(&Observer { event: Event::default(), celerity }, Effects::GEOMETRY)
}

/// Lens and length of the exposure of a straight worldline, metres of light travel.
#[derive(Clone, Copy, Default)]
struct TriedCamera {
    lens: Option<CameraLens>,
    exposure_m: f64,
}

fn trace(scene: &Scene, camera: TriedCamera, shot: &Shot, size: [u32; 2], samples: u32) -> Traced {
    let TriedCamera { lens, exposure_m } = camera;
    let mut tracer = RayTracer::new(scene.clone(), BLACK, false).unwrap().with_optics(Optics { lens });
    let gaze = Gaze { observer: shot.observer, observer_from_eye: shot.camera.observer_from_eye };
    tracer.exposure = OpenShutter::straight(&gaze, exposure_m);
    tracer.trace(shot, size, samples, &AtomicBool::new(false), || {})
}

/// Mean square distance of a picture's light from its own middle, square pixels.
fn spread(traced: &Traced) -> f64 {
    let pixels = (0..traced.size[1]).flat_map(|row| (0..traced.size[0]).map(move |column| middle([column, row])));
    let (mut light, mut mean, mut squares) = (0.0, [0.0; 2], 0.0);
    for ([x, y], seen) in pixels.zip(&traced.light) {
        light += seen.y;
        mean = [mean[0] + seen.y * x, mean[1] + seen.y * y];
        squares += seen.y * (x * x + y * y);
    }
    assert!(light > 0.0, "it is dark");
    (squares - (mean[0] * mean[0] + mean[1] * mean[1]) / light) / light
}

#[test]
fn what_is_not_in_focus_is_a_circle_of_the_lenss_size() {
    const SIZE: [u32; 2] = [64, 64];
    let centre = DVec3::new(0.0, 0.0, -4.0);
    for (beta, focus_m) in [
        (DVec3::ZERO, 2.0),
        (DVec3::ZERO, 9.0),
        (DVec3::NEG_Z * 0.9, 6.0),
        // The lens extends along the motion, so the world's time differs between its points.
        (DVec3::X * 0.9, 3.0),
    ] {
        let celerity = at(beta);
        let observer = Observer { event: Event::default(), celerity };
        let place = apparent::at_rest(&observer, centre).position;
        let distance = place.length();
        let view = View { look: place, up: DVec3::Y, fov_degrees: 6.0, size: SIZE };
        // Choose the aperture so that the circle has a radius of 18 pixels, and the disc one of two.
        let per_metre = (1.0 / focus_m - 1.0 / distance).abs() * view.focal_length();
        let aperture_m = 36.0 / per_metre;
        let scene = disc(centre, (2.0 * distance / view.focal_length()) as f32);
        let shot = shot(&view, celerity);
        let sharp = spread(&trace(&scene, TriedCamera::default(), &shot, SIZE, 64));
        let optics = TriedCamera { lens: Some(CameraLens { aperture_m, focus_m }), exposure_m: 0.0 };
        let blurred = spread(&trace(&scene, optics, &shot, SIZE, 384));
        // An even circle has a mean square of half its radius squared, and spreads add up.
        let diameter = (8.0 * (blurred - sharp)).sqrt();
        println!("{beta}, focus {focus_m}: {diameter} pixels");
        assert!((diameter / 36.0 - 1.0).abs() < CIRCLE_TOLERANCE, "{beta}, focus {focus_m}: {diameter} pixels, not 36");
    }
}

#[test]
fn what_is_in_focus_stays_sharp() {
    const SIZE: [u32; 2] = [64, 64];
    let centre = DVec3::new(0.0, 0.0, -4.0);
    let celerity = at(DVec3::NEG_Z * 0.9);
    let view = View { look: DVec3::NEG_Z, up: DVec3::Y, fov_degrees: 6.0, size: SIZE };
    let (_, doppler) = Aberration::new(celerity).observer_from_world(DVec3::NEG_Z);
    let scene = disc(centre, 0.1);
    let lens = CameraLens { aperture_m: 0.5, focus_m: 4.0 * doppler };
    let shot = shot(&view, celerity);
    let sharp = spread(&trace(&scene, TriedCamera::default(), &shot, SIZE, 64));
    let seen = spread(&trace(&scene, TriedCamera { lens: Some(lens), exposure_m: 0.0 }, &shot, SIZE, 64));
    assert!((seen / sharp - 1.0).abs() < 0.02, "{seen} {sharp}");
}

/// First and last column with light, as the places of their outer edges.
fn streak(traced: &Traced) -> [f64; 2] {
    let lit =
        |column: u32| (0..traced.size[1]).any(|row| traced.light[(row * traced.size[0] + column) as usize].y > 0.0);
    let first = (0..traced.size[0]).find(|&column| lit(column)).unwrap();
    let last = (0..traced.size[0]).rev().find(|&column| lit(column)).unwrap();
    [f64::from(first), f64::from(last + 1)]
}

#[test]
fn what_crosses_the_picture_leaves_a_streak() {
    const SIZE: [u32; 2] = [160, 24];
    const FAR_M: f64 = 10.0;
    const EXPOSURE_M: f64 = 4.0;
    let optics = TriedCamera { lens: None, exposure_m: EXPOSURE_M };
    let view = View { look: DVec3::NEG_Z, up: DVec3::Y, fov_degrees: 12.0, size: SIZE };
    let column = |place: DVec3| 0.5 * f64::from(SIZE[0]) + place.x / -place.z * view.focal_length();
    let radius = 0.1;
    let half = radius / FAR_M * view.focal_length();

    // The disc flies past an observer at rest: X = γ²β (t − √(β²t² + b²/γ²)) is its apparent position at time t if it
    // is abeam at time 0.
    for beta in [0.3, 0.8] {
        let gamma_squared = 1.0 / (1.0 - beta * beta);
        let seen = |t: f64| gamma_squared * beta * (t - (beta * beta * t * t + FAR_M * FAR_M / gamma_squared).sqrt());
        let centre = DVec3::new(0.0, 0.0, -FAR_M);
        let mut scene = disc(centre, radius as f32);
        // The disc is abeam earlier by the light's travel time, so that it appears in the middle of the picture when
        // that is taken.
        let anchor = Event { ct: -FAR_M, position: centre };
        scene.motions = vec![Motion::Uniform(Uniform { celerity: at(DVec3::X * beta), anchor })];
        scene.meshes[0].motion = Some(0);
        let traced = trace(&scene, optics, &shot(&view, Celerity::ZERO), SIZE, 96);
        let ends = [-0.5, 0.5].map(|share| column(DVec3::new(seen(FAR_M + share * EXPOSURE_M), 0.0, -FAR_M)));
        let [first, last] = streak(&traced);
        println!("{beta} c: {first} to {last}, expected {} to {}", ends[0] - half, ends[1] + half);
        assert!((first - (ends[0] - half)).abs() < STREAK_TOLERANCE + 0.3 * half, "{beta} c: {first} {ends:?}");
        assert!((last - (ends[1] + half)).abs() < STREAK_TOLERANCE + 0.3 * half, "{beta} c: {last} {ends:?}");
    }

    // The observer flies past the disc, so proper time along the observer's worldline counts.
    let celerity = at(DVec3::X * 0.6);
    let view = View { look: DVec3::new(0.75, 0.0, -1.0), up: DVec3::Y, fov_degrees: 14.0, size: SIZE };
    let scene = disc(DVec3::new(0.0, 0.0, -FAR_M), radius as f32);
    let traced = trace(&scene, TriedCamera { lens: None, exposure_m: 2.0 }, &shot(&view, celerity), SIZE, 96);
    let ends = [1.0, -1.0].map(|tau: f64| {
        let gone = FourVector { t: celerity.gamma() * tau, r: celerity.vector() * tau };
        let observer = Observer { event: Event::default() + gone, celerity };
        let place = view.camera().observer_from_eye.conjugate()
            * apparent::at_rest(&observer, DVec3::new(0.0, 0.0, -FAR_M)).position;
        0.5 * f64::from(SIZE[0]) + place.x / -place.z * view.focal_length()
    });
    let [first, last] = streak(&traced);
    println!("observer: {first} to {last}, middles {ends:?}");
    let half = half * 0.8;
    assert!((first - (ends[0] - half)).abs() < 2.0 * STREAK_TOLERANCE, "{first} {ends:?} {half}");
    assert!((last - (ends[1] + half)).abs() < 2.0 * STREAK_TOLERANCE, "{last} {ends:?} {half}");
}

#[test]
fn a_pinhole_and_a_moment_change_nothing_and_threads_neither() {
    const SIZE: [u32; 2] = [48, 32];
    let scene = disc(DVec3::new(0.1, 0.0, -4.0), 0.5);
    let view = View { look: DVec3::new(0.4, 0.0, -0.9), up: DVec3::Y, fov_degrees: 20.0, size: SIZE };
    let shot = shot(&view, at(DVec3::X * 0.4));
    let plain = trace(&scene, TriedCamera::default(), &shot, SIZE, 4);
    assert!(plain.light.iter().any(|light| light.y > 0.0), "it is dark");
    let closed = TriedCamera { lens: Some(CameraLens { aperture_m: 0.0, focus_m: 2.0 }), exposure_m: 0.0 };
    assert!(plain == trace(&scene, closed, &shot, SIZE, 4), "a closed lens changes something");

    let open = TriedCamera { lens: Some(CameraLens { aperture_m: 0.2, focus_m: 2.0 }), exposure_m: 0.3 };
    let traced = [1, 3, 8].map(|threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| trace(&scene, open, &shot, SIZE, 4))
    });
    assert!(traced[0] != plain, "an open lens changes nothing");
    assert!(traced.iter().all(|other| *other == traced[0]));
}
