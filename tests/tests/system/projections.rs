//! A pixel of a picture in any projection must show what the eye sees in the pixel's direction, by every renderer: in
//! stereo the eye that the direction belongs to, at the other's time by the observer's clock.
//!
//! The pictures are compared with boxes met by rays one by one. Directions are worked out here by turning an arrow, and
//! taken to the world by multiplied-out Lorentz matrices, which share nothing with the program's projections.
//!
//! A wrong program mirrors a dome, leaves seams between the faces of a cube, exchanges the eyes, or shows depth ahead
//! and none behind.
#![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

use built_in::lattice::Lattice;
use filming::{FilmView, MakerOptions, PictureMaker};
use glam::{DQuat, DVec2, DVec3};
use image::{Rgb32FImage, RgbaImage};
use physics::{Celerity, Event, Observer};
use rayon::prelude::*;
use render::SceneRenderer;
use render::display::{Development, Gamut};
use scene::Scene;
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use studio::Studio;
use system_tests::bodies::{cuboid, unlit};
use system_tests::exact::Boxes;
use system_tests::lorentz::{boost, four, rotation, space};
use system_tests::photographer::{DEFAULT_MAP, RAYS, gpu};
use system_tests::turns::turn;
use trace::RayTracer;
use view::{Dial, Effects, Gaze, Occasion, OpenShutter, Optics, Projection, RendererName};
use walls::StereoEyes;

const BACKGROUND: [f32; 3] = [0.01, 0.02, 0.03];
const LATTICE: Lattice = Lattice { count: [6, 6, 6], spacing: 4.0, side: 1.0 };
/// Largest distance of an outline from its exact place, pixels: for one eye, and for an eye that stands for a strip, at
/// a metre.
const REACH: f64 = 0.5;
const STEREO_REACH: f64 = 1.0;
/// Largest difference of a colour where everything within reach is of one colour, codes of sRGB.
const SAME: u8 = 3;
/// Largest share of such pixels that may be of another colour: a corner of a box may be less than a pixel wide.
const STRAY_AT_MOST: f64 = 1e-3;
/// Smallest share of pixels with one colour within reach, so that enough is compared.
const PLAIN_AT_LEAST: f64 = 0.5;
/// Distance between the eyes, metres: large, so that an eye in a wrong place is seen.
const SEPARATION_M: f64 = 0.3;
/// Methods that draw every projection.
const METHODS: [Dial; 3] = [Dial::tolerance(0.25), DEFAULT_MAP, RAYS];
const DOME: Projection = Projection::Fisheye { full_rad: 200.0 * PI / 180.0 };

/// Maker of pictures by a method.
fn maker(scene: Scene, method: Dial, options: MakerOptions) -> PictureMaker {
    if method.renderer == RendererName::Raytrace {
        let tracer = RayTracer::new(scene, Some(BACKGROUND), false).unwrap();
        return PictureMaker::traced(gpu(), tracer, options, Arc::new(AtomicBool::new(false)));
    }
    let format = Studio::format(gpu());
    let renderer = SceneRenderer::new(gpu(), scene, format, Some(BACKGROUND), method, Occasion::Still).unwrap();
    PictureMaker::drawn(gpu(), renderer, options)
}

fn view_of(gaze: Gaze) -> FilmView {
    let development = Development { gamut: Gamut::Clamp, ..Default::default() };
    FilmView {
        gaze,
        effects: Effects::GEOMETRY,
        fov_deg: 60.0,
        development,
        outside: None,
        exposure: OpenShutter::default(),
        elapsed_s: None,
    }
}

/// Developed pictures of all eyes.
fn pictures(maker: &mut PictureMaker, gaze: Gaze) -> Vec<RgbaImage> {
    let view = view_of(gaze);
    let pending = maker.submit(gpu(), &view).unwrap();
    maker.begin(gpu(), &view, pending, &|| ()).unwrap().finish(gpu()).unwrap()
}

/// Light of all eyes' pictures.
fn lights(maker: &mut PictureMaker, gaze: Gaze) -> Vec<Rgb32FImage> {
    let view = view_of(gaze);
    let pending = maker.submit(gpu(), &view).unwrap();
    maker.light(gpu(), &view, pending, &|| ()).unwrap().0
}

/// Gaze between the boxes, turned arbitrarily, with this celerity.
fn gaze(celerity: DVec3) -> Gaze {
    let observer_from_eye = DQuat::from_rotation_y(0.4) * DQuat::from_rotation_x(-0.3);
    let event = Event { ct: 0.7, position: DVec3::new(0.375, -0.21875, 0.53125) };
    Gaze { observer: Observer { event, celerity: Celerity::new(celerity).unwrap() }, observer_from_eye }
}

/// Direction of a place in a picture, 0 to 1 from the upper left, by turns of an arrow; eye's axes.
fn arrow(projection: Projection, place: DVec2) -> Option<DVec3> {
    let turned = |to_the_right: f64, upwards: f64| {
        DQuat::from_rotation_y(-to_the_right) * DQuat::from_rotation_x(upwards) * DVec3::NEG_Z
    };
    match projection {
        Projection::Sphere => Some(turned(TAU * (place.x - 0.5), PI * (0.5 - place.y))),
        Projection::Vr180 => Some(turned(PI * (place.x - 0.5), PI * (0.5 - place.y))),
        Projection::Fisheye { full_rad } => {
            let from_middle = DVec2::new(place.x - 0.5, 0.5 - place.y);
            let axis = DVec3::NEG_Z.cross(from_middle.extend(0.0)).try_normalize().unwrap_or(DVec3::X);
            let angle = full_rad * from_middle.length();
            (2.0 * angle <= full_rad).then(|| DQuat::from_axis_angle(axis, angle) * DVec3::NEG_Z)
        }
        Projection::Cube => {
            let (column, row) = ((3.0 * place.x).floor(), (2.0 * place.y).floor());
            let ahead = DVec3::new(6.0 * place.x - 2.0 * column - 1.0, 1.0 - (4.0 * place.y - 2.0 * row), -1.0);
            let right = DQuat::from_rotation_y(-FRAC_PI_2);
            let turn = match (column as u32, row as u32) {
                (0, 0) => right,
                (1, 0) => right.inverse(),
                (2, 0) => DQuat::from_rotation_x(FRAC_PI_2),
                (0, 1) => DQuat::from_rotation_x(-FRAC_PI_2),
                (1, 1) => DQuat::IDENTITY,
                _ => right * right,
            };
            Some((turn * ahead).normalize())
        }
        Projection::Flat => None,
    }
}

/// Exact picture of one eye, by textbook formulas.
struct ExactPicture {
    boxes: Boxes,
    projection: Projection,
    size: [u32; 2],
    gaze: Gaze,
    /// Distance of the eye to the right of the head's middle, metres, and the axis of the head's turns, eye's axes.
    aside_m: f64,
    upright: DVec3,
}

impl ExactPicture {
    /// Exact colour at a place, in pixels; black where the picture shows nothing.
    fn colour(&self, at: DVec2) -> [u8; 4] {
        let Some(seen) = arrow(self.projection, at / DVec2::new(f64::from(self.size[0]), f64::from(self.size[1])))
        else {
            return [0, 0, 0, 255];
        };
        let Observer { event, celerity } = self.gaze.observer;
        let world_from_eye = boost(-celerity.vector()) * rotation(self.gaze.observer_from_eye);
        // The right hand of a head that has turned to what it sees.
        let level = (seen - self.upright * seen.dot(self.upright)).try_normalize().unwrap_or(DVec3::X);
        let right = DQuat::from_axis_angle(self.upright, -FRAC_PI_2) * level;
        let eye = four(event.ct, event.position) + world_from_eye * four(0.0, right * self.aside_m);
        // The light came from there, at an earlier time.
        self.boxes.first(space(eye), space(world_from_eye * four(-1.0, seen)).normalize())
    }

    /// Colour of everything within reach of a place; `None` if there are several.
    fn plain(&self, middle: DVec2, reach: f64) -> Option<[u8; 4]> {
        let colour = self.colour(middle);
        let ring = |step: u32| DVec2::from_angle(f64::from(step) * TAU / 12.0) * reach;
        let around = (0..12).flat_map(|step| [ring(step), 0.5 * ring(step)]);
        around.into_iter().all(|off| self.colour(middle + off) == colour).then_some(colour)
    }

    /// Asserts that a picture is this one.
    fn assert_shown(&self, picture: &RgbaImage, reach: f64, what: &str) {
        assert_eq!([picture.width(), picture.height()], self.size);
        let pixels: Vec<_> = picture.enumerate_pixels().collect();
        let judged = |(x, y, pixel): &(u32, u32, &image::Rgba<u8>)| {
            let middle = DVec2::new(f64::from(*x), f64::from(*y)) + 0.5;
            let colour = self.plain(middle, reach)?;
            Some(colour.iter().zip(&pixel.0).all(|(a, b)| a.abs_diff(*b) <= SAME))
        };
        let judged: Vec<_> = pixels.par_iter().filter_map(judged).collect();
        let plain = judged.len() as f64 / pixels.len() as f64;
        let stray = judged.iter().filter(|right| !**right).count() as f64 / pixels.len() as f64;
        println!("{what}: {plain:.3} of the pixels are of one colour within reach, {stray:.6} are of another");
        assert!(plain > PLAIN_AT_LEAST, "{what}: {plain} of the pixels are too few to compare");
        assert!(stray < STRAY_AT_MOST, "{what}: {stray} of the pixels show what is nowhere near");
    }
}

/// Asserts that every method shows what the eyes see, at rest and at .8 c.
fn assert_projection(projection: Projection, size: [u32; 2], stereo: bool) {
    let _turn = turn();
    // A dome's audience sits upright, wherever its middle is.
    let upright = DVec3::new(0.2, 1.0, 0.4).normalize();
    let eyes = StereoEyes { separation_m: SEPARATION_M, wall_m: 2.0, upright };
    let turns_about = match projection {
        Projection::Fisheye { .. } | Projection::Cube => upright,
        Projection::Flat | Projection::Sphere | Projection::Vr180 => DVec3::Y,
    };
    let (reach, sides) = if stereo { (STEREO_REACH, vec![-0.5, 0.5]) } else { (REACH, vec![0.0]) };
    for method in METHODS {
        let options = MakerOptions {
            size,
            samples: 1,
            projection,
            stereo: stereo.then_some(eyes),
            optics: Optics::default(),
            exposes_alone: false,
        };
        let mut maker = maker(LATTICE.build(), method, options);
        for celerity in [DVec3::ZERO, DVec3::new(-0.5, 0.2, -1.2)] {
            let gaze = gaze(celerity);
            let pictures = pictures(&mut maker, gaze);
            assert_eq!(pictures.len(), sides.len());
            for (picture, side) in pictures.iter().zip(&sides) {
                let boxes = Boxes::of(&LATTICE, BACKGROUND);
                let aside_m = side * SEPARATION_M;
                let exact = ExactPicture { boxes, projection, size, gaze, aside_m, upright: turns_about };
                let what = format!("{projection} by {method}, u = {:.2}, eye {side}", celerity.length());
                exact.assert_shown(picture, reach, &what);
            }
        }
    }
}

#[test]
fn a_sphere_shows_all_that_the_eye_sees() {
    assert_projection(Projection::Sphere, [512, 256], false);
}

#[test]
fn a_dome_shows_each_direction_at_its_angle() {
    assert_projection(DOME, [320, 320], false);
}

#[test]
fn a_cube_shows_all_that_the_eye_sees() {
    assert_projection(Projection::Cube, [384, 256], false);
}

#[test]
fn half_a_sphere_shows_what_is_ahead() {
    assert_projection(Projection::Vr180, [256, 256], false);
}

#[test]
fn each_direction_of_a_stereo_sphere_has_its_own_eyes() {
    assert_projection(Projection::Sphere, [256, 128], true);
}

#[test]
fn each_direction_of_half_a_stereo_sphere_has_its_own_eyes() {
    assert_projection(Projection::Vr180, [128, 128], true);
}

#[test]
fn each_direction_of_a_stereo_dome_has_its_own_eyes() {
    assert_projection(DOME, [160, 160], true);
}

#[test]
fn each_direction_of_a_stereo_cube_has_its_own_eyes() {
    assert_projection(Projection::Cube, [192, 128], true);
}

#[test]
fn parallax_is_right_in_eight_directions() {
    const SIZE: [u32; 2] = [1024, 512];
    const DISTANCE_M: f64 = 2.0;
    /// Largest error of a bearing, pixels: half of one at a metre by the width of strips, of rays that of sampling.
    const STRIP_PIXELS: f64 = 0.35;
    const RAY_PIXELS: f64 = 0.15;
    let _turn = turn();
    let eyes = StereoEyes { separation_m: 0.064, wall_m: 2.0, upright: DVec3::Y };
    let bearings: Vec<f64> = (0..8).map(|step| f64::from(step) * PI / 4.0 - PI).collect();
    // White cubes, each symmetric about its bearing.
    let bodies = bearings.iter().map(|bearing| {
        let centre = DISTANCE_M * DVec3::new(bearing.sin(), 0.0, -bearing.cos());
        let mut body = scene::Mesh { motion: None, ..cuboid(centre, 0.04, 0) };
        body.colours.fill([1.0; 4]);
        body
    });
    let scene = unlit(bodies.collect(), &[]);
    let gaze = Gaze { observer: Observer::default(), observer_from_eye: DQuat::IDENTITY };
    let options = MakerOptions {
        size: SIZE,
        samples: 9,
        projection: Projection::Sphere,
        stereo: Some(eyes),
        optics: Optics::default(),
        exposes_alone: false,
    };
    for (method, tolerance) in METHODS.into_iter().zip([STRIP_PIXELS, STRIP_PIXELS, RAY_PIXELS]) {
        let mut maker = maker(scene.clone(), method, options);
        let lights = lights(&mut maker, gaze);
        for (light, side) in lights.iter().zip([-1.0, 1.0]) {
            for bearing in &bearings {
                // A line of sight touches the circle of the eyes, so it leads past the middle.
                let expected = bearing - side * (0.5 * eyes.separation_m / DISTANCE_M).asin();
                let column = (expected / TAU + 0.5) * f64::from(SIZE[0]);
                let (mut sum, mut weight) = (0.0, 0.0);
                for x in (column as i64 - 16)..(column as i64 + 17) {
                    for y in SIZE[1] / 2 - 12..SIZE[1] / 2 + 12 {
                        let at = x.rem_euclid(i64::from(SIZE[0])) as u32;
                        let shown = f64::from(light.get_pixel(at, y).0[1]) - f64::from(BACKGROUND[1]);
                        (sum, weight) = (sum + shown.max(0.0) * (x as f64 + 0.5), weight + shown.max(0.0));
                    }
                }
                let error = sum / weight - column;
                println!("{method}, eye {side}, bearing {bearing:.2}: {error:.3} pixels off");
                assert!(error.abs() < tolerance, "{method}, eye {side}, bearing {bearing}: {error} pixels off");
            }
        }
    }
}

#[test]
fn eyes_of_a_flat_picture_agree_on_the_wall() {
    const SIZE: [u32; 2] = [400, 300];
    /// Largest error of a place, pixels.
    const TOLERANCE: f64 = 0.6;
    let _turn = turn();
    let eyes = StereoEyes { separation_m: 0.2, wall_m: 3.0, upright: DVec3::Y };
    let gaze = Gaze { observer: Observer::default(), observer_from_eye: DQuat::IDENTITY };
    let pixels_per_tangent = f64::from(SIZE[1]) / 2.0 / 30.0_f64.to_radians().tan();
    for distance_m in [1.5, 3.0, 12.0] {
        let body = scene::Mesh { motion: None, ..cuboid(DVec3::NEG_Z * distance_m, 0.02 * distance_m, 0) };
        for method in METHODS {
            let options = MakerOptions {
                size: SIZE,
                samples: 1,
                projection: Projection::Flat,
                stereo: Some(eyes),
                optics: Optics::default(),
                exposes_alone: false,
            };
            let mut maker = maker(unlit(vec![body.clone()], &[]), method, options);
            let places: Vec<f64> = lights(&mut maker, gaze)
                .iter()
                .map(|light| {
                    let lit = light.enumerate_pixels().filter(|(.., pixel)| pixel.0[1] > 0.1);
                    let (count, sum) =
                        lit.fold((0.0, 0.0), |(count, sum), (x, ..)| (count + 1.0, sum + f64::from(x) + 0.5));
                    sum / count
                })
                .collect();
            // By similar triangles: the place on the wall of a point ahead, from an eye aside.
            let parallax = 0.2 * (1.0 / distance_m - 1.0 / 3.0) * pixels_per_tangent;
            let error = places[0] - places[1] - parallax;
            println!("{method}, {distance_m} m: {error:.3} pixels off");
            assert!(error.abs() < TOLERANCE, "{method} at {distance_m} m: {places:?}, expected {parallax} apart");
        }
    }
}
