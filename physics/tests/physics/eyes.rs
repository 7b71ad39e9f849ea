//! Law: both eyes look at one moment of the observer's time (B 5.2). A wrong program would take the eyes at one moment
//! of the world.

use exact_reference::random::{direction, seeded};
use physics::eyes::{EyesError, eyes};
use physics::glam::DVec3;
use physics::{Celerity, Event, Observer};

use crate::support::{EPSILON, celerity};

#[test]
fn eyes_along_the_motion_are_apart_by_gamma_and_one_later() {
    let celerity = Celerity::new(DVec3::new(0.75, 0.0, 0.0)).unwrap();
    let observer = Observer { event: Event { ct: 1.0, position: DVec3::Y }, celerity };
    let eyes = eyes(&observer, 2.0, DVec3::new(7.0, 0.0, 0.0)).unwrap();
    assert_eq!(eyes.right, Event { ct: 1.75, position: DVec3::new(1.25, 1.0, 0.0) });
    assert_eq!(eyes.left, Event { ct: 0.25, position: DVec3::new(-1.25, 1.0, 0.0) });
}

#[test]
fn eyes_across_the_motion_are_as_at_rest() {
    let observer = Observer { event: Event::default(), celerity: Celerity::new(DVec3::new(0.0, 0.0, -1e3)).unwrap() };
    let eyes = eyes(&observer, 0.064, DVec3::X).unwrap();
    assert_eq!(eyes.right, Event { ct: 0.0, position: DVec3::new(0.032, 0.0, 0.0) });
    assert_eq!(eyes.left, Event { ct: 0.0, position: DVec3::new(-0.032, 0.0, 0.0) });
}

#[test]
fn eyes_are_simultaneous_and_apart_for_the_observer() {
    let mut random = seeded(41);
    for _ in 0..1000 {
        let observer = Observer { event: Event::default(), celerity: celerity(&mut random, -6.0..5.0) };
        let right = direction(&mut random);
        let eyes = eyes(&observer, 2.0, right).unwrap();
        let apart = observer.observer_from_world().apply(eyes.right - eyes.left);
        // The events are rounded at γ and come back multiplied by γ.
        let tolerance = 16.0 * EPSILON * observer.celerity.gamma().powi(2);
        assert!(apart.t.abs() < tolerance && apart.r.distance(2.0 * right) < tolerance, "{observer:?} {right}");
    }
}

#[test]
fn eyes_that_are_none_are_refused() {
    let observer = Observer::default();
    for separation in [-1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(eyes(&observer, separation, DVec3::X), Err(EyesError::Separation { .. })));
    }
    for right in [DVec3::ZERO, DVec3::NAN, DVec3::splat(f64::INFINITY)] {
        assert!(matches!(eyes(&observer, 1.0, right), Err(EyesError::Right { .. })));
    }
    assert_eq!(eyes(&observer, 0.0, DVec3::X).unwrap().left, observer.event);
}
