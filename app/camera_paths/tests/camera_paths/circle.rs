//! Law: on a circle at a constant speed own time is t/γ, the celerity has one magnitude and is along the tangent, and
//! the camera is pulled to the centre. A wrong program takes the world's time for the camera's, or leaves the circle.
#![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

use crate::support::{assert_derivatives, path};
use glam::DVec3;
use physics::aberration::Aberration;
use std::f64::consts::TAU;

/// Circle at β = 0.6, γ = 1.25, in a world where light has 10 m/s.
const LIGHT: f64 = 10.0;
const CIRCLE: &str = "[circle]\ncentre = [3, 2, -5]\nradius = 4\nspeed = 6\nfrom = [1, 7, 0]\nturns = 2";

#[test]
fn own_time_is_the_worlds_over_gamma() {
    let path = path(CIRCLE, LIGHT);
    let expected = 2.0 * TAU * 4.0 / 6.0 / 1.25;
    assert!((path.length_s() - expected).abs() < 1e-13, "{}", path.length_s());
    let end = path.at(path.length_s()).gaze.observer.event;
    assert!((end.ct - 1.25 * expected * LIGHT).abs() < 1e-11);
    assert!(end.position.distance(DVec3::new(7.0, 2.0, -5.0)) < 1e-12, "{}", end.position);
}

#[test]
fn the_celerity_is_that_of_a_circle() {
    let path = path(CIRCLE, LIGHT);
    assert_derivatives(&path, LIGHT, 1e-8);
    for step in 0..=100 {
        let own_s = path.length_s() * f64::from(step) / 100.0;
        let observer = path.at(own_s).gaze.observer;
        let radius = observer.event.position - DVec3::new(3.0, 2.0, -5.0);
        assert!((radius.length() - 4.0).abs() < 1e-13 && radius.y.abs() < 1e-13);
        assert!((observer.celerity.magnitude() - 0.75).abs() < 1e-14);
        assert!(radius.dot(observer.celerity.vector()).abs() < 1e-12);
        // Right-handed about the normal, y.
        assert!(radius.cross(observer.celerity.vector()).y > 0.0);
    }
}

#[test]
fn the_acceleration_points_to_the_centre() {
    // du/dτ = γ² v²/(r c), of two celerities by differences.
    let path = path(CIRCLE, LIGHT);
    let step_s = 1e-5;
    for own_s in [0.1, 1.0, 2.7, 5.0] {
        let [before, at, after] = [-step_s, 0.0, step_s].map(|step| path.at(own_s + step).gaze.observer);
        let acceleration = (after.celerity.vector() - before.celerity.vector()) / (2.0 * step_s);
        let inward = (DVec3::new(3.0, 2.0, -5.0) - at.event.position).normalize();
        let expected = inward * (1.25 * 1.25 * 36.0 / (4.0 * LIGHT));
        assert!(acceleration.distance(expected) < 1e-8, "{acceleration} for {expected}");
    }
}

#[test]
fn a_period_is_a_speed() {
    let by_period =
        path("[circle]\ncentre = [0, 0, 0]\nradius = 4\nperiod = 4.1887902047863905\nnormal = [0, 0, 2]", LIGHT);
    let observer = by_period.at(0.3).gaze.observer;
    assert!((observer.celerity.magnitude() - 0.75).abs() < 1e-14);
    assert!(observer.event.position.z.abs() < 1e-14 && observer.celerity.vector().z.abs() < 1e-14);
}

#[test]
fn the_camera_looks_ahead_or_at_what_it_watches() {
    let ahead = path(CIRCLE, LIGHT).at(1.0);
    let look = ahead.gaze.observer_from_eye * DVec3::NEG_Z;
    assert!(look.distance(ahead.gaze.observer.celerity.vector().normalize()) < 1e-12);
    assert!(ahead.upright.distance(DVec3::Y) < 1e-12);
    // The centre is seen where its light comes from, forward of where it is.
    let watching = path(&format!("watch = [3, 2, -5]\n{CIRCLE}\nfov = 40"), LIGHT).at(1.0);
    let look = watching.gaze.observer_from_eye * DVec3::NEG_Z;
    let observer = watching.gaze.observer;
    let (seen, _) =
        Aberration::new(observer.celerity).observer_from_world(DVec3::new(3.0, 2.0, -5.0) - observer.event.position);
    assert!(look.distance(seen) < 1e-12);
    // From abeam in the world: cos θ' = β.
    assert!((look.dot(observer.celerity.direction().unwrap()) - 0.6).abs() < 1e-12);
    assert_eq!(watching.fov_deg, Some(40.0));
}
