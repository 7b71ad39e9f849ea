//! Law: what rests in a frame is, at a moving observer's present, contracted along the motion by 1/γ and not moved
//! across it. The place is that of the boosted event whose time there is zero.
//!
//! A wrong program contracts by γ twice, stretches, takes the world's present, or loses the contraction at high γ.

use exact_reference::random::{seeded, vector};
use physics::glam::DVec3;
use physics::{Boost, Celerity, Contraction, FourVector};

use super::support::{EPSILON, celerity, relative_difference};

#[test]
fn a_unit_cube_at_0_6_c_measures_0_8_along_the_motion() {
    let contraction = Contraction::new(Celerity::new(DVec3::NEG_Z * 0.75).unwrap());
    for corner in 0..8 {
        let at = DVec3::from_array([0, 1, 2].map(|axis| f64::from(corner >> axis & 1)));
        let measured = contraction.observer_from_world(at);
        assert!(measured.distance(at * DVec3::new(1.0, 1.0, 0.8)) < 1e-15, "{at} at {measured}");
    }
    assert_eq!(Contraction::new(Celerity::ZERO).observer_from_world(DVec3::ONE), DVec3::ONE);
}

#[test]
fn a_measured_place_is_the_boosted_event_at_time_zero() {
    let mut random = seeded(5);
    for _ in 0..2000 {
        let celerity = celerity(&mut random, -3.0..3.0);
        let d = vector(&mut random, -2.0..3.0);
        let contraction = Contraction::new(celerity);
        let place = contraction.observer_from_world(d);
        // The worldline of the resting thing crosses the observer's present at this time.
        let t = contraction.world_time(place);
        let boosted = Boost::observer_from_world(celerity).apply(FourVector { t, r: d });
        // The boost enlarges the rounding of both of its inputs by γ.
        let scale = d.length() * celerity.gamma().powi(2);
        assert!(boosted.t.abs() < 8.0 * EPSILON * scale, "{celerity:?} {d}: {}", boosted.t);
        assert!(boosted.r.distance(place) < 8.0 * EPSILON * scale, "{celerity:?} {d}: {} {place}", boosted.r);
        let back = contraction.world_from_observer(place);
        assert!(relative_difference(back, d) < 8.0 * EPSILON * celerity.gamma(), "{celerity:?} {d} {back}");
        assert!((contraction.matrix() * d).distance(place) < 8.0 * EPSILON * d.length());
    }
}

#[test]
fn slow_motion_contracts_by_half_its_square() {
    // 1 − 1/γ of |u| = 1e-9 is 5e-19, which a difference of numbers near 1 does not hold.
    let contraction = Contraction::new(Celerity::new(DVec3::X * 1e-9).unwrap());
    let shorter = contraction.matrix() - physics::glam::DMat3::IDENTITY;
    assert!(shorter.x_axis.x.abs() <= EPSILON);
    // At γ of 1e9 nothing is left of the length along the motion, and all of it across.
    let fast = Contraction::new(Celerity::new(DVec3::X * 1e9).unwrap());
    assert!(fast.observer_from_world(DVec3::new(1.0, 2.0, 3.0)).distance(DVec3::new(0.0, 2.0, 3.0)) < 2e-9);
}
