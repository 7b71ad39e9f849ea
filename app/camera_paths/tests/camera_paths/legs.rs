//! Law: constant proper thrust is hyperbolic motion, legs go on where the one before ended, and an event between two
//! steps lies on the same worldline. A wrong program adds velocities up to that of light, or restarts each leg.
#![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

use crate::support::{assert_derivatives, path};
use glam::DVec3;
use physics::worldline::{DormandPrince, Thrust, WorldlineState, travel};

const LIGHT: f64 = 10.0;
/// Tolerance of places, as a share: the error of the vehicles' integrator at the thrusts here.
const INTEGRATED: f64 = 1e-9;

#[test]
fn constant_thrust_is_hyperbolic() {
    for push in ["acceleration = [0, 0, -8]", "thrust = [0, 0, -0.8]"] {
        let path = path(&format!("[start]\nposition = [1, 2, 3]\n[[leg]]\nseconds = 3.3\n{push}"), LIGHT);
        assert_eq!(path.length_s(), 3.3);
        for step in 0..=100 {
            let own_s: f64 = 0.033 * f64::from(step);
            let observer = path.at(own_s).gaze.observer;
            // a = 8 m/s², c = 10 m/s: c²/a = 12.5 m, aτ/c = 0.8 τ/s.
            let (eta, scale) = (0.8 * own_s, 12.5);
            let expected = DVec3::new(1.0, 2.0, 3.0 - scale * (eta.cosh() - 1.0));
            assert!(observer.event.position.distance(expected) < INTEGRATED * scale * eta.cosh(), "at {own_s} s");
            assert!((observer.event.ct - scale * eta.sinh()).abs() < INTEGRATED * scale * eta.cosh());
            assert!((observer.celerity.vector().z + eta.sinh()).abs() < INTEGRATED * eta.cosh());
        }
        // Straight ahead is where it is pushed, from the first moment on.
        assert!((path.at(0.0).gaze.observer_from_eye * DVec3::NEG_Z).distance(DVec3::NEG_Z) < 1e-15);
    }
}

const JOURNEY: &str = "
[start]
position = [0, 1.6, 0]
celerity = [0.75, 0, 0]
look = [1, 0, 0]
fov = 60
[[leg]]
seconds = 1.01
thrust = [0, 0.3, -1]
look = [0, 0, -1]
[[leg]]
seconds = 0.5
[[leg]]
seconds = 2.2
acceleration = [-9, 0, 2]
fov = 30
";

#[test]
fn legs_follow_each_other_on_one_worldline() {
    let path = path(JOURNEY, LIGHT);
    assert!((path.length_s() - 3.71).abs() < 1e-12);
    assert_derivatives(&path, LIGHT, 1e-6);
    // Another integrator, by its tolerance, in the boost's axes.
    let mut state = WorldlineState::new(
        physics::Event { ct: 0.0, position: DVec3::new(0.0, 1.6, 0.0) },
        physics::Celerity::new(DVec3::new(0.75, 0.0, 0.0)).unwrap(),
        glam::DQuat::IDENTITY,
    );
    let pushes = [(1.01, DVec3::new(0.0, 0.3, -1.0)), (0.5, DVec3::ZERO), (2.2, DVec3::new(-0.9, 0.0, 0.2))];
    let mut own_s = 0.0;
    for (seconds, push) in pushes {
        let control = move |state: &WorldlineState| Thrust::in_boost_axes(state, push / LIGHT);
        let precise = DormandPrince::new(1e-12).unwrap();
        for half in 1..=2 {
            state = travel(&precise, &state, 0.5 * seconds * LIGHT, 0.1, &control).unwrap();
            let found = path.at(own_s + 0.5 * seconds * f64::from(half)).gaze.observer;
            assert!(found.event.position.distance(state.position) < 1e-7, "{half}");
            assert!(found.celerity.vector().distance(state.celerity.vector()) < 1e-7);
            assert!((found.event.ct - state.ct).abs() < 1e-7);
        }
        own_s += seconds;
    }
}

#[test]
fn looks_and_fields_of_view_are_those_of_the_legs_ends() {
    let path = path(JOURNEY, LIGHT);
    let look = |own_s| path.at(own_s).gaze.observer_from_eye * DVec3::NEG_Z;
    assert!(look(0.0).distance(DVec3::X) < 1e-12 && look(1.01).distance(DVec3::NEG_Z) < 1e-12);
    assert!(look(3.7).distance(DVec3::NEG_Z) < 1e-12);
    let halfway = look(0.505);
    assert!(halfway.distance(DVec3::new(1.0, 0.0, -1.0).normalize()) < 1e-12, "{halfway}");
    let fov = |own_s| path.at(own_s).fov_deg.unwrap();
    assert_eq!([fov(0.0), fov(path.length_s())], [60.0, 30.0]);
    assert!(fov(1.9) < 50.0 && fov(1.9) > 40.0);
}
