//! A picture through a shutter shows the mean of what the eye sees while it is open, along its true worldline: it turns
//! and moves meanwhile. Through a lens it shows the mean of what the places of the lens see. By every renderer.
//!
//! A wrong program leaves a turn sharp, or blurs by what the picture before showed.
#![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

use built_in::lattice::Lattice;
use filming::{FilmView, MakerOptions, PictureMaker};
use glam::{DQuat, DVec3};
use image::Rgb32FImage;
use measure::flip::{PIXELS_PER_DEGREE, Perceived, distances, mean};
use physics::{Celerity, Event, Observer};
use render::SceneRenderer;
use scene::{Mesh, Scene};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use studio::Studio;
use system_tests::bodies::{cuboid, unlit};
use system_tests::photographer::{DEFAULT_MAP, RAYS, gpu};
use system_tests::turns::turn;
use trace::RayTracer;
use view::{CameraLens, Dial, Effects, Gaze, Occasion, OpenShutter, Optics, Projection, RendererName};

const BACKGROUND: [f32; 3] = [0.01, 0.02, 0.03];
/// Methods that draw a picture once for each sample, and rays.
const METHODS: [Dial; 3] = [Dial::tolerance(0.25), DEFAULT_MAP, RAYS];
/// Time for which the shutter is open, seconds, and rate of a turn, radians a second.
const SHUTTER_S: f64 = 1.0 / 50.0;
const TURN: f64 = 0.9;

/// Light of a picture with 64 samples a pixel.
fn light(
    scene: &Scene,
    method: Dial,
    size: [u32; 2],
    fov_deg: f64,
    exposure: &OpenShutter,
    optics: Optics,
) -> Rgb32FImage {
    let _turn = turn();
    let options =
        MakerOptions { size, samples: 64, projection: Projection::Flat, stereo: None, optics, exposes_alone: false };
    let mut maker = if method.renderer == RendererName::Raytrace {
        let tracer = RayTracer::new(scene.clone(), Some(BACKGROUND), false).unwrap().with_optics(optics);
        PictureMaker::traced(gpu(), tracer, options, Arc::new(AtomicBool::new(false)))
    } else {
        let format = Studio::format(gpu());
        let renderer =
            SceneRenderer::new(gpu(), scene.clone(), format, Some(BACKGROUND), method, Occasion::Still).unwrap();
        PictureMaker::drawn(gpu(), renderer, options)
    };
    let gaze = gaze(0.0);
    let development = Default::default();
    let exposure = exposure.clone();
    let effects = Effects::GEOMETRY;
    let view = FilmView { gaze, effects, fov_deg, development, outside: None, exposure, elapsed_s: None };
    let pending = maker.submit(gpu(), &view).unwrap();
    maker.light(gpu(), &view, pending, &|| ()).unwrap().0.remove(0)
}

/// Gaze of an eye that turns, at a share of the exposure.
fn gaze(share: f64) -> Gaze {
    let observer_from_eye = DQuat::from_rotation_y(TURN * SHUTTER_S * share);
    Gaze { observer: Observer::default(), observer_from_eye }
}

/// OpenShutter along a worldline, given at shares −½ to ½ of it.
fn along(gaze: impl Fn(f64) -> Gaze) -> OpenShutter {
    OpenShutter::along((0..9).map(|part| gaze(f64::from(part) / 8.0 - 0.5)).collect())
}

#[test]
fn a_turn_smears_an_edge_by_its_angle() {
    const SIZE: [u32; 2] = [320, 40];
    /// Largest error of the angle, degrees: 64 samples of the exposure, and pixels of a fortieth of a degree.
    const TOLERANCE_DEG: f64 = 0.04;
    // The right side of a large white body lies straight ahead, near and far.
    let mut body = Mesh { motion: None, ..cuboid(DVec3::new(-500.0, 0.0, -1000.0), 500.0, 0) };
    body.colours.fill([1.0; 4]);
    let scene = unlit(vec![body], &[]);
    let expected = (TURN * SHUTTER_S).to_degrees();
    assert!((expected - 1.03).abs() < 0.002);
    for method in METHODS {
        let light = light(&scene, method, SIZE, 1.0, &along(gaze), Optics::default());
        let row: Vec<f64> = (0..SIZE[0]).map(|column| f64::from(light.get_pixel(column, 20).0[0])).collect();
        let (white, black) = (row[4], row[315]);
        assert!(white > 5.0 * black, "{method}: the edge is not in the picture");
        // A ramp t from 0 to 1 has the integral 1/6 of t (1 − t).
        let share = |value: &f64| (value - black) / (white - black);
        let pixels = 6.0 * row.iter().map(|value| share(value) * (1.0 - share(value))).sum::<f64>();
        let degrees = pixels / 40.0;
        println!("{method}: an edge is smeared by {degrees:.3}°, expected {expected:.3}°");
        assert!((degrees - expected).abs() < TOLERANCE_DEG, "{method}: {degrees}° for {expected}°");
        // The middle of the exposure is where the eye looks.
        let middle = row.iter().map(share).sum::<f64>() / 40.0;
        assert!((middle - 4.0).abs() < 0.03, "{method}: the edge is at {middle}°");
    }
}

#[test]
fn other_renderers_blur_as_rays_do() {
    const SIZE: [u32; 2] = [192, 144];
    /// Largest FLIP between a renderer and rays, and the smallest between a blurred picture and a sharp one, so that
    /// blur is seen.
    const FLIP: f64 = 0.03;
    const SEEN: f64 = 0.035;
    let scene = Lattice { count: [6, 6, 6], spacing: 4.0, side: 1.0 }.build();
    let celerity = Celerity::new(DVec3::new(0.3, 0.1, -0.7)).unwrap();
    let moving = |share: f64| {
        // A fiftieth of a second where light goes at 30 km/h, in a bend.
        let tau = 0.17 * share;
        let event =
            Event { ct: celerity.gamma() * tau, position: DVec3::new(0.4, -0.2, 0.5) + celerity.vector() * tau };
        let observer_from_eye = DQuat::from_rotation_y(TURN * SHUTTER_S * share);
        Gaze { observer: Observer { event, celerity }, observer_from_eye }
    };
    let still = OpenShutter::along(vec![moving(0.0); 2]);
    let lens = Optics { lens: Some(CameraLens { aperture_m: 0.12, focus_m: 4.0 }) };
    let perceived = |light: &Rgb32FImage| {
        let rgb: Vec<DVec3> = light.pixels().map(|pixel| DVec3::from(pixel.0.map(f64::from)).min(DVec3::ONE)).collect();
        Perceived::new(SIZE, &rgb, PIXELS_PER_DEGREE)
    };
    let seen = |method, exposure: &OpenShutter, optics| perceived(&light(&scene, method, SIZE, 60.0, exposure, optics));
    for (what, exposure, optics) in
        [("shutter", along(moving), Optics::default()), ("lens", still.clone(), lens), ("both", along(moving), lens)]
    {
        let rays = seen(RAYS, &exposure, optics);
        let sharp = mean(&distances(&seen(RAYS, &still, Optics::default()), &rays));
        println!("{what}: FLIP {sharp:.3} against a sharp picture");
        assert!(sharp > SEEN, "{what}: {sharp} is hardly blurred");
        for method in [METHODS[0], METHODS[1]] {
            let flip = mean(&distances(&seen(method, &exposure, optics), &rays));
            println!("{what}, {method}: FLIP {flip:.4} against rays");
            assert!(flip < FLIP, "{what}, {method}: FLIP {flip}");
        }
    }
}
