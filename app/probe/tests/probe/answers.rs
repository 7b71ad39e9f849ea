//! Law: `probe` answers with the numbers of special relativity, and each key means what its description says. A wrong
//! program would take a source's position for that at the observer's time, make the eyes simultaneous in the world,
//! turn the legs' accelerations with the gyroscopes, or compose two velocities in the wrong order.
//!
//! Expected numbers are closed forms. For random questions they come from the textbook's formulas, written out here.
#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests, too, may fail the test")]

use glam::{DQuat, DVec3};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use serde_json::{Value, json};

/// Tolerance for the rounding of a few operations on numbers near 1.
const ROUNDING: f64 = 4e-15;
/// Tolerance for the textbook's formulas at the random celerities below, γ to about 30.
const TEXTBOOK_ROUNDING: f64 = 1e-11;

fn ask(question: Value) -> Value {
    probe::answer(&question.to_string()).unwrap_or_else(|error| panic!("{question}: {error}"))
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is not a number"))
}

fn vector(value: &Value) -> DVec3 {
    let numbers: [f64; 3] = serde_json::from_value(value.clone()).unwrap();
    DVec3::from_array(numbers)
}

fn quaternion(value: &Value) -> DQuat {
    let numbers: [f64; 4] = serde_json::from_value(value.clone()).unwrap();
    DQuat::from_array(numbers)
}

#[track_caller]
fn assert_close(found: f64, expected: f64, tolerance: f64) {
    assert!((found - expected).abs() <= tolerance * expected.abs().max(1.0), "{found} is not {expected}");
}

#[track_caller]
fn assert_near(found: DVec3, expected: DVec3, tolerance: f64) {
    assert!((found - expected).length() <= tolerance * expected.length().max(1.0), "{found} is not {expected}");
}

/// Vector of random direction and of a length up to `longest`.
fn random_vector(random: &mut ChaCha8Rng, longest: f64) -> DVec3 {
    loop {
        let vector = DVec3::from_array(random.random::<[f64; 3]>()) * 2.0 - DVec3::ONE;
        if vector.length() < 1.0 {
            return vector * longest;
        }
    }
}

/// Event (t, r) boosted by the textbook's formula into the frame of an observer of celerity u.
fn boosted(u: DVec3, t: f64, r: DVec3) -> (f64, DVec3) {
    let gamma = (1.0 + u.length_squared()).sqrt();
    (gamma * t - u.dot(r), r + u * (u.dot(r) / (1.0 + gamma) - t))
}

#[test]
fn light_from_abeam_is_seen_ahead_at_three_fifths_of_light() {
    let expected = json!({ "direction": [0.6, 0.8, 0.0], "D": 1.25 });
    assert_eq!(ask(json!({ "ask": "aberration", "celerity": [0.75, 0, 0], "direction": [0, 1, 0] })), expected);
    assert_eq!(ask(json!({ "ask": "aberration", "beta": [0.6, 0, 0], "direction": [0, 1, 0] })), expected);
}

#[test]
fn ahead_is_blue_and_astern_is_red() {
    for (direction, doppler) in [(1.0, 2.0), (-1.0, 0.5)] {
        let question = json!({ "ask": "aberration", "celerity": [0.75, 0, 0], "direction": [direction, 0, 0] });
        assert_eq!(ask(question), json!({ "direction": [direction, 0.0, 0.0], "D": doppler }));
    }
}

#[test]
fn the_length_of_a_direction_means_nothing() {
    for length in [5e-324, 1e-300, 3.0, 1e300, f64::MAX] {
        let answer = ask(json!({ "ask": "aberration", "celerity": [0.75, 0, 0], "direction": [0, length, 0] }));
        assert_near(vector(&answer["direction"]), DVec3::new(0.6, 0.8, 0.0), ROUNDING);
        assert_close(number(&answer["D"]), 1.25, ROUNDING);
        let question = json!({
            "ask": "eyes", "observer": { "position": [0, 0, 0], "celerity": [0, 0, 0] }, "separation": 2,
            "right": [length, 0, 0],
        });
        assert_eq!(ask(question)["right"]["position"], json!([1.0, 0.0, 0.0]), "{length}");
    }
}

#[test]
fn aberration_holds_at_a_celerity_of_a_million_million() {
    // D = 2u ahead and 1/(2u) astern; 1/u from astern, tan(θ'/2) = e^(−η) tan(θ/2) gives 90 degrees and D = 1/u.
    let aberration = |x: f64, y: f64| {
        let answer = ask(json!({ "ask": "aberration", "celerity": [1e12, 0, 0], "direction": [x, y, 0] }));
        (vector(&answer["direction"]), number(&answer["D"]))
    };
    assert_eq!(aberration(1.0, 0.0), (DVec3::X, 2e12));
    assert_eq!(aberration(-1.0, 0.0), (DVec3::NEG_X, 5e-13));
    let (direction, doppler) = aberration(-1.0, 1e-12);
    assert_near(direction, DVec3::Y, ROUNDING);
    assert_close(doppler * 1e12, 1.0, ROUNDING);
}

#[test]
fn a_moving_clock_runs_slow() {
    let answer = ask(json!({ "ask": "boost", "celerity": [0.75, 0, 0], "event": [1, 0, 0, 0] }));
    assert_eq!(answer, json!({ "event": [1.25, -0.75, 0.0, 0.0] }));
}

#[test]
fn numbers_pass_to_the_last_bit() {
    let mut random = ChaCha8Rng::seed_from_u64(1);
    let mut numbers = vec![0.1, 1.0 / 3.0, f64::MAX, f64::MIN_POSITIVE, 5e-324, -0.0, 9_007_199_254_740_993.0];
    numbers.extend((0..1000).map(|_| f64::from_bits(random.random())).filter(|number| number.is_finite()));
    for number in numbers {
        // The boost to rest changes nothing. Each number is written once in its shortest form and once with 17 digits.
        for digits in [format!("{number:e}"), format!("{number:.16e}")] {
            let line = format!(r#"{{"ask": "boost", "celerity": [0, 0, 0], "event": [{digits}, 0, 0, {digits}]}}"#);
            let text = probe::answer(&line).unwrap().to_string();
            let answer: Value = serde_json::from_str(&text).unwrap();
            let event: [f64; 4] = serde_json::from_value(answer["event"].clone()).unwrap();
            assert_eq!([event[0], event[3]].map(f64::to_bits), [number.to_bits(); 2], "{line} {text}");
        }
    }
}

#[test]
fn random_boosts_are_the_textbooks() {
    let mut random = ChaCha8Rng::seed_from_u64(2);
    for _ in 0..200 {
        let (u, r, t) = (random_vector(&mut random, 10.0), random_vector(&mut random, 5.0), random.random::<f64>());
        let answer = ask(json!({ "ask": "boost", "celerity": u.to_array(), "event": [t, r.x, r.y, r.z] }));
        let event: [f64; 4] = serde_json::from_value(answer["event"].clone()).unwrap();
        let (expected_t, expected_r) = boosted(u, t, r);
        assert_close(event[0], expected_t, TEXTBOOK_ROUNDING);
        assert_near(DVec3::new(event[1], event[2], event[3]), expected_r, TEXTBOOK_ROUNDING);
    }
}

#[test]
fn celerities_along_one_line_add_as_rapidities() {
    let answer = ask(json!({ "ask": "compose", "vehicle": [0.75, 0, 0], "head": [0.75, 0, 0] }));
    assert_eq!(vector(&answer["celerity"]), DVec3::new(1.875, 0.0, 0.0)); // β = 15/17
    assert_eq!(quaternion(&answer["wigner"]), DQuat::IDENTITY);
}

#[test]
fn a_head_across_the_motion_is_turned_towards_it() {
    // u = (γ₂ u₁, u₂); the angle ε with tan(ε/2) = t₁ t₂ = 1/9 (t = u/(1+γ) = 1/3) turns x towards y.
    let answer = ask(json!({ "ask": "compose", "vehicle": [0.75, 0, 0], "head": [0, 0.75, 0] }));
    assert_near(vector(&answer["celerity"]), DVec3::new(0.9375, 0.75, 0.0), ROUNDING);
    let expected = DQuat::from_xyzw(0.0, 0.0, 1.0 / 82_f64.sqrt(), 9.0 / 82_f64.sqrt());
    assert!((quaternion(&answer["wigner"]) - expected).length() < ROUNDING, "{answer}");
    // Velocities within `compose` may also be given as β.
    let question =
        json!({ "ask": "compose", "vehicle": { "beta": [0.6, 0, 0] }, "head": { "celerity": [0, 0.75, 0] } });
    assert_eq!(ask(question), answer);
}

#[test]
fn two_boosts_are_the_composed_one_and_then_the_wigner_rotation() {
    let mut random = ChaCha8Rng::seed_from_u64(3);
    for _ in 0..200 {
        let (vehicle, head) = (random_vector(&mut random, 5.0), random_vector(&mut random, 5.0));
        let answer = ask(json!({ "ask": "compose", "vehicle": vehicle.to_array(), "head": head.to_array() }));
        let (t, r) = (random.random::<f64>(), random_vector(&mut random, 1.0));
        let (t_vehicle, r_vehicle) = boosted(vehicle, t, r);
        let (t_head, r_head) = boosted(head, t_vehicle, r_vehicle);
        let (t_once, r_once) = boosted(vector(&answer["celerity"]), t, r);
        assert_close(t_once, t_head, TEXTBOOK_ROUNDING);
        assert_near(quaternion(&answer["wigner"]) * r_once, r_head, TEXTBOOK_ROUNDING);
    }
}

#[test]
fn a_point_ahead_appears_twice_as_far() {
    let question = json!({
        "ask": "apparent", "observer": { "position": [1, 0, 0], "celerity": [0.75, 0, 0] },
        "source": { "position": [5, 0, 0] },
    });
    assert_eq!(ask(question), json!({ "position": [8.0, 0.0, 0.0], "D": 2.0, "emitted_at": -4.0 }));
}

#[test]
fn a_sources_position_is_that_at_world_time_zero() {
    // x = 4 + 0.6 t meets the light cone 10 − t = x at t = 3.75.
    let question = json!({
        "ask": "apparent", "observer": { "position": [0, 0, 0], "time": 10, "beta": [0, 0, 0] },
        "source": { "position": [4, 0, 0], "beta": [0.6, 0, 0] },
    });
    assert_eq!(ask(question), json!({ "position": [6.25, 0.0, 0.0], "D": 0.5, "emitted_at": 3.75 }));
}

#[test]
fn random_sources_are_seen_where_their_light_comes_from() {
    let mut random = ChaCha8Rng::seed_from_u64(4);
    for _ in 0..200 {
        let (u, v) = (random_vector(&mut random, 5.0), random_vector(&mut random, 5.0));
        let (observer, source) = (random_vector(&mut random, 9.0), random_vector(&mut random, 9.0));
        let time = random.random_range(-9.0..9.0);
        let answer = ask(json!({
            "ask": "apparent",
            "observer": { "position": observer.to_array(), "time": time, "celerity": u.to_array() },
            "source": { "position": source.to_array(), "celerity": v.to_array() },
        }));
        // The emission event is on the source's worldline and on the observer's past light cone.
        let emitted_at = number(&answer["emitted_at"]);
        let gamma_source = (1.0 + v.length_squared()).sqrt();
        let displacement = source + v * (emitted_at / gamma_source) - observer;
        assert_close(time - emitted_at, displacement.length(), TEXTBOOK_ROUNDING);
        // The apparent position is the boosted displacement.
        let (t, r) = boosted(u, emitted_at - time, displacement);
        let position = vector(&answer["position"]);
        assert_near(position, r, TEXTBOOK_ROUNDING);
        assert_close(position.length(), -t, TEXTBOOK_ROUNDING);
        // The frequency is the product of the wave's four-vector and the four-velocity.
        let n = displacement.normalize();
        let gamma_observer = (1.0 + u.length_squared()).sqrt();
        let doppler = (gamma_observer + u.dot(n)) / (gamma_source + v.dot(n));
        assert_close(number(&answer["D"]), doppler, TEXTBOOK_ROUNDING);
    }
}

#[test]
fn the_eyes_look_at_one_moment_of_the_observers() {
    // The eyes are two metres apart along the motion: 2.5 apart in the world, the forward eye 1.5 later.
    let question = json!({
        "ask": "eyes", "observer": { "position": [1, 2, 3], "time": 5, "celerity": [0.75, 0, 0] }, "separation": 2,
        "right": [7, 0, 0],
    });
    let expected = json!({
        "left": { "position": [-0.25, 2.0, 3.0], "time": 4.25 },
        "right": { "position": [2.25, 2.0, 3.0], "time": 5.75 },
    });
    assert_eq!(ask(question), expected);
}

#[test]
fn random_eyes_are_their_separation_apart_for_the_observer() {
    let mut random = ChaCha8Rng::seed_from_u64(5);
    for _ in 0..100 {
        let (u, right) = (random_vector(&mut random, 5.0), random_vector(&mut random, 3.0));
        let answer = ask(json!({
            "ask": "eyes", "observer": { "position": [0, 0, 0], "celerity": u.to_array() }, "separation": 0.065,
            "right": right.to_array(),
        }));
        let (left_eye, right_eye) = (&answer["left"], &answer["right"]);
        let (t, r) = boosted(
            u,
            number(&right_eye["time"]) - number(&left_eye["time"]),
            vector(&right_eye["position"]) - vector(&left_eye["position"]),
        );
        assert_close(t, 0.0, TEXTBOOK_ROUNDING);
        assert_near(r, right.normalize() * 0.065, TEXTBOOK_ROUNDING);
    }
}

/// End of a worldline: position, time, celerity, proper time.
fn travel(start: Value, legs: Value, step: f64, integrator: &str) -> (DVec3, f64, DVec3, f64) {
    let end = ask(json!({
        "ask": "worldline", "start": start, "legs": legs, "step": step, "integrator": integrator,
    }));
    (vector(&end["position"]), number(&end["time"]), vector(&end["celerity"]), number(&end["proper_time"]))
}

/// Tolerance of each integrator at a hundred steps a unit, about unit acceleration for about two units: order four,
/// order two (its accelerations are constant in other axes than the legs'), and its own error control.
const INTEGRATORS: [(&str, f64); 3] = [("rk4", 1e-8), ("exact", 1e-4), ("dopri5", 1e-10)];

#[test]
fn steady_thrust_from_rest_is_hyperbolic_motion() {
    for (integrator, tolerance) in INTEGRATORS {
        let legs =
            json!([{ "duration": 1.5, "acceleration": [0, 0, -1] }, { "duration": 0.5, "acceleration": [0, 0, -1] }]);
        let start = json!({ "position": [1, 2, 3], "time": 4, "celerity": [0, 0, 0] });
        let (position, time, celerity, proper_time) = travel(start, legs, 0.01, integrator);
        assert_near(position, DVec3::new(1.0, 2.0, 3.0 - (2_f64.cosh() - 1.0)), tolerance);
        assert_close(time, 4.0 + 2_f64.sinh(), tolerance);
        assert_near(celerity, DVec3::new(0.0, 0.0, -(2_f64.sinh())), tolerance);
        assert_close(proper_time, 2.0, ROUNDING);
    }
}

#[test]
fn the_exact_integrator_is_exact_along_a_line() {
    /// Tolerance for the rounding of two hundred steps.
    const TOLERANCE: f64 = 1e-13;
    let legs = json!([{ "duration": 2, "acceleration": [0, 3, 0] }]);
    let (position, time, celerity, _) =
        travel(json!({ "position": [0, 0, 0], "beta": [0, 0.6, 0] }), legs, 0.01, "exact");
    let (first, last) = (2_f64.ln(), 6.0 + 2_f64.ln());
    assert_close(position.y, (last.cosh() - first.cosh()) / 3.0, TOLERANCE);
    assert_close(time, (last.sinh() - first.sinh()) / 3.0, TOLERANCE);
    assert_close(celerity.y, last.sinh(), TOLERANCE);
}

#[test]
fn there_and_back_the_traveller_is_younger() {
    let leg = |x: f64| json!({ "duration": 1, "acceleration": [x, 0, 0] });
    for (integrator, tolerance) in INTEGRATORS {
        let legs = json!([leg(1.0), leg(-1.0), leg(-1.0), leg(1.0)]);
        let (position, time, celerity, proper_time) =
            travel(json!({ "position": [0, 0, 0], "celerity": [0, 0, 0] }), legs, 0.01, integrator);
        assert_near(position, DVec3::ZERO, tolerance);
        assert_near(celerity, DVec3::ZERO, tolerance);
        assert_close(time, 4.0 * 1_f64.sinh(), tolerance);
        assert_eq!(proper_time, 4.0);
    }
}

#[test]
fn thrust_keeps_its_direction_in_the_axes_of_the_pure_boost() {
    // With a along x and u₀ = (0, 0.75, 0), u_y/(1+γ) keeps its value C = 1/3, because dγ/dτ = a u_x and
    // du_y/dτ = a u_x u_y/(1+γ). Then γ = (C² + cosh kτ)/(1 − C²) with k = √(1 − C²), and the rest by integration.
    // Thrust that kept its direction against gyroscopes would end elsewhere.
    let (tau, k) = (2.0_f64, 8_f64.sqrt() / 3.0);
    let gamma = (1.0 / 9.0 + (k * tau).cosh()) * 9.0 / 8.0;
    let time = (tau / 9.0 + (k * tau).sinh() / k) * 9.0 / 8.0;
    let expected_celerity = DVec3::new((k * tau).sinh() * k * 9.0 / 8.0, (1.0 + gamma) / 3.0, 0.0);
    let expected_position = DVec3::new(((k * tau).cosh() - 1.0) * 9.0 / 8.0, (tau + time) / 3.0, 0.0);
    for (integrator, tolerance) in INTEGRATORS {
        let legs = json!([{ "duration": tau, "acceleration": [1, 0, 0] }]);
        let start = json!({ "position": [0, 0, 0], "celerity": [0, 0.75, 0] });
        let (position, found_time, celerity, _) = travel(start, legs, 0.01, integrator);
        assert_near(celerity, expected_celerity, tolerance);
        assert_near(position, expected_position, tolerance);
        assert_close(found_time, time, tolerance);
    }
}

#[test]
fn a_step_need_not_divide_a_leg() {
    // A leg of 1 in steps of at most 0.3 takes four steps of 0.25.
    let start = || json!({ "position": [0, 0, 0], "celerity": [0, 0, 0] });
    let leg = || json!([{ "duration": 1, "acceleration": [1, 2, 3] }]);
    let by_quarters = travel(start(), leg(), 0.25, "rk4");
    assert_eq!(travel(start(), leg(), 0.3, "rk4"), by_quarters);
    assert_ne!(travel(start(), leg(), 0.2, "rk4"), by_quarters);
    assert_eq!(by_quarters.3, 1.0);
}

#[test]
fn without_legs_or_duration_nothing_happens() {
    let start = json!({ "position": [1, 2, 3], "time": 4, "celerity": [5, 6, 7] });
    let nothing = (DVec3::new(1.0, 2.0, 3.0), 4.0, DVec3::new(5.0, 6.0, 7.0), 0.0);
    assert_eq!(travel(start.clone(), json!([]), 1.0, "rk4"), nothing);
    assert_eq!(travel(start, json!([{ "duration": 0, "acceleration": [1, 0, 0] }]), 1.0, "rk4"), nothing);
}

#[test]
fn the_default_integrator_is_rk4_and_the_default_time_zero() {
    let legs = || json!([{ "duration": 1, "acceleration": [1, 2, 3] }]);
    let short = ask(json!({
        "ask": "worldline", "start": { "position": [0, 0, 0], "celerity": [0, 0, 0] }, "legs": legs(), "step": 0.5,
    }));
    let end = |integrator: &str| {
        ask(json!({
            "ask": "worldline", "start": { "position": [0, 0, 0], "time": 0, "celerity": [0, 0, 0] }, "legs": legs(),
            "step": 0.5, "integrator": integrator,
        }))
    };
    assert_eq!(short, end("rk4"));
    assert_ne!(short, end("exact"));
}

#[test]
fn a_source_at_rest_is_perceived_where_it_is() {
    let answer = ask(json!({
        "ask": "perceived", "eyes": [[-1, 0, 0], [1, 0, 0]],
        "source": { "position": [0.5, 0.25, -4], "celerity": [0, 0, 0] }, "time": 3,
    }));
    assert_near(vector(&answer["position"]), DVec3::new(0.5, 0.25, -4.0), ROUNDING);
    assert!(number(&answer["gap"]) < ROUNDING, "{answer}");
}

#[test]
fn a_source_in_the_plane_between_the_eyes_is_perceived_where_its_light_left_it() {
    // The distance is 5 from either eye: the light seen at 10 left at 5, when the source had gone 3 up from its place
    // at 0.
    let answer = ask(json!({
        "ask": "perceived", "eyes": [[-3, 0, 0], [3, 0, 0]],
        "source": { "position": [0, -3, -4], "beta": [0, 0.6, 0] }, "time": 10,
    }));
    assert_near(vector(&answer["position"]), DVec3::new(0.0, 0.0, -4.0), ROUNDING);
    assert!(number(&answer["gap"]) < ROUNDING, "{answer}");
}

#[test]
fn random_sources_are_perceived_midway_between_the_sight_lines() {
    let mut random = ChaCha8Rng::seed_from_u64(6);
    for _ in 0..100 {
        let eyes = [random_vector(&mut random, 1.0), random_vector(&mut random, 1.0)];
        let source = random_vector(&mut random, 1.0) + DVec3::NEG_Z * 4.0;
        let celerity = random_vector(&mut random, 2.0);
        let answer = ask(json!({
            "ask": "perceived", "eyes": eyes.map(|eye| eye.to_array()),
            "source": { "position": source.to_array(), "celerity": celerity.to_array() }, "time": 0.5,
        }));
        let perceived = vector(&answer["position"]);
        // The shortest line from one sight line to the other is perpendicular to both; its middle is half its length
        // away from each.
        let to_sight_line = |eye: DVec3| {
            let seen = ask(json!({
                "ask": "apparent", "observer": { "position": eye.to_array(), "time": 0.5, "celerity": [0, 0, 0] },
                "source": { "position": source.to_array(), "celerity": celerity.to_array() },
            }));
            let line = vector(&seen["position"]).normalize();
            (eye - perceived).reject_from_normalized(line)
        };
        let [left, right] = eyes.map(to_sight_line);
        // Sight lines at a small angle cost some digits.
        const TOLERANCE: f64 = 1e-10;
        assert_near(left, -right, TOLERANCE);
        assert_close(left.length(), number(&answer["gap"]) / 2.0, TOLERANCE);
    }
}

#[test]
fn beta_stands_for_celerity_in_every_question() {
    let same = |by_celerity: &str| {
        let by_beta = by_celerity.replace(r#""celerity":[0.75,0,0]"#, r#""beta":[0.6,0,0]"#);
        assert_ne!(by_celerity, by_beta);
        assert_eq!(probe::answer(by_celerity).unwrap(), probe::answer(&by_beta).unwrap(), "{by_beta}");
    };
    same(r#"{"ask":"aberration","celerity":[0.75,0,0],"direction":[1,2,3]}"#);
    same(r#"{"ask":"boost","celerity":[0.75,0,0],"event":[1,2,3,4]}"#);
    same(r#"{"ask":"compose","vehicle":{"celerity":[0.75,0,0]},"head":[0,1,0]}"#);
    same(r#"{"ask":"compose","vehicle":[0,1,0],"head":{"celerity":[0.75,0,0]}}"#);
    same(
        r#"{"ask":"apparent","observer":{"position":[1,2,3],"celerity":[0.75,0,0]},"source":{"position":[0,0,0],"celerity":[0.75,0,0]}}"#,
    );
    same(r#"{"ask":"eyes","observer":{"position":[1,2,3],"celerity":[0.75,0,0]},"separation":0.1,"right":[1,2,3]}"#);
    same(
        r#"{"ask":"worldline","start":{"position":[1,2,3],"celerity":[0.75,0,0]},"legs":[{"duration":1,"acceleration":[1,1,1]}],"step":0.1}"#,
    );
    same(
        r#"{"ask":"perceived","eyes":[[0,0,0],[1,0,0]],"source":{"position":[1,2,3],"celerity":[0.75,0,0]},"time":1}"#,
    );
}

fn colour(spectrum: Value, doppler: f64) -> (DVec3, DVec3) {
    let answer = ask(json!({ "ask": "colour", "spectrum": spectrum, "D": doppler }));
    (vector(&answer["xyz"]), vector(&answer["rgb"]))
}

/// Law: a black body shifted by D looks like one of temperature D·T: its radiance becomes D⁵ L(Dλ).
#[test]
fn a_planck_spectrum_is_seen_as_one_of_another_temperature() {
    for (kelvin, doppler) in [(2800.0, 2.0), (5900.0, 0.1), (5900.0, 10.0), (1e-3, 1e6), (1e10, 1e-6)] {
        let (xyz, rgb) = colour(json!({ "planck": kelvin }), doppler);
        let (expected, expected_rgb) = colour(json!({ "planck": kelvin * doppler }), 1.0);
        // Wien's exponent, below 70 here, is rounded before it is raised.
        assert!(
            ((xyz - expected) / expected).abs().max_element() < 1e-12,
            "{kelvin} K, D = {doppler}: {xyz}, {expected}"
        );
        assert!(rgb.distance(expected_rgb) < 1e-12 * rgb.length(), "{kelvin} K, D = {doppler}");
    }
}

#[test]
fn an_rgb_colour_at_rest_is_answered_as_asked() {
    let (xyz, rgb) = colour(json!({ "rgb": [0.25, 0.5, 1.0] }), 1.0);
    assert_near(rgb, DVec3::new(0.25, 0.5, 1.0), 1e-12);
    let (white, _) = colour(json!({ "rgb": [1, 1, 1] }), 1.0);
    assert_near(white, DVec3::new(0.3127, 0.3290, 1.0 - 0.3127 - 0.3290) / 0.3290, 1e-12);
    assert!(xyz.y < white.y);
}

/// Law: a radiance of 1e9 W sr⁻¹ m⁻³ at every wavelength stays even at every shift, times D⁵.
#[test]
fn an_even_spectrum_grows_by_the_fifth_power() {
    let (at_rest, _) = colour(json!({ "sampled": [[500, 1e9]] }), 1.0);
    // Expected luminance: 683 lm/W times 106.857 nm, the integral of ȳ.
    assert_close(at_rest.y, 683.0 * 106.857, 1e-5);
    let (ahead, _) = colour(json!({ "sampled": [[300, 1e9], [900, 1e9]] }), 2.0);
    assert!(ahead.distance(32.0 * at_rest) < 1e-12 * ahead.length(), "{ahead}");
}

#[test]
fn extreme_celerities_give_finite_answers_everywhere() {
    for celerity in [1e-300, 1e-12, 1e12, 1e20] {
        for question in [
            json!({ "ask": "boost", "celerity": [celerity, celerity, 0], "event": [1, 2, 3, 4] }),
            json!({ "ask": "compose", "vehicle": [celerity, 0, 0], "head": [-celerity, celerity, 0] }),
            json!({
                "ask": "apparent", "observer": { "position": [0, 0, 0], "celerity": [0, celerity, 0] },
                "source": { "position": [1, 2, 3], "celerity": [0, celerity, 1] },
            }),
            json!({
                "ask": "eyes", "observer": { "position": [0, 0, 0], "celerity": [0, 0, celerity] },
                "separation": 0.065, "right": [1, 0, 0],
            }),
            json!({
                "ask": "perceived", "eyes": [[0, 0, 0], [0.065, 0, 0]],
                "source": { "position": [1, 2, 3], "celerity": [0, celerity, 0] }, "time": 1,
            }),
            json!({
                "ask": "worldline", "start": { "position": [0, 0, 0], "celerity": [celerity, 0, 0] },
                "legs": [{ "duration": 1, "acceleration": [-1, 1, 0] }], "step": 0.01,
            }),
        ] {
            // The helper `ask` fails the test on any error, including a number that is not finite.
            let answer = ask(question);
            assert!(answer.is_object(), "{answer}");
        }
    }
}
