//! The hand of a clock must be drawn where its light left it, by every method: as clockwork in a map of the world, and
//! aboard a train, where it turns by the train's own time at each of its points. What is measured of it must be where
//! it is at the observer's own present.
//!
//! A wrong program shows hands as they are now, or as the middle of the dial is seen, or turns a train's hands by the
//! platform's time; then the pictures differ from those of traced rays by more than the pixels at their outlines.
#![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

use glam::{DAffine3, DQuat, DVec3, Vec2, Vec3};
use physics::{Beta, Event, Observer};
use scene::motion::{Animated, ChainLink, Keyed, Motion, ObservedBody, Track, TrackKeys, Uniform};
use scene::{Material, Mesh, Scene};
use std::f64::consts::FRAC_PI_2;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use system_tests::photographer::{DEFAULT_MAP, Photographer};
use system_tests::view::View;
use trace::RayTracer;
use view::{Dial, Effects};

const SIZE: [u32; 2] = [320, 240];
const SPEED_OF_LIGHT_M_S: f64 = 8.0;
/// Middle of the dial, whose axis is z.
const CENTRE: DVec3 = DVec3::new(1.0, 2.0, -12.0);
/// Largest share of the hand's pixels that may differ: those at its outline, where one picture shows the other side.
const OUTLINE: f64 = 0.12;

/// Scene of one broad hand, 2 m long, that goes round in twelve seconds.
fn clock(carrier: Option<Uniform>) -> Scene {
    let quarter = |quarter: u32| DQuat::from_rotation_z(-FRAC_PI_2 * f64::from(quarter));
    let times = (0..=4).map(|quarter| 3.0 * f64::from(quarter)).collect();
    let keys = TrackKeys::slerp(times, (0..=4).map(quarter).collect()).unwrap();
    let turn = Keyed {
        translation: Track::Fixed(DVec3::ZERO),
        rotation: Track::Keyed(keys.repeating([0.0, 12.0], -DQuat::IDENTITY)),
        scale: Track::Fixed(DVec3::ONE),
    };
    let links = vec![ChainLink::Fixed(DAffine3::from_translation(CENTRE)), ChainLink::Keyed(turn)];
    let hand = carrier.into_iter().fold(Animated::new("hand", links).as_clockwork(), Animated::aboard);
    let mut scene = Scene {
        materials: vec![Material { unlit: true, ..Material::default() }],
        meshes: vec![Mesh {
            positions: vec![Vec3::new(-0.3, -0.4, 0.0), Vec3::new(0.3, -0.4, 0.0), Vec3::new(0.0, 2.0, 0.0)],
            normals: vec![Vec3::Z; 3],
            uvs: vec![Vec2::ZERO; 3],
            colours: vec![[0.5, 0.4, 0.3, 1.0]; 3],
            indices: vec![0, 1, 2],
            motion: Some(0),
            ..Mesh::default()
        }],
        motions: vec![Motion::Animated(Arc::new(hand))],
        ..Scene::default()
    };
    scene.set_speed_of_light(SPEED_OF_LIGHT_M_S).unwrap();
    scene
}

/// Share of the hand's pixels in which the pictures of a method and of traced rays differ.
fn differing(scene: &Scene, who: &Observer, method: Dial, effects: Effects) -> f64 {
    let body = ObservedBody::new(scene.motions[0].animated().unwrap(), who);
    let middle = DVec3::Y * 0.5;
    let shown = if effects.bend() { body.seen(middle) } else { body.measured(middle) };
    let view = View { look: shown.unwrap().apparent, up: DVec3::Y, fov_degrees: 30.0, size: SIZE };
    let shot = view.shot(who, effects);
    let tracer = RayTracer::new(scene.clone(), Some([0.0; 3]), false).unwrap();
    let traced = tracer.trace(&shot, SIZE, 1, &AtomicBool::new(false), || {}).light;
    let mut photographer = Photographer::with(scene, SIZE, 1, Some([0.0; 3]), method);
    let drawn = photographer.light(&view, who.event.position, who.celerity, effects);
    let drawn: Vec<bool> = drawn.pixels().map(|pixel| pixel.0[1] > 0.1).collect();
    let traced: Vec<bool> = traced.iter().map(|light| light.y > 0.1).collect();
    let shown = traced.iter().filter(|shown| **shown).count();
    assert!(shown > 250, "the hand has {shown} pixels");
    traced.iter().zip(&drawn).filter(|(traced, drawn)| traced != drawn).count() as f64 / shown as f64
}

fn observers() -> [Observer; 3] {
    let riding = |beta: DVec3, place: DVec3| Observer {
        event: Event { ct: 0.0, position: place },
        celerity: Beta::new(beta).unwrap().celerity(),
    };
    [
        riding(DVec3::ZERO, DVec3::new(-3.0, 1.7, 0.0)),
        riding(DVec3::new(0.1, 0.0, -0.6), DVec3::new(4.0, 1.7, -3.0)),
        riding(DVec3::new(0.0, 0.1, 0.5), DVec3::new(-5.0, 0.0, -7.0)),
    ]
}

#[test]
fn clockwork_in_a_map_stands_where_rays_find_it() {
    let scene = clock(None);
    for who in observers() {
        for method in [DEFAULT_MAP, Dial::tolerance(0.1)] {
            let share = differing(&scene, &who, method, Effects::GEOMETRY);
            println!("{:?}: {share:.3}", method.renderer);
            assert!(share < OUTLINE, "{share} with {method:?}");
        }
    }
}

#[test]
fn a_hand_aboard_a_train_is_drawn_alike_by_every_method() {
    let celerity = Beta::new(DVec3::X * 0.6).unwrap().celerity();
    let scene = clock(Some(Uniform { celerity, anchor: Event { ct: -9.0, position: CENTRE } }));
    for who in observers() {
        for method in [DEFAULT_MAP, Dial::tolerance(0.1)] {
            let share = differing(&scene, &who, method, Effects::GEOMETRY);
            println!("{:?}: {share:.3}", method.renderer);
            assert!(share < OUTLINE, "{share} with {method:?}");
        }
    }
}

#[test]
fn a_measured_hand_is_drawn_alike_by_every_method() {
    let celerity = Beta::new(DVec3::X * 0.6).unwrap().celerity();
    let carrier = Uniform { celerity, anchor: Event { ct: -9.0, position: CENTRE } };
    for scene in [clock(None), clock(Some(carrier))] {
        for who in observers() {
            for method in [DEFAULT_MAP, Dial::tolerance(0.1)] {
                let share = differing(&scene, &who, method, Effects::MEASURED);
                println!("{:?}: {share:.3}", method.renderer);
                assert!(share < OUTLINE, "{share} with {method:?}");
            }
        }
    }
}
