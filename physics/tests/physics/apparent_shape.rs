//! Law: the shape of the photo-surface is the derivative of the apparent position. Its derivative and its normals are
//! those of finite differences, its determinant is D, and the figures of Weiskopf's section 5.1.5 have the lengths that
//! follow from the equation in closed form.
//!
//! A wrong program draws spheres shortened instead of stretched, bends edges along the motion, or lights surfaces from
//! the wrong side.

use exact_reference::random::{seeded, vector};
use physics::glam::DVec3;
use physics::{Aberration, Beta, Celerity, Event, Observer, apparent, apparent_shape};

use super::support::celerity;

/// Accuracy of the derivatives, which is that of the differences.
const DIFFERENCES: f64 = 1e-8;

/// Accuracy of the figures' lengths, which are given to four decimals.
const LENGTH: f64 = 5e-5;

fn seen(celerity: Celerity, place: DVec3) -> DVec3 {
    apparent::at_rest(&Observer { event: Event::default(), celerity }, place).position
}

/// Derivative of the apparent position along a step, by central differences of the fourth order.
fn difference(celerity: Celerity, place: DVec3, step: DVec3) -> DVec3 {
    let at = |share: f64| seen(celerity, place + step * share);
    const STEP: f64 = 1e-3;
    (8.0 * (at(STEP) - at(-STEP)) - (at(2.0 * STEP) - at(-2.0 * STEP))) / (12.0 * STEP)
}

#[test]
fn derivative_and_normals_are_those_of_finite_differences() {
    let mut random = seeded(17);
    for _ in 0..2000 {
        let celerity = celerity(&mut random, -2.0..0.8);
        let place = vector(&mut random, -1.0..1.0);
        let jacobian = apparent_shape::jacobian(celerity, place);
        let scale = celerity.kappa();
        // Steps are shares of the distance.
        let size = place.length();
        for axis in DVec3::AXES {
            let exact = jacobian * axis;
            let off = exact.distance(difference(celerity, place, axis * size) / size);
            assert!(off < DIFFERENCES * scale, "{celerity:?} {place} {axis}: {off}");
        }
        let (_, doppler) = Aberration::new(celerity).observer_from_world(place);
        assert!((jacobian.determinant() / doppler - 1.0).abs() < 1e-12 * scale * scale, "{celerity:?} {place}");

        // The normal is across both tangents, and on the side of their cross product.
        let one = vector(&mut random, 0.0..0.1).normalize();
        let other = one.any_orthonormal_vector();
        let normal = apparent_shape::normal(celerity, place, one.cross(other));
        let [a, b] = [one, other].map(|step| difference(celerity, place, step * size) / size);
        assert!((normal.length() - 1.0).abs() < 1e-14);
        assert!(normal.distance(a.cross(b).normalize()) < DIFFERENCES * scale * scale, "{celerity:?} {place}");
    }
}

/// Extent along the motion of a sphere of radius 1 about a place, by its outermost points.
fn extent(celerity: Celerity, centre: DVec3) -> f64 {
    let along = celerity.direction().unwrap();
    let across = (centre - along * along.dot(centre)).try_normalize().unwrap_or(along.any_orthonormal_vector());
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    const STEPS: u32 = 200_000;
    for step in 0..STEPS {
        let (sine, cosine) = (std::f64::consts::TAU * f64::from(step) / f64::from(STEPS)).sin_cos();
        // The outermost points lie in the plane through eye, motion and centre, by symmetry.
        let at = seen(celerity, centre + along * cosine + across * sine).dot(along);
        (low, high) = (low.min(at), high.max(at));
    }
    high - low
}

#[test]
fn spheres_at_0_95_c_are_as_long_as_in_the_figures() {
    let celerity = Beta::new(DVec3::NEG_Z * 0.95).unwrap().celerity();
    assert!((celerity.gamma() - 3.2026).abs() < LENGTH && (celerity.kappa() - 6.2450).abs() < LENGTH);
    for (centre, length) in [
        (DVec3::NEG_Z * 5.0, 12.4900),
        (DVec3::ZERO, 6.4051),
        (DVec3::Z * 1.5, 1.2337),
        (DVec3::Z * 3.0, 0.7059),
        (DVec3::X * 2.5, 8.7395),
    ] {
        let extent = extent(celerity, centre);
        assert!((extent - length).abs() < LENGTH, "centred at {centre}: {extent}, not {length}");
    }
}

#[test]
fn at_0_9_c_what_is_abeam_is_seen_at_25_84_degrees_and_astern_d_is_0_2294() {
    let celerity = Beta::new(DVec3::NEG_Z * 0.9).unwrap().celerity();
    let aberration = Aberration::new(celerity);
    let (abeam, _) = aberration.observer_from_world(DVec3::X);
    assert!((abeam.angle_between(DVec3::NEG_Z).to_degrees() - 25.84).abs() < 5e-3);
    assert!((aberration.observer_from_world(DVec3::Z).1 - 0.2294).abs() < LENGTH);
}

#[test]
fn edges_along_the_motion_are_straight_and_edges_across_it_are_hyperbolae() {
    let celerity = Beta::new(DVec3::X * 0.95).unwrap().celerity();
    let (w, gamma) = (celerity.magnitude(), celerity.gamma());
    for step in -20..=20 {
        let shift = 0.25 * f64::from(step);
        // Along the motion, the two coordinates across it stay as they are.
        let along = seen(celerity, DVec3::new(shift, 1.0, 0.5));
        assert!(DVec3::new(0.0, along.y, along.z).distance(DVec3::new(0.0, 1.0, 0.5)) < 1e-14);
        // Across it, (x' − γ h)² / w² − y² is the squared distance of the edge from the axis, and of its plane.
        let across = seen(celerity, DVec3::new(2.0, shift, 0.5));
        let hyperbola = ((across.x - 2.0 * gamma) / w).powi(2) - across.y.powi(2);
        assert!((hyperbola - (4.0 + 0.25)).abs() < 1e-12, "{hyperbola} at {shift}");
    }
}
