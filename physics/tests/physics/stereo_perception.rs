//! Law: two eyes see a moving source at two of its moments, and perceive it where the sight lines come closest (B 3.4).
//! A wrong program would perceive a passing source where it is.

use exact_reference::random::{seeded, size, vector};
use physics::glam::DVec3;
use physics::stereo_perception::{StereoPerceptionError, perceived_place};
use physics::{Celerity, Event, Observer, PointSource, apparent};

use crate::support::{celerity, relative_difference};

/// Half the distance between the eyes, metres.
const HALF: f64 = 0.5;

fn pair() -> [DVec3; 2] {
    [DVec3::new(HALF, 0.0, 0.0), DVec3::new(-HALF, 0.0, 0.0)]
}

#[test]
fn source_at_rest_is_perceived_where_it_is() {
    /// Rounding over the angle between the sight lines, which is at least 1e-3.
    const TOLERANCE: f64 = 1e-12;
    let mut random = seeded(42);
    for _ in 0..500 {
        let position = vector(&mut random, 0.0..2.0) + DVec3::new(0.0, 10.0, 0.0);
        let Ok(seen) = perceived_place(pair(), &PointSource { position, celerity: Celerity::ZERO }, 3.0) else {
            panic!("{position} is off the line through the eyes");
        };
        let vergence = (position - pair()[0]).angle_between(position - pair()[1]);
        assert!(seen.position.distance(position) < TOLERANCE / vergence, "{position} {seen:?}");
        assert!(seen.gap < TOLERANCE);
    }
}

/// B eq. 3.9: a source that moves along the line of the eyes, at (x', y') in its own frame.
fn along_the_eyes(x: f64, y: f64, u: f64, time: f64) -> DVec3 {
    let gamma = u.hypot(1.0);
    let beta = u / gamma;
    let now = x / gamma + beta * time;
    let [q0, q1] = [-HALF, HALF].map(|a| (now + a).hypot(y / gamma));
    let divisor = 1.0 + beta / (2.0 * HALF) * (q0 - q1);
    DVec3::new((now - 0.5 * beta * (q0 + q1)) / divisor, y / (gamma * gamma) / divisor, 0.0)
}

#[test]
fn source_along_the_eyes_is_perceived_where_borchers_puts_it() {
    const TOLERANCE: f64 = 1e-11;
    let mut random = seeded(43);
    for u in [0.0, 0.75, -0.75, 3.0, -3.0] {
        for _ in 0..100 {
            let place = vector(&mut random, -0.5..0.5);
            let (x, y, time) = (place.x, place.y.abs() + 0.1, place.z);
            let celerity = Celerity::new(DVec3::new(u, 0.0, 0.0)).unwrap();
            let source = PointSource { position: DVec3::new(x / celerity.gamma(), y, 0.0), celerity };
            let seen = perceived_place(pair(), &source, time).unwrap();
            let expected = along_the_eyes(x, y, u, time);
            assert!(relative_difference(seen.position, expected) < TOLERANCE, "{source:?} {seen:?} {expected}");
            assert!(seen.gap < TOLERANCE);
        }
    }
}

#[test]
fn perceived_place_is_midway_between_the_sight_lines() {
    const TOLERANCE: f64 = 1e-9;
    let mut random = seeded(44);
    let mut widest: f64 = 0.0;
    for _ in 0..200 {
        let source =
            PointSource { position: vector(&mut random, -0.5..0.5), celerity: celerity(&mut random, -1.0..1.0) };
        let time = size(&mut random, -1.0..0.5);
        let seen = perceived_place(pair(), &source, time).unwrap();
        widest = widest.max(seen.gap);
        // The middle is half a gap from one line and half a gap the opposite way from the other, square to both.
        let [first, second] = pair().map(|eye| {
            let observer = Observer { event: Event { ct: time, position: eye }, celerity: Celerity::ZERO };
            let line = apparent::moving(&observer, &source).position.normalize();
            (eye - seen.position).reject_from_normalized(line)
        });
        let scale = seen.position.length() + 1.0;
        assert!((first + second).length() < TOLERANCE * scale, "{source:?} {seen:?}");
        assert!((first.length() - 0.5 * seen.gap).abs() < TOLERANCE * scale, "{source:?} {seen:?}");
    }
    assert!(widest > 0.01, "every motion kept to a plane through the eyes: {widest}");
}

#[test]
fn blind_cases_are_refused() {
    let resting = |position| PointSource { position, celerity: Celerity::ZERO };
    let on_the_line = perceived_place(pair(), &resting(DVec3::new(3.0, 0.0, 0.0)), 0.0);
    assert!(matches!(on_the_line, Err(StereoPerceptionError::Parallel { .. })), "{on_the_line:?}");
    let far = perceived_place(pair(), &resting(DVec3::new(0.0, 0.0, -1e20)), 0.0);
    assert!(matches!(far, Err(StereoPerceptionError::Parallel { .. })), "{far:?}");
    let at_eye = perceived_place(pair(), &resting(pair()[0]), 0.0);
    assert!(matches!(at_eye, Err(StereoPerceptionError::SourceAtEye { .. })), "{at_eye:?}");
    let one_eye = perceived_place([DVec3::ONE; 2], &resting(DVec3::ZERO), 0.0);
    assert!(matches!(one_eye, Err(StereoPerceptionError::EyesCoincide { .. })), "{one_eye:?}");
    for bad in [f64::NAN, f64::INFINITY] {
        assert_eq!(perceived_place(pair(), &resting(DVec3::Y), bad), Err(StereoPerceptionError::NotFinite));
        assert_eq!(perceived_place(pair(), &resting(DVec3::Y * bad), 0.0), Err(StereoPerceptionError::NotFinite));
        assert_eq!(
            perceived_place([DVec3::X, DVec3::X * bad], &resting(DVec3::Y), 0.0),
            Err(StereoPerceptionError::NotFinite)
        );
    }
}
