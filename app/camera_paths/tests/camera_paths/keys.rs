//! Law: a camera passes through its keys, its celerity is the derivative of its place by its own clock, and its clock
//! and the world's are each other's inverse. A wrong program leaps at the keys, or takes one time for the other.
#![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

use crate::support::{assert_derivatives, path};
use glam::DVec3;

const LIGHT: f64 = 10.0;
const KEYS: [(f64, [f64; 3]); 5] = [
    (2.0, [0.0, 1.6, 0.0]),
    (3.0, [4.0, 1.6, -3.0]),
    (3.5, [5.0, 2.0, -5.0]),
    (6.0, [5.0, 2.0, -20.0]),
    (7.0, [9.0, 1.0, -22.0]),
];

fn text(time: &str, stop: &str) -> String {
    let key = |(at, position): &(f64, [f64; 3])| format!("[[key]]\nat = {at:?}\nposition = {position:?}\n{stop}\n");
    format!("time = \"{time}\"\n{}", KEYS.iter().map(key).collect::<String>())
}

#[test]
fn keys_over_own_time_are_met_by_the_cameras_clock() {
    let path = path(&text("own", ""), LIGHT);
    assert_eq!(path.length_s(), 5.0);
    assert_derivatives(&path, LIGHT, 1e-7);
    for (at, position) in KEYS {
        let event = path.at(at - 2.0).gaze.observer.event;
        assert!(event.position.distance(DVec3::from_array(position)) < 1e-12, "{at}");
    }
    // The world's clock is the sum of γ, here by Simpson's rule.
    let gamma = |own_s: f64| path.at(own_s).gaze.observer.celerity.gamma();
    let knots = [0.0, 1.0, 1.5, 4.0, 5.0];
    let simpson = |from: f64, to: f64| {
        let count = 2000;
        let h = (to - from) / f64::from(count);
        let weight = |n: i32| {
            if n == 0 || n == count {
                1.0
            } else if n % 2 == 1 {
                4.0
            } else {
                2.0
            }
        };
        (0..=count).map(|n| weight(n) * gamma(from + h * f64::from(n))).sum::<f64>() * h / 3.0
    };
    let world_s: f64 = knots.windows(2).map(|ends| simpson(ends[0], ends[1])).sum();
    let found = path.at(5.0).gaze.observer.event.ct / LIGHT;
    assert!((found - world_s).abs() < 1e-10, "{found} s for {world_s} s");
}

#[test]
fn keys_over_the_worlds_time_are_met_by_the_worlds_clocks() {
    let path = path(&text("world", ""), LIGHT);
    assert_derivatives(&path, LIGHT, 1e-7);
    assert!(path.length_s() < 4.9, "moving clocks run slow: {}", path.length_s());
    let [begin, end] = [0.0, path.length_s()].map(|own_s| path.at(own_s).gaze.observer.event);
    assert_eq!([begin.ct, end.ct], [2.0 * LIGHT, 7.0 * LIGHT]);
    for (at, position) in KEYS {
        // Own time by halving.
        let (mut low, mut high) = (0.0, path.length_s());
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if path.at(middle).gaze.observer.event.ct < at * LIGHT { low = middle } else { high = middle }
        }
        let event = path.at(high).gaze.observer.event;
        assert!(event.position.distance(DVec3::from_array(position)) < 1e-11, "{at}");
    }
    let fastest = (0..=1000).map(|step| path.at(path.length_s() * f64::from(step) / 1000.0).gaze.observer);
    assert!(fastest.map(|observer| observer.celerity.beta().vector().length()).fold(0.0, f64::max) > 0.6);
}

#[test]
fn a_straight_line_in_world_time_has_the_time_of_a_moving_clock() {
    // 6 m/s of 10: γ = 1.25, exactly.
    let line = "time = \"world\"\n[[key]]\nat = 0\nposition = [0, 0, 0]\n[[key]]\nat = 5\nposition = [0, 0, -30]";
    let path = path(line, LIGHT);
    assert!((path.length_s() - 4.0).abs() < 1e-14);
    let observer = path.at(1.0).gaze.observer;
    assert!((observer.event.ct - 12.5).abs() < 1e-13 && (observer.celerity.vector().z + 0.75).abs() < 1e-14);
}

#[test]
fn own_time_is_inverted_close_to_the_speed_of_light() {
    // An eased way whose fastest moment has 0.9999 of c: 1.5 times the mean.
    let way = 4.0 * 9.999 / 1.5;
    let key = |at: f64, x: f64| format!("[[key]]\nat = {at:?}\nposition = [{x:?}, 0, 0]\nstop = true\n");
    let path = path(&format!("time = \"world\"\n{}{}", key(0.0, 0.0), key(4.0, way)), LIGHT);
    // τ(t) by the midpoint rule in many steps.
    let beta = |t: f64| 0.9999 * 4.0 * (t / 4.0) * (1.0 - t / 4.0);
    let (steps, mut own_s) = (400_000, 0.0);
    let h = 4.0 / f64::from(steps);
    for step in 0..steps {
        if step % 40_000 == 0 {
            let t = h * f64::from(step);
            let observer = path.at(own_s).gaze.observer;
            assert!((observer.event.ct / LIGHT - t).abs() < 1e-7, "{} s for {t} s", observer.event.ct / LIGHT);
            assert!((observer.celerity.beta().vector().length() - beta(t)).abs() < 1e-7);
        }
        own_s += h * (1.0 - beta(h * (f64::from(step) + 0.5)).powi(2)).sqrt();
    }
    assert!((path.length_s() - own_s).abs() < 1e-9, "{} s for {own_s} s", path.length_s());
}

#[test]
fn stops_are_at_rest_and_the_celerity_never_leaps() {
    for time in ["own", "world"] {
        let path = path(&text(time, "stop = true"), 30.0);
        let mut before = path.at(0.0).gaze.observer;
        assert_eq!(before.celerity.magnitude(), 0.0);
        for step in 1..=5000 {
            let now = path.at(path.length_s() * f64::from(step) / 5000.0).gaze.observer;
            assert!(now.celerity.vector().distance(before.celerity.vector()) < 0.01, "{time}: step {step}");
            before = now;
        }
        assert!(before.celerity.magnitude() < 1e-9, "{time}: {}", before.celerity.magnitude());
    }
}

#[test]
fn a_camera_at_a_stop_looks_where_it_will_go() {
    let path = path(&text("own", "stop = true"), LIGHT);
    let towards = (DVec3::from_array(KEYS[1].1) - DVec3::from_array(KEYS[0].1)).normalize();
    for own_s in [0.0, 1e-9, 0.3] {
        let look = path.at(own_s).gaze.observer_from_eye * DVec3::NEG_Z;
        assert!(look.distance(towards) < 1e-6, "{look} at {own_s}");
    }
}

#[test]
fn looks_and_fields_of_view_pass_through_their_keys() {
    let key = |at: f64, x: f64, rest: &str| format!("[[key]]\nat = {at:?}\nposition = [{x:?}, 0, 0]\n{rest}\n");
    let text = [
        key(0.0, 0.0, "look = [1, 0, 0]\nfov = 60"),
        key(1.0, 1.0, ""),
        key(2.0, 2.0, "look = [0, 0, 1]\nup = [0, 1, 1]\nfov = 20"),
        key(3.0, 3.0, "look = [0, -1, 0]\nup = [0, 0, 1]\nfov = 60"),
    ];
    let path = path(&text.concat(), LIGHT);
    let look = |own_s| path.at(own_s).gaze.observer_from_eye * DVec3::NEG_Z;
    for (own_s, expected, fov) in [(0.0, DVec3::X, 60.0), (2.0, DVec3::Z, 20.0), (3.0, DVec3::NEG_Y, 60.0)] {
        assert!(look(own_s).distance(expected) < 1e-12, "{} at {own_s}", look(own_s));
        assert!((path.at(own_s).fov_deg.unwrap() - fov).abs() < 1e-12);
    }
    assert!(path.at(3.0).upright.distance(DVec3::Z) < 1e-12);
    for step in 0..3000 {
        let two = [step, step + 1].map(|step| look(0.001 * f64::from(step)));
        assert!(two[0].distance(two[1]) < 0.005, "the look leaps at {step}");
    }
}
