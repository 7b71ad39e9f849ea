//! Law: boosts keep the interval and compose to a boost and a rotation. A program with a wrong sign would age the
//! twin that stays, let null vectors leave the light cone, or turn the head's axes the wrong way round a curve.

use exact_reference::random::{direction, seeded, size, vector};
use physics::glam::{DQuat, DVec3};
use physics::{Beta, Boost, Celerity, CelerityError, Event, FourVector, compose};
use rand::RngExt;

use crate::support::{EPSILON, celerity, relative_difference};

/// β = 0.6 along −z.
fn three_fifths() -> Celerity {
    Celerity::new(DVec3::new(0.0, 0.0, -0.75)).unwrap()
}

#[test]
fn beta_three_fifths_is_celerity_three_quarters() {
    let beta = Beta::new(DVec3::new(0.0, 0.0, -0.6)).unwrap();
    assert_eq!(Celerity::from(beta), three_fifths());
    assert_eq!(three_fifths().gamma(), 1.25);
    assert_eq!(three_fifths().beta(), beta);
    assert_eq!(three_fifths().magnitude(), 0.75);
    assert!((three_fifths().rapidity() - 2.0_f64.ln()).abs() <= EPSILON);
    assert_eq!(three_fifths().direction(), Some(DVec3::NEG_Z));
    assert_eq!((-three_fifths()).vector(), DVec3::new(0.0, 0.0, 0.75));
}

#[test]
fn rest_has_no_direction() {
    assert_eq!(Celerity::ZERO.direction(), None);
    assert_eq!(Celerity::ZERO.gamma(), 1.0);
    assert_eq!(Celerity::ZERO.beta().vector(), DVec3::ZERO);
}

#[test]
fn velocities_that_are_none_are_refused() {
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let vector = DVec3::new(0.0, bad, 0.0);
        assert!(matches!(Celerity::new(vector), Err(CelerityError::NotFinite { .. })));
        assert!(matches!(Beta::new(vector), Err(CelerityError::NotFinite { .. })));
        assert!(matches!(Celerity::from_rapidity(vector, 1.0), Err(CelerityError::NoDirection { .. })));
        assert!(Celerity::from_rapidity(DVec3::X, bad).is_err());
    }
    for fast in [2.0 * Celerity::LIMIT, f64::MAX] {
        assert!(matches!(Celerity::new(DVec3::splat(fast)), Err(CelerityError::TooFast { .. })));
    }
    for fast in [1.0, 1.0 + EPSILON, 1e200, f64::MAX] {
        let error = Beta::new(DVec3::new(0.0, fast, 0.0)).unwrap_err();
        assert!(matches!(error, CelerityError::NotSlowerThanLight { .. }));
    }
    assert!(Celerity::from_rapidity(DVec3::ZERO, 1.0).is_err());
}

#[test]
fn beta_stays_below_one_at_every_celerity() {
    let mut random = seeded(1);
    for _ in 0..1000 {
        let beta = celerity(&mut random, -8.0..75.0).beta();
        assert!(Beta::new(beta.vector()).is_ok(), "{beta:?}");
    }
}

#[test]
fn rapidity_gives_back_the_celerity() {
    /// sinh multiplies the rounding of η by η.
    const TOLERANCE: f64 = 200.0 * EPSILON;
    let mut random = seeded(2);
    for _ in 0..1000 {
        let u = celerity(&mut random, -100.0..74.0);
        let back = Celerity::from_rapidity(u.vector(), u.rapidity()).unwrap();
        assert!(relative_difference(u.vector(), back.vector()) < TOLERANCE, "{u:?} {back:?}");
    }
}

#[test]
fn cap_cuts_only_what_is_above_it() {
    let fast = Celerity::from_rapidity(DVec3::new(1.0, 2.0, 2.0), 40.0).unwrap();
    let capped = fast.capped(27.0);
    assert!((capped.rapidity() - 27.0).abs() < 1e-14);
    assert_eq!(three_fifths().capped(27.0), three_fifths());
    assert!(relative_difference(capped.direction().unwrap(), fast.direction().unwrap()) < 4.0 * EPSILON);
}

#[test]
fn clock_that_stays_runs_slow_by_gamma() {
    let boost = Boost::observer_from_world(three_fifths());
    let tick = boost.apply(FourVector { t: 1.0, r: DVec3::ZERO });
    assert_eq!(tick, FourVector { t: 1.25, r: DVec3::new(0.0, 0.0, 0.75) });
}

#[test]
fn what_moves_along_comes_to_rest() {
    let boost = Boost::observer_from_world(three_fifths());
    let own = FourVector { t: 1.25, r: DVec3::new(0.0, 0.0, -0.75) };
    assert_eq!(boost.apply(own), FourVector { t: 1.0, r: DVec3::ZERO });
}

#[test]
fn light_ahead_doubles_and_light_astern_halves() {
    let boost = Boost::observer_from_world(three_fifths());
    for (z, factor) in [(-1.0, 2.0), (1.0, 0.5)] {
        let light = FourVector { t: -8.0, r: DVec3::new(0.0, 0.0, 8.0 * z) };
        let seen = boost.apply(light);
        assert_eq!(seen, FourVector { t: -8.0 * factor, r: DVec3::new(0.0, 0.0, 8.0 * z * factor) });
    }
}

#[test]
fn no_boost_at_rest_changes_no_bit() {
    let displacement = FourVector { t: 0.1, r: DVec3::new(0.2, 0.3, 0.7) };
    assert_eq!(Boost::observer_from_world(Celerity::ZERO).apply(displacement), displacement);
}

#[test]
fn slow_boost_is_galilean() {
    let slow = Celerity::new(DVec3::new(1e-20, 0.0, 0.0)).unwrap();
    let seen = Boost::observer_from_world(slow).apply(FourVector { t: 1.0, r: DVec3::ZERO });
    assert_eq!(seen, FourVector { t: 1.0, r: DVec3::new(-1e-20, 0.0, 0.0) });
}

#[test]
fn interval_is_kept() {
    /// Each component of the result is rounded at its own size or that of the largest.
    const TOLERANCE: f64 = 16.0 * EPSILON;
    let mut random = seeded(3);
    for _ in 0..2000 {
        let boost = Boost::observer_from_world(celerity(&mut random, -8.0..12.0));
        let from = FourVector { t: size(&mut random, -3.0..3.0), r: vector(&mut random, -3.0..3.0) };
        let to = boost.apply(from);
        let scale = to.t * to.t + to.r.length_squared() + from.t * from.t;
        assert!((to.interval() - from.interval()).abs() <= TOLERANCE * scale);
    }
}

#[test]
fn null_vectors_stay_null() {
    const TOLERANCE: f64 = 16.0 * EPSILON;
    let mut random = seeded(4);
    for _ in 0..2000 {
        let boost = Boost::observer_from_world(celerity(&mut random, -8.0..7.0));
        let r = vector(&mut random, -3.0..3.0);
        let to = boost.apply(FourVector { t: -r.length(), r });
        // t and r of the input were rounded separately; the boost may multiply that by κ but no more.
        let scale = r.length() * to.t.abs().max(r.length());
        let kappa = boost.apply(FourVector { t: 1.0, r: DVec3::ZERO }).t * 2.0;
        assert!(to.interval().abs() <= TOLERANCE * scale * kappa);
    }
}

#[test]
fn inverse_gives_back_the_vector() {
    /// Forth and back each round at the size of the larger result.
    const TOLERANCE: f64 = 16.0 * EPSILON;
    let mut random = seeded(5);
    for _ in 0..2000 {
        let u = celerity(&mut random, -8.0..5.0);
        let boost = Boost::observer_from_world(u);
        let from = FourVector { t: random.random_range(-1.0..1.0), r: vector(&mut random, -1.0..0.0) };
        let back = boost.inverse().apply(boost.apply(from));
        let scale = (2.0 * u.gamma()).powi(2);
        assert!((back.t - from.t).abs() <= TOLERANCE * scale);
        assert!(back.r.distance(from.r) <= TOLERANCE * scale);
    }
}

#[test]
fn events_differ_by_four_vectors() {
    let start = Event { ct: 1.0, position: DVec3::X };
    let step = FourVector { t: 2.0, r: DVec3::Y };
    assert_eq!((start + step) - start, step);
    assert_eq!(step - step, FourVector::default());
    assert_eq!(step + -step, FourVector::default());
}

/// The defining identity B(head)·B(vehicle) = R(wigner)·B(celerity), both sides applied to the same four-vector.
fn sides(vehicle: Celerity, head: Celerity, input: FourVector) -> [FourVector; 2] {
    let [first, second] = [vehicle, head].map(Boost::observer_from_world);
    let composition = compose(vehicle, head);
    let single = Boost::observer_from_world(composition.celerity).apply(input);
    let turned = FourVector { t: single.t, r: composition.wigner * single.r };
    [second.apply(first.apply(input)), turned]
}

#[test]
fn two_boosts_are_one_boost_and_a_rotation() {
    /// A few roundings at the size that the two boosts stretch to.
    const TOLERANCE: f64 = 32.0 * EPSILON;
    let mut random = seeded(6);
    for _ in 0..2000 {
        let vehicle = celerity(&mut random, -4.0..3.0);
        let head = celerity(&mut random, -4.0..3.0);
        let input = FourVector { t: random.random_range(-1.0..1.0), r: direction(&mut random) };
        let [left, right] = sides(vehicle, head, input);
        let scale = 4.0 * vehicle.gamma() * head.gamma();
        assert!((left.t - right.t).abs() <= TOLERANCE * scale, "{vehicle:?} {head:?}");
        assert!(left.r.distance(right.r) <= TOLERANCE * scale, "{vehicle:?} {head:?}");
    }
}

#[test]
fn right_turn_at_three_fifths_turns_by_the_textbook_angle() {
    // cos ε for perpendicular boosts is (γ₁ + γ₂)/(1 + γ₁γ₂): here 2.5/2.5625 = 40/41.
    let vehicle = Celerity::new(DVec3::new(0.75, 0.0, 0.0)).unwrap();
    let head = Celerity::new(DVec3::new(0.0, 0.75, 0.0)).unwrap();
    let composition = compose(vehicle, head);
    assert_eq!(composition.celerity.vector(), DVec3::new(0.9375, 0.75, 0.0));
    let turned = composition.wigner * DVec3::X;
    assert!((turned.x - 40.0 / 41.0).abs() <= EPSILON);
    assert!((turned.y - 9.0 / 41.0).abs() <= EPSILON, "sense of the rotation");
}

#[test]
fn opposite_celerities_cancel_at_every_size() {
    let mut random = seeded(7);
    for _ in 0..500 {
        let u = celerity(&mut random, -8.0..74.0);
        let composition = compose(u, -u);
        assert!(composition.celerity.magnitude() <= EPSILON, "{u:?} {composition:?}");
        assert!(composition.wigner.angle_between(DQuat::IDENTITY) <= EPSILON);
    }
}

#[test]
fn rapidities_add_along_a_line() {
    const TOLERANCE: f64 = 64.0 * EPSILON;
    let mut random = seeded(8);
    for _ in 0..500 {
        // An axis of the coordinates, so that both celerities lie on one line to the last bit.
        let axis = DVec3::NEG_Z;
        let [first, second] = [(); 2].map(|()| random.random_range(-28.0..28.0_f64));
        let [u1, u2] = [first, second].map(|eta| Celerity::from_rapidity(axis, eta).unwrap());
        let together = compose(u1, u2).celerity;
        let expected = (first + second).abs();
        assert!((together.rapidity() - expected).abs() <= TOLERANCE * 28.0, "{first} {second}");
    }
}

#[test]
fn composition_of_slow_celerities_is_their_sum() {
    let [first, second] = [DVec3::X, DVec3::new(1.0, 1.0, 0.0)].map(|v| Celerity::new(v * 1e-20).unwrap());
    let sum = first.vector() + second.vector();
    assert!(relative_difference(compose(first, second).celerity.vector(), sum) < 4.0 * EPSILON);
    assert!(compose(first, -second).celerity.vector().distance(first.vector() - second.vector()) < 1e-35);
}
