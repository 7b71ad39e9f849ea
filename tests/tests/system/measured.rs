//! What is measured must be where it is at the observer's own present: resting things contracted by 1/γ along the
//! motion, moving ones by their motion relative to the observer and in the observer's axes, animated ones point by
//! point at the events that are simultaneous for the observer. All renderers must agree.
//!
//! A wrong program takes the world's present, forgets Wigner's rotation, contracts by the body's motion in the world,
//! leaves things out beside the picture at high speed, or draws the sky of another direction. The expected places come
//! from 4 × 4 matrices multiplied out, which the program does not use.
#![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

use built_in::lattice::Lattice;
use glam::{DAffine3, DMat4, DQuat, DVec3};
use image::{Rgba, RgbaImage};
use physics::{Celerity, Event, Observer};
use scene::cut::SeenFrom;
use scene::motion::{Animated, ChainLink, Keyed, Motion, Track, TrackKeys, Uniform};
use scene::{Lighting, Scene};
use std::sync::Arc;
use system_tests::bodies::{celerity, cuboid, observer, unlit};
use system_tests::exact::{Boxes, differing};
use system_tests::lorentz::{boost, four, space};
use system_tests::photographer::{AS_GIVEN, DEFAULT_MAP, Photographer, RAYS};
use system_tests::view::{View, middle};
use view::{Dial, Effects};

const SIZE: [u32; 2] = [320, 240];

/// Accuracy of places, metres.
const EXACT: f64 = 1e-6;

/// Largest share of pixels that may differ between two exact pictures: outlines pass through middles of pixels within
/// the 256 steps of rasterisation.
const SHARE_AT_MOST: f64 = 0.002;

/// Linear colour, unlike the colour of any face.
const BACKGROUND: [f32; 3] = [0.01, 0.02, 0.03];

const LATTICE: Lattice = Lattice { count: [6, 6, 6], spacing: 4.0, side: 1.0 };
const EYE: DVec3 = DVec3::new(0.375, -0.21875, 0.53125);
const MOTION: DVec3 = DVec3::new(-5.13, 1.29, -1.97);

const METHODS: [Dial; 3] = [AS_GIVEN, Dial::tolerance(0.5), DEFAULT_MAP];

/// Place in the observer's frame, relative to the observer, of a worldline at the observer's present. `event` gives an
/// event for a parameter that grows with time, in any frame; `to_observer` takes differences from `origin` there.
fn at_present(to_observer: DMat4, origin: (f64, DVec3), event: impl Fn(f64) -> (f64, DVec3)) -> DVec3 {
    let seen = |parameter: f64| {
        let (ct, position) = event(parameter);
        to_observer * four(ct - origin.0, position - origin.1)
    };
    let (mut early, mut late) = (-1e4, 1e4);
    for _ in 0..200 {
        let halfway = 0.5 * (early + late);
        if seen(halfway).x < 0.0 { early = halfway } else { late = halfway }
    }
    space(seen(0.5 * (early + late)))
}

fn corners() -> impl Iterator<Item = DVec3> {
    (0..8).map(|corner| DVec3::from_array([0, 1, 2].map(|axis| f64::from(corner >> axis & 1))))
}

#[test]
fn a_unit_cube_at_0_6_c_measures_0_8_along_the_motion() {
    let who = observer(DVec3::new(3.0, -1.0, 2.0), celerity(DVec3::NEG_Z * 0.6));
    let sight = SeenFrom::measured(DVec3::ZERO, &[], &who, None);
    let measured: Vec<DVec3> = corners().map(|corner| sight.apparent(corner)).collect();
    let extent = |axis: usize| {
        let along = || measured.iter().map(|place| place[axis]);
        along().fold(f64::NEG_INFINITY, f64::max) - along().fold(f64::INFINITY, f64::min)
    };
    assert!((extent(0) - 1.0).abs() < EXACT && (extent(1) - 1.0).abs() < EXACT && (extent(2) - 0.8).abs() < EXACT);
    // The corner at the origin: 3 m to the left, 1 m up, 2 m ahead, of which 1.6 m are left.
    assert!(measured[0].distance(DVec3::new(-3.0, 1.0, -1.6)) < EXACT, "{}", measured[0]);
}

#[test]
fn a_body_that_moves_across_is_contracted_by_the_relative_motion_and_turned() {
    let mut turned = 0;
    for (of_body, of_observer) in [
        (DVec3::X * 0.6, DVec3::ZERO),
        (DVec3::ZERO, DVec3::X * 0.6),
        (DVec3::X * 0.8, DVec3::Z * 0.9),
        (DVec3::new(0.5, 0.3, -0.6), DVec3::new(-0.2, 0.7, 0.4)),
    ] {
        let anchor = Event { ct: -2.0, position: DVec3::new(4.0, 1.0, -6.0) };
        let uniform = Uniform { celerity: celerity(of_body), anchor };
        let who = Observer {
            event: Event { ct: 1.5, position: DVec3::new(0.5, 2.0, 0.25) },
            celerity: celerity(of_observer),
        };
        let origin = DVec3::new(1.0, 0.0, -1.0);
        let sight = SeenFrom::measured(origin, &[Motion::Uniform(uniform)], &who, Some(0));
        let world_from_body = boost(-uniform.celerity.vector());
        let to_observer = boost(who.celerity.vector());
        for corner in corners() {
            let place = anchor.position + corner;
            let expected = at_present(to_observer, (who.event.ct, who.event.position), |own_time| {
                let event = world_from_body * four(own_time, corner);
                (anchor.ct + event.x, anchor.position + space(event))
            });
            let measured = sight.apparent(place - origin);
            assert!(measured.distance(expected) < EXACT, "{of_body} {of_observer}: {measured}, not {expected}");
        }
        turned += usize::from(sight.observer_from_group.angle_between(DQuat::IDENTITY) > 0.1);
    }
    assert_eq!(turned, 2, "Wigner's rotation is not tested");
}

/// Motion along a circle of 3 m at 0.6 c in the plane y = 0, keyed finely, in a world where light covers 1 m a second.
fn circling(centre: DVec3) -> Motion {
    let times: Vec<f64> = (0..=400).map(|step| f64::from(step) * 0.1 - 20.0).collect();
    let rate = 0.2;
    let values = times.iter().map(|t| 3.0 * DVec3::new((rate * t).cos(), 0.0, (rate * t).sin())).collect();
    let slopes = times.iter().map(|t| [0.6 * DVec3::new(-(rate * t).sin(), 0.0, (rate * t).cos()); 2]).collect();
    let keyed = Keyed {
        translation: Track::Keyed(TrackKeys::<DVec3>::cubic(times, values, slopes).unwrap()),
        rotation: Track::Fixed(DQuat::IDENTITY),
        scale: Track::Fixed(DVec3::ONE),
    };
    let links = vec![ChainLink::Fixed(DAffine3::from_translation(centre)), ChainLink::Keyed(keyed)];
    Motion::Animated(Arc::new(Animated::new("carousel", links)))
}

/// Scene in whose world light covers 1 m a second.
fn slow(mut scene: Scene) -> Scene {
    scene.set_speed_of_light(1.0).unwrap();
    scene
}

#[test]
fn each_point_of_an_animated_body_is_at_its_own_simultaneous_event() {
    let centre = DVec3::new(1.0, 0.5, -8.0);
    let mesh = cuboid(DVec3::ZERO, 0.5, 0);
    let mut scene = unlit(vec![mesh], &[]);
    scene.motions = vec![circling(centre)];
    let scene = slow(scene);
    for beta in [DVec3::ZERO, DVec3::X * 0.8, DVec3::new(0.5, -0.3, 0.7)] {
        let who = Observer { event: Event { ct: 0.7, position: DVec3::new(0.2, 0.1, 0.3) }, celerity: celerity(beta) };
        let sight = SeenFrom::measured(scene.origin, &scene.motions, &who, Some(0));
        let animated = scene.motions[0].animated().unwrap();
        for corner in corners() {
            let place = corner - 0.5;
            let to_observer = boost(who.celerity.vector());
            let expected =
                at_present(to_observer, (who.event.ct, who.event.position), |ct| (ct, animated.at(ct).position(place)));
            let measured = sight.apparent(place);
            assert!(measured.distance(expected) < EXACT, "{beta}: {measured}, not {expected}");
        }
    }
}

/// World direction of the line of the observer's present through a place in a picture.
fn world_line(view: &View, who: &Observer, place: [f64; 2]) -> DVec3 {
    space(boost(-who.celerity.vector()) * four(0.0, view.direction(place))).normalize()
}

fn views() -> [View; 4] {
    let view = |look, up, fov_degrees| View { look, up, fov_degrees, size: SIZE };
    [
        view(MOTION, DVec3::Y, 90.0),
        view(MOTION.cross(DVec3::Y), DVec3::Y, 60.0),
        view(-MOTION, DVec3::new(0.1, 1.0, 0.0), 75.0),
        view(DVec3::new(-3.0, 2.0, 7.0), DVec3::new(0.7, 0.3, -0.2), 80.0),
    ]
}

fn share(one: &RgbaImage, other: &RgbaImage) -> f64 {
    differing(one, other).len() as f64 / f64::from(SIZE[0] * SIZE[1])
}

#[test]
fn boxes_are_where_lines_of_the_observers_present_meet_them() {
    let boxes = Boxes::of(&LATTICE, BACKGROUND);
    let scene = LATTICE.build();
    for method in METHODS.into_iter().chain([RAYS]) {
        let mut photographer = Photographer::with(&scene, SIZE, 1, Some(BACKGROUND), method);
        for beta in [0.0, 0.6, 0.9, 0.99] {
            let who = observer(EYE, celerity(MOTION.normalize() * beta));
            for view in views() {
                let exact = RgbaImage::from_fn(SIZE[0], SIZE[1], |column, row| {
                    Rgba(boxes.first(EYE, world_line(&view, &who, middle([column, row]))))
                });
                let drawn = photographer.seen(&view, EYE, who.celerity, Effects::MEASURED);
                let share = share(&drawn, &exact);
                assert!(share < SHARE_AT_MOST, "{method}, {view:?} at {beta} c: {share} of the pixels differ");
            }
        }
    }
}

#[test]
fn moving_and_animated_bodies_are_drawn_where_rays_find_them() {
    let place = DVec3::new(-1.5, 0.3, -6.0);
    let uniform = Uniform { celerity: celerity(DVec3::X * 0.7), anchor: Event { ct: -0.5, position: place } };
    let mut scene = unlit(vec![cuboid(place, 0.8, 0), cuboid(DVec3::ZERO, 0.6, 1)], &[uniform]);
    scene.motions.push(circling(DVec3::new(1.5, -0.3, -9.0)));
    // The middles of the keyed body's edges are at other times than its ends: short edges follow.
    let scene = slow(scene::refine::refine(&scene, 0.1).unwrap());
    let view = View { look: DVec3::NEG_Z, up: DVec3::Y, fov_degrees: 70.0, size: SIZE };
    for beta in [DVec3::ZERO, DVec3::X * 0.6, DVec3::new(0.2, 0.5, 0.6)] {
        let mut rays = Photographer::with(&scene, SIZE, 1, Some([0.0, 0.0, 0.1]), RAYS);
        let traced = rays.seen(&view, DVec3::ZERO, celerity(beta), Effects::MEASURED);
        let lit = traced.pixels().filter(|pixel| pixel[1] > 60 || pixel[0] > 60).count();
        assert!(lit > 2000, "{lit} pixels show bodies");
        for method in METHODS {
            let mut photographer = Photographer::with(&scene, SIZE, 1, Some([0.0, 0.0, 0.1]), method);
            let drawn = photographer.seen(&view, DVec3::ZERO, celerity(beta), Effects::MEASURED);
            let share = share(&drawn, &traced);
            assert!(share < SHARE_AT_MOST, "{method} at {beta} c: {share} of the pixels differ");
            // The other views follow, and the first comes back, from the same renderer.
            let seen = photographer.seen(&view, DVec3::ZERO, celerity(beta), Effects::GEOMETRY);
            assert!(beta == DVec3::ZERO || self::share(&seen, &drawn) > SHARE_AT_MOST);
            let again = photographer.seen(&view, DVec3::ZERO, celerity(beta), Effects::MEASURED);
            assert!(self::share(&again, &drawn) < SHARE_AT_MOST);
        }
    }
}

#[test]
fn the_light_on_things_and_the_sky_are_those_of_rays() {
    let sunny = Lighting { sun_direction: glam::Vec3::new(0.3, 0.6, 0.5).normalize(), ..Lighting::default() };
    let mut scene = Scene { light: sunny, ..LATTICE.build() };
    scene.materials.iter_mut().for_each(|material| material.unlit = false);
    let fast = Celerity::new(MOTION.normalize() * 2.0).unwrap();
    for view in &views()[..2] {
        let traced = Photographer::with(&scene, SIZE, 1, None, RAYS).light(view, EYE, fast, Effects::MEASURED);
        // Whatever switch is left on, no light is shifted.
        let switched = Effects { doppler: true, searchlight: true, ..Effects::MEASURED };
        for method in METHODS {
            let drawn = Photographer::with(&scene, SIZE, 1, None, method).light(view, EYE, fast, switched);
            let off = drawn.pixels().zip(traced.pixels()).filter(|(one, other)| {
                (0..3).any(|channel| (one[channel] - other[channel]).abs() > 0.02 * other[channel].abs() + 1e-4)
            });
            let share = off.count() as f64 / f64::from(SIZE[0] * SIZE[1]);
            assert!(share < 2.0 * SHARE_AT_MOST, "{method}, {view:?}: the light of {share} of the pixels differs");
        }
    }
}
