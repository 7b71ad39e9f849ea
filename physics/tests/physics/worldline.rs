//! Law: rapidity adds up proper acceleration, gyroscopes precess by Thomas' angle, and each integrator is as exact as
//! it says. A wrong program would reach the speed of light, turn the gyroscope the other way, lose the mass shell, or
//! drift while coasting.

use std::f64::consts::TAU;

use exact_reference::random::{direction, orientation, seeded, size, vector};
use physics::glam::{DQuat, DVec3};
use physics::worldline::{
    Control, DormandPrince, Exact, FacingMotion, Integrator, Rk4, Thrust, Transport, WorldlineError, WorldlineState,
    travel,
};
use physics::{Boost, Celerity, Event, FourVector, Observer};

use crate::support::{EPSILON, celerity, relative_difference};

fn integrators() -> [(&'static str, Box<dyn Integrator>); 3] {
    [("rk4", Box::new(Rk4)), ("exact", Box::new(Exact)), ("dopri5", Box::new(DormandPrince::new(1e-10).unwrap()))]
}

fn push(acceleration: DVec3) -> Thrust {
    Thrust { acceleration, turn_rate: DVec3::ZERO }
}

/// Rapidity reached from rest at 10 units of acceleration for one of proper time, less 10.
fn rapidity_error(integrator: &dyn Integrator, rate: f64) -> f64 {
    let end =
        travel(integrator, &WorldlineState::default(), 1.0, 1.0 / rate, &push(DVec3::new(6.0, 0.0, 8.0))).unwrap();
    (end.celerity.rapidity() - 10.0).abs()
}

#[test]
fn hyperbolic_motion_reaches_the_tabled_accuracy() {
    // (ah)⁵/120 a step, h = 1/60 and 1/240: 6.4e-5 and 2.5e-7 in all.
    assert!(rapidity_error(&Rk4, 60.0) < 7e-5);
    assert!(rapidity_error(&Rk4, 240.0) < 3e-7);
    assert!(rapidity_error(&Exact, 60.0) < 3e-14);
    assert!(rapidity_error(&DormandPrince::default(), 60.0) < 2e-7);
    assert!(rapidity_error(&DormandPrince::new(1e-12).unwrap(), 60.0) < 1e-10);
}

#[test]
fn rk4_is_of_fourth_order() {
    let ratio = rapidity_error(&Rk4, 120.0) / rapidity_error(&Rk4, 240.0);
    assert!((14.0..18.0).contains(&ratio), "{ratio}");
}

#[test]
fn hyperbolic_motion_keeps_clocks_and_way() {
    // x = (cosh aτ − 1)/a, ct = sinh(aτ)/a.
    for (name, integrator) in integrators() {
        let end = travel(&*integrator, &WorldlineState::default(), 2.0, 1.0 / 240.0, &push(DVec3::new(0.0, 1.5, 0.0)))
            .unwrap();
        let expected = DVec3::new(0.0, (3.0_f64.cosh() - 1.0) / 1.5, 0.0);
        assert!(relative_difference(end.position, expected) < 1e-10, "{name}");
        assert!((end.ct / (3.0_f64.sinh() / 1.5) - 1.0).abs() < 1e-10, "{name}");
        assert!((end.proper_time - 2.0).abs() < 4.0 * EPSILON, "{name}");
        assert_eq!(end.orientation, DQuat::IDENTITY, "{name}");
    }
}

/// A circle of celerity `w` with lateral acceleration `a`, the nose on the motion: start, constant controls, and the
/// state after `tau`.
fn circle(w: f64, a: f64, tau: f64) -> (WorldlineState, Thrust, WorldlineState) {
    let gamma = (1.0 + w * w).sqrt();
    let start =
        WorldlineState::new(Event::default(), Celerity::new(DVec3::new(0.0, 0.0, -w)).unwrap(), DQuat::IDENTITY);
    // A force to the right: forward −z × right x = −y.
    let thrust = Thrust { acceleration: DVec3::new(a, 0.0, 0.0), turn_rate: DVec3::new(0.0, -gamma * a / w, 0.0) };
    let (angle, radius) = (tau * a / w, w * w / a);
    let (sine, cosine) = angle.sin_cos();
    let mut end = WorldlineState::new(
        Event { ct: gamma * tau, position: radius * DVec3::new(2.0 * (angle / 2.0).sin().powi(2), 0.0, -sine) },
        Celerity::new(w * DVec3::new(sine, 0.0, -cosine)).unwrap(),
        DQuat::from_rotation_y(-angle),
    );
    end.proper_time = tau;
    (start, thrust, end)
}

/// The rotation between two orientations, radians, without the square root of rounding that an arc cosine would make of
/// it.
fn turn_between(a: DQuat, b: DQuat) -> f64 {
    2.0 * (a.inverse() * b).xyz().length()
}

#[test]
fn circle_at_gamma_1000_reaches_the_tabled_accuracy() {
    let (start, thrust, expected) = circle(1e3, 10.0, 1.0);
    let turned = |integrator: &dyn Integrator, rate: f64| {
        let end = travel(integrator, &start, 1.0, 1.0 / rate, &thrust).unwrap();
        let way = relative_difference(end.position, expected.position);
        let error = turn_between(end.orientation, expected.orientation);
        (error, way)
    };
    // Turn and precession almost cancel, so that a fixed order is enough.
    let tried: [(&dyn Integrator, f64); 4] =
        [(&Rk4, 60.0), (&Rk4, 240.0), (&Exact, 60.0), (&DormandPrince::default(), 60.0)];
    for (integrator, rate) in tried {
        let (orientation, way) = turned(integrator, rate);
        assert!(orientation < 8e-14 && way < 8e-14, "{rate} {orientation:e} {way:e}");
    }
}

#[test]
fn circle_at_gamma_1000_is_the_same_in_long_and_short_steps() {
    // An orientation rounded to f64 at each step drifts apart by 1e-9 in ten turns: γ² = 1e6 times rounding.
    const TOLERANCE: f64 = 1e-14;
    const WAY: f64 = 60_000.0;
    let (start, thrust, _) = circle(1e3, 1.0, 0.0);
    let long = travel(&Exact, &start, WAY, 16.0, &thrust).unwrap();
    let short = travel(&Exact, &start, WAY, 0.5, &thrust).unwrap();
    assert!(relative_difference(short.celerity.vector(), long.celerity.vector()) < TOLERANCE, "{short:?} {long:?}");
    assert!(turn_between(short.orientation, long.orientation) < TOLERANCE);
    assert!(short.position.distance(long.position) < TOLERANCE * long.ct);
}

#[test]
fn ship_stopped_from_outside_rests_exactly() {
    let thrust = Thrust { acceleration: DVec3::new(0.3, 0.1, -0.7), turn_rate: DVec3::new(0.1, 0.5, 0.0) };
    let mut state = travel(&Exact, &WorldlineState::default(), 1.0, 1.0 / 240.0, &thrust).unwrap();
    state.celerity = Celerity::ZERO;
    for integrator in [&Exact as &dyn Integrator, &Rk4] {
        let end = travel(integrator, &state, 10.0, 1.0 / 240.0, &Thrust::default()).unwrap();
        assert_eq!((end.position, end.celerity), (state.position, state.celerity));
        assert_eq!(end.orientation, state.orientation);
    }
}

#[test]
fn gyroscope_on_a_circle_at_gamma_1000_reaches_the_tabled_accuracy() {
    // This is the circle above with gyroscopic axes: now the thrust turns, once every 0.6 of proper time, and Thomas
    // precession is all the rotation.
    let (start, turning, expected) = circle(1e3, 10.0, 1.0);
    let rate = turning.turn_rate.y;
    let thrust = |state: &WorldlineState| push(DQuat::from_rotation_y(rate * state.proper_time) * turning.acceleration);
    let expected = expected.orientation * DQuat::from_rotation_y(-rate);
    // The exact step takes the control at its middle: second order.
    let limits: [(&dyn Integrator, f64, f64); 4] =
        [(&Rk4, 60.0, 3e-6), (&Rk4, 240.0, 1e-8), (&Exact, 60.0, 0.02), (&DormandPrince::default(), 60.0, 1e-9)];
    for (integrator, rate, most) in limits {
        let end = travel(integrator, &start, 1.0, 1.0 / rate, &thrust).unwrap();
        let error = turn_between(end.orientation, expected);
        assert!(error < most, "{rate} {error:e}");
    }
}

#[test]
fn whole_circle_comes_back() {
    const TOLERANCE: f64 = 1e-6;
    for w in [0.75, 10.0] {
        let (start, thrust, _) = circle(w, 1.0, 0.0);
        for (name, integrator) in integrators() {
            let end = travel(&*integrator, &start, TAU * w, 1.0 / 240.0, &thrust).unwrap();
            assert!(end.position.length() < TOLERANCE * w * w, "{name} {w} {end:?}");
            assert!(relative_difference(end.celerity.vector(), start.celerity.vector()) < TOLERANCE, "{name} {w}");
            assert!(turn_between(end.orientation, start.orientation) < TOLERANCE, "{name} {w}");
        }
    }
}

#[test]
fn gyroscope_precesses_by_thomas_angle_on_a_circle() {
    // γ = 1.25: 2π(γ − 1) = 90° against the sense of the motion, which here is right-handed about −y.
    let start =
        WorldlineState::new(Event::default(), Celerity::new(DVec3::new(0.0, 0.0, -0.75)).unwrap(), DQuat::IDENTITY);
    let inward =
        |state: &WorldlineState| Thrust::in_boost_axes(state, state.celerity.direction().unwrap().cross(DVec3::Y));
    for (name, integrator) in integrators() {
        let end = travel(&*integrator, &start, TAU * 0.75, 1.0 / 960.0, &inward).unwrap();
        let error = turn_between(end.orientation, DQuat::from_rotation_y(TAU * 0.25));
        assert!(error < 1e-5, "{name} {error:e}");
        assert!(relative_difference(end.celerity.vector(), start.celerity.vector()) < 1e-5, "{name}");
    }
}

#[test]
fn integrators_agree_on_random_controls() {
    let mut random = seeded(11);
    for _ in 0..20 {
        let start = WorldlineState::new(
            Event { ct: 1.0, position: vector(&mut random, 0.0..2.0) },
            celerity(&mut random, -2.0..2.0),
            orientation(&mut random),
        );
        let thrust = Thrust { acceleration: vector(&mut random, -1.0..0.3), turn_rate: vector(&mut random, -1.0..0.3) };
        let [rk4, exact, dopri5] =
            integrators().map(|(_, integrator)| travel(&*integrator, &start, 1.0, 1.0 / 960.0, &thrust).unwrap());
        for other in [rk4, dopri5] {
            let gamma = exact.celerity.gamma();
            assert!(other.celerity.vector().distance(exact.celerity.vector()) < 1e-9 * gamma);
            assert!(other.position.distance(exact.position) < 1e-9 * exact.ct);
            assert!((other.ct - exact.ct).abs() < 1e-9 * exact.ct);
            assert!(turn_between(other.orientation, exact.orientation) < 1e-9);
        }
    }
}

#[test]
fn backwards_undoes_forwards() {
    let mut random = seeded(12);
    for _ in 0..20 {
        let start = WorldlineState::new(Event::default(), celerity(&mut random, -2.0..1.0), orientation(&mut random));
        let thrust = Thrust { acceleration: direction(&mut random), turn_rate: direction(&mut random) };
        for (name, integrator) in integrators() {
            let there = integrator.step(&start, 0.05, &thrust).unwrap();
            let back = integrator.step(&there, -0.05, &thrust).unwrap();
            assert!(back.celerity.vector().distance(start.celerity.vector()) < 1e-6, "{name}");
            assert!(back.position.length() < 1e-6 && back.ct.abs() < 1e-6, "{name}");
        }
    }
}

#[test]
fn reversed_thrust_brings_the_ship_to_rest() {
    // There and back leaves ε γ_max of celerity, γ_max = cosh 10.
    let mut state = WorldlineState::default();
    for acceleration in [10.0, -10.0] {
        state = travel(&Exact, &state, 1.0, 1.0 / 60.0, &push(DVec3::new(0.0, 0.0, acceleration))).unwrap();
    }
    assert!(state.celerity.magnitude() < 8.0 * EPSILON * 10.0_f64.cosh(), "{state:?}");
}

#[test]
fn coasting_is_one_step_or_a_million() {
    // Each sum of a third loses half a unit in the last place, always to the same side: 1e6 of them 1e-10 of the way.
    const TOLERANCE: f64 = 4.0 * EPSILON;
    let start = WorldlineState::new(
        Event { ct: 0.1, position: DVec3::new(0.7, -0.3, 0.1) },
        Celerity::new(DVec3::new(1e3, 2.0, 1e-3)).unwrap(),
        DQuat::from_rotation_y(0.3),
    );
    let (steps, step) = (1_000_000, 1.0 / 300.0);
    for integrator in [&Rk4 as &dyn Integrator, &Exact] {
        let mut end = start;
        for _ in 0..steps {
            end = integrator.step(&end, step, &Thrust::default()).unwrap();
        }
        let way = f64::from(steps) * step;
        assert_eq!(end.celerity, start.celerity);
        assert_eq!(end.orientation, start.orientation);
        assert!((end.proper_time / way - 1.0).abs() < TOLERANCE);
        assert!(((end.ct - 0.1) / (way * start.celerity.gamma()) - 1.0).abs() < TOLERANCE);
        let expected = start.position + way * start.celerity.vector();
        assert!(relative_difference(end.position, expected) < TOLERANCE);
    }
}

#[test]
fn any_finite_input_ends_in_a_finite_state_or_an_error() {
    let mut random = seeded(13);
    let (mut taken, mut refused) = (0, 0);
    for _ in 0..300 {
        let start = WorldlineState::new(
            Event { ct: 0.0, position: vector(&mut random, -6.0..9.0) },
            celerity(&mut random, -8.0..70.0),
            orientation(&mut random),
        );
        let thrust =
            Thrust { acceleration: vector(&mut random, -12.0..12.0), turn_rate: vector(&mut random, -12.0..4.0) };
        let step = size(&mut random, -6.0..1.0);
        for (name, integrator) in integrators() {
            match integrator.step(&start, step, &thrust) {
                Ok(end) => {
                    taken += 1;
                    let finite = end.position.is_finite() && end.ct.is_finite() && end.orientation.is_finite();
                    assert!(finite && end.celerity.vector().is_finite(), "{name} {start:?} {thrust:?} {step}");
                    assert!((end.orientation.length() - 1.0).abs() < 8.0 * EPSILON, "{name}");
                }
                Err(WorldlineError::Overflow { .. } | WorldlineError::NotConverged { .. }) => refused += 1,
                Err(error) => panic!("{name}: {error}"),
            }
        }
    }
    assert!(taken > 300 && refused > 30, "{taken} {refused}");
}

#[test]
fn bad_input_is_refused() {
    let start = WorldlineState::default();
    for (name, integrator) in integrators() {
        for bad in [f64::NAN, f64::INFINITY] {
            let step = integrator.step(&start, bad, &Thrust::default());
            assert!(matches!(step, Err(WorldlineError::StepNotFinite { .. })), "{name}");
            let thrust = integrator.step(&start, 0.1, &push(DVec3::new(0.0, bad, 0.0)));
            assert!(matches!(thrust, Err(WorldlineError::ThrustNotFinite { .. })), "{name}");
        }
        let overflow = integrator.step(&start, 1.0, &push(DVec3::X * 1e300));
        assert!(matches!(overflow, Err(WorldlineError::Overflow { .. })), "{name} {overflow:?}");
    }
    for tolerance in [0.0, -1.0, f64::NAN, 1e-20, 2.0] {
        assert!(matches!(DormandPrince::new(tolerance), Err(WorldlineError::Tolerance { .. })));
    }
    for (duration, step) in [(-1.0, 0.1), (1.0, 0.0), (1.0, -0.1), (f64::NAN, 0.1), (1.0, f64::INFINITY)] {
        let error = travel(&Rk4, &start, duration, step, &Thrust::default()).unwrap_err();
        assert!(matches!(error, WorldlineError::Duration { .. }));
    }
    let error = travel(&Rk4, &start, 1.0, 1e-12, &Thrust::default()).unwrap_err();
    assert!(matches!(error, WorldlineError::TooManySteps { .. }));
}

#[test]
fn adaptive_integrator_says_when_it_does_not_converge() {
    // An acceleration that depends on the last bits of the state has no solution to converge to.
    let noise = |state: &WorldlineState| {
        let bits = (state.ct.to_bits() ^ state.position.x.to_bits()).wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 11;
        push(DVec3::X * 1e6 * (bits as f64 / (1_u64 << 53) as f64 - 0.5))
    };
    let error = DormandPrince::new(1e-12).unwrap().step(&WorldlineState::default(), 1.0, &noise).unwrap_err();
    assert!(matches!(error, WorldlineError::NotConverged { .. }), "{error}");
}

#[test]
fn journey_takes_whole_steps() {
    struct Counter(std::cell::Cell<u32>);
    impl Integrator for Counter {
        fn step(
            &self,
            state: &WorldlineState,
            step: f64,
            control: &dyn Control,
        ) -> Result<WorldlineState, WorldlineError> {
            self.0.set(self.0.get() + 1);
            Rk4.step(state, step, control)
        }
    }
    for (duration, step, expected) in
        [(0.0, 0.1, 0), (0.3, 0.1, 3), (1.0, 1.0 / 240.0, 240), (1.0, 0.3, 4), (0.1, 5.0, 1)]
    {
        let counter = Counter(std::cell::Cell::new(0));
        let end = travel(&counter, &WorldlineState::default(), duration, step, &Thrust::default()).unwrap();
        assert_eq!(counter.0.get(), expected);
        assert!((end.proper_time - duration).abs() <= EPSILON);
    }
}

fn facing() -> FacingMotion {
    FacingMotion { softening: 0.05, alignment: 5.0 }
}

/// The sine of the angle between the nose and the line of motion.
fn misalignment(state: &WorldlineState) -> f64 {
    let nose = state.orientation * DVec3::NEG_Z;
    state.celerity.direction().map_or(0.0, |motion| nose.cross(motion).length())
}

#[test]
fn nose_stays_on_the_motion_through_a_curve() {
    for (w, duration) in [(1.0, 3.0), (1e3, 3.0), (1e9, 3.0)] {
        let (start, _, _) = circle(w, 1.0, 0.0);
        let curve = |state: &WorldlineState| Transport::FacingMotion(facing()).thrust(state, DVec3::new(1.0, 0.3, 0.0));
        for (name, integrator) in integrators() {
            let end = travel(&*integrator, &start, duration, 1.0 / 240.0, &curve).unwrap();
            assert!(misalignment(&end) < 1e-3, "{name} {w} {}", misalignment(&end));
        }
    }
}

#[test]
fn facing_the_motion_turns_as_the_circle_does() {
    let (start, thrust, _) = circle(1e3, 10.0, 0.0);
    let turn = FacingMotion { softening: 1e-6, alignment: 0.0 }.turn_rate(&start, thrust.acceleration);
    assert!(relative_difference(turn, thrust.turn_rate) < 4.0 * EPSILON);
}

#[test]
fn nose_is_smooth_through_rest_and_in_reverse() {
    // Forward, a stop, reverse, a curve in reverse: nothing turns while the motion is straight, and the nose stays
    // opposed to it after.
    let transport = Transport::FacingMotion(facing());
    let mut state =
        WorldlineState::new(Event::default(), Celerity::new(DVec3::new(0.0, 0.0, -1.0)).unwrap(), DQuat::IDENTITY);
    let backwards = |state: &WorldlineState| transport.thrust(state, DVec3::Z);
    state = travel(&Rk4, &state, 2.0, 1.0 / 240.0, &backwards).unwrap();
    assert!(turn_between(state.orientation, DQuat::IDENTITY) < 1e-12);
    assert!(state.celerity.vector().z > 0.5);
    let curve = |state: &WorldlineState| transport.thrust(state, DVec3::new(0.5, 0.0, 0.0));
    state = travel(&Rk4, &state, 2.0, 1.0 / 240.0, &curve).unwrap();
    assert!((state.orientation * DVec3::NEG_Z).dot(state.celerity.direction().unwrap()) < -0.999);
}

#[test]
fn turn_rate_is_bounded_at_every_speed_and_zero_at_rest() {
    let mut random = seeded(14);
    let facing = facing();
    let rest = WorldlineState::new(Event::default(), Celerity::ZERO, orientation(&mut random));
    assert_eq!(facing.turn_rate(&rest, DVec3::X).length(), 0.0);
    for _ in 0..1000 {
        let state = WorldlineState::new(Event::default(), celerity(&mut random, -12.0..12.0), orientation(&mut random));
        let acceleration = direction(&mut random);
        // γ w / (w² + s²) ≤ 1/(2s) + 1.
        let most = 0.5 / facing.softening + 1.0 + 0.5 * facing.alignment;
        assert!(facing.turn_rate(&state, acceleration).length() <= most, "{state:?}");
    }
}

#[test]
fn left_over_angle_decays_when_speed_returns() {
    let transport = Transport::FacingMotion(facing());
    for (angle, reversed) in [(0.5, false), (2.6, true)] {
        let start =
            WorldlineState::new(Event::default(), Celerity::new(DVec3::NEG_Z).unwrap(), DQuat::from_rotation_y(angle));
        let end =
            travel(&Rk4, &start, 4.0, 1.0 / 240.0, &|state: &WorldlineState| transport.thrust(state, DVec3::ZERO))
                .unwrap();
        assert!(misalignment(&end) < 1e-6);
        assert_eq!((end.orientation * DVec3::NEG_Z).z > 0.0, reversed);
        assert_eq!(end.celerity, start.celerity);
    }
}

#[test]
fn thrust_reversed_at_every_leap_keeps_the_ship_at_hand() {
    // Bang-bang control in leaps of 1e-6 to 10: each pair of equal opposite leaps ends at rest.
    let mut random = seeded(16);
    for (name, integrator) in [("exact", &Exact as &dyn Integrator), ("dopri5", &DormandPrince::default())] {
        let mut state = WorldlineState::default();
        for _ in 0..200 {
            let (leap, acceleration) = (size(&mut random, -6.0..1.0), direction(&mut random));
            for sign in [1.0, -1.0] {
                state = integrator.step(&state, leap, &push(sign * acceleration)).unwrap();
            }
        }
        assert!(state.celerity.magnitude() < 1e-3, "{name} {state:?}");
    }
}

#[test]
fn head_aboard_has_the_tetrad_of_both_boosts() {
    /// A few roundings at the size that the two boosts stretch to.
    const TOLERANCE: f64 = 32.0 * EPSILON;
    let mut random = seeded(17);
    for _ in 0..500 {
        let event = Event { ct: 3.0, position: vector(&mut random, 0.0..1.0) };
        let vehicle = WorldlineState::new(event, celerity(&mut random, -2.0..2.0), orientation(&mut random));
        let head = celerity(&mut random, -2.0..1.0);
        let aboard = vehicle.aboard(DVec3::ZERO, head, &Thrust::default());
        assert_eq!(aboard.event(), event);
        let input = FourVector { t: 1.0, r: direction(&mut random) };
        let world_from = |state: &WorldlineState, vector: FourVector| {
            let turned = FourVector { t: vector.t, r: state.orientation * vector.r };
            state.observer().observer_from_world().inverse().apply(turned)
        };
        let in_vehicle = Boost::observer_from_world(head).inverse().apply(input);
        let difference = world_from(&aboard, input) - world_from(&vehicle, in_vehicle);
        let scale = 4.0 * vehicle.celerity.gamma() * head.gamma();
        assert!(difference.r.length() + difference.t.abs() < TOLERANCE * scale, "{vehicle:?} {head:?}");
    }
}

#[test]
fn head_ahead_in_the_vehicle_is_further_on_and_later_in_the_world() {
    let quarter = std::f64::consts::FRAC_PI_2;
    let celerity = Celerity::new(DVec3::new(-0.75, 0.0, 0.0)).unwrap();
    // The nose, −z, turned onto the motion, −x.
    let vehicle = WorldlineState::new(Event::default(), celerity, DQuat::from_rotation_y(quarter));
    let head = vehicle.aboard(DVec3::new(0.0, 0.0, -4.0), Celerity::ZERO, &Thrust::default());
    assert!(head.position.distance(DVec3::new(-5.0, 0.0, 0.0)) < 8.0 * EPSILON);
    assert!((head.ct - 3.0).abs() < 8.0 * EPSILON);
    assert_eq!((head.celerity, head.orientation), (vehicle.celerity, vehicle.orientation));
}

#[test]
fn eye_at_rest_aboard_is_at_the_bits_that_recordings_were_made_with() {
    // Old recordings are verified to the bit, so the order of operations is part of the interface.
    let mut random = seeded(18);
    for _ in 0..500 {
        let event = Event { ct: size(&mut random, -3.0..6.0), position: vector(&mut random, -3.0..6.0) };
        let vehicle = WorldlineState::new(event, celerity(&mut random, -6.0..6.0), orientation(&mut random));
        let place = vector(&mut random, -2.0..1.0);
        let world_from_vehicle = vehicle.observer().observer_from_world().inverse();
        let displacement = world_from_vehicle.apply(FourVector { t: 0.0, r: vehicle.orientation * place });
        let expected = Observer { event: event + displacement, celerity: vehicle.celerity };
        assert_eq!(vehicle.observer_at(place), expected);
        let aboard = vehicle.aboard(place, Celerity::ZERO, &Thrust::default());
        assert_eq!((aboard.observer(), aboard.orientation), (expected, vehicle.orientation));
    }
}

#[test]
fn gyroscopic_transport_asks_for_no_turn() {
    let mut random = seeded(15);
    let state = WorldlineState::new(Event::default(), celerity(&mut random, 0.0..3.0), orientation(&mut random));
    assert_eq!(Transport::Gyroscopic.thrust(&state, DVec3::X).turn_rate, DVec3::ZERO);
}
