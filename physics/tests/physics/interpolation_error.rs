//! Law: no place of a flat triangle is drawn further from where its light says than the bound of its longest edge, and
//! none is seen outside the bound's cone. A wrong program would show places beside dead astern beyond the bound, if it
//! took F at the ball's middle only; and places ahead or astern outside the cone, if it took a cone about the middle's
//! own direction.

use exact_reference::random::{direction, seeded, vector};
use glam::DVec3;
use physics::interpolation_error::TriangleInterpolation;
use physics::{Celerity, Event, Observer, apparent};
use rand::RngExt;

/// Share that rounding may add to either side of a bound, and to a cone in radians.
const ROUNDING: f64 = 1e-7;

/// Angle between two vectors of any length, radians.
fn angle(a: DVec3, b: DVec3) -> f64 {
    let (a, b) = (a.normalize(), b.normalize());
    a.cross(b).length().atan2(a.dot(b))
}

/// Largest F, times the loss if a place is drawn nearer than it appears.
fn bend_of_rounding(rapidity: f64) -> f64 {
    8.0 * (2.0 * rapidity).exp()
}

#[test]
fn no_place_of_a_triangle_errs_by_more_than_its_longest_edge_says() {
    let mut random = seeded(5);
    let (mut claimed, mut tight, mut astern) = (0, 0.0_f64, 0);
    for _ in 0..60_000 {
        let (motion, rapidity) = (direction(&mut random), random.random_range(0.0..14.5_f64));
        let celerity = Celerity::new(motion * rapidity.sinh()).unwrap();
        let interpolation = TriangleInterpolation::new(celerity);
        // Put the triangle anywhere, or as near to astern as that is enlarged.
        let near = random.random_range(0..2) == 0;
        let scale = if near { (2.0 - rapidity).min(0.0).exp() } else { 1.0 };
        let middle = if near { -motion + 2.0 * scale * direction(&mut random) } else { direction(&mut random) };
        let size = scale * 10.0_f64.powf(random.random_range(-3.0..0.3));
        let corners = [0, 1, 2].map(|_| middle + size * direction(&mut random));
        let [a, b, c] = corners;
        let edges = [(a, b), (b, c), (c, a)];
        let (from, to) = edges.into_iter().max_by(|x, y| x.0.distance(x.1).total_cmp(&y.0.distance(y.1))).unwrap();
        let bound = interpolation.bound(0.5 * (from + to), from.distance(to));
        let anywhere = interpolation.bound_anywhere((0.5 * (from + to)).length(), from.distance(to));
        assert!(bound.error_rad <= anywhere * (1.0 + ROUNDING), "{} > {anywhere}", bound.error_rad);
        let observer = Observer { event: Event::default(), celerity };
        for _ in 0..6 {
            let (i, j): (f64, f64) = (random.random_range(0.0..1.0), random.random_range(0.0..1.0));
            let [i, j] = if i + j > 1.0 { [1.0 - i, 1.0 - j] } else { [i, j] };
            let shares = [1.0 - i - j, i, j];
            let place: DVec3 = corners.into_iter().zip(shares).map(|(corner, share)| corner * share).sum();
            let apparent = |at| apparent::at_rest(&observer, at).position;
            let drawn: DVec3 = corners.into_iter().zip(shares).map(|(corner, share)| apparent(corner) * share).sum();
            let seen = apparent(place).normalize();
            let error = angle(seen, drawn);
            if bound.error_rad.is_finite() {
                claimed += 1;
                astern += usize::from(near && rapidity > 7.0);
                assert!(
                    error <= bound.error_rad * (1.0 + ROUNDING) + ROUNDING,
                    "{error} > {} at rapidity {rapidity}",
                    bound.error_rad
                );
                tight = tight.max(error / (bound.error_rad + ROUNDING));
            }
            let aside = angle(seen, bound.cone.axis);
            assert!(
                aside <= bound.cone.radius_rad + 1e-6,
                "{aside} > {} at rapidity {rapidity}",
                bound.cone.radius_rad
            );
            let said = interpolation
                .error(place, corners.into_iter().zip(shares).map(|(at, share)| at.length() * share).sum());
            // The lengthening δ is the last digits of a distance at the highest speeds.
            let lost = 1e-15 * bend_of_rounding(rapidity);
            assert!((said - error).abs() < 1e-3 * error + lost, "{said} is not {error} at rapidity {rapidity}");
        }
    }
    println!("{claimed} bounds, {astern} of them astern, the tightest reached to {tight:.3}");
    assert!(claimed > 100_000 && astern > 10_000 && tight > 0.5, "{claimed} bounds, {astern} astern, {tight} reached");
}

#[test]
fn from_outside_too_no_place_of_a_triangle_errs_by_more_than_is_said() {
    let mut random = seeded(23);
    let (mut claimed, mut tight) = (0, 0.0_f64);
    for round in 0..40_000 {
        let celerity = super::support::celerity(&mut random, -1.0..1.2);
        let observer = Observer { event: Event::default(), celerity };
        let interpolation = TriangleInterpolation::new(celerity);
        let middle = vector(&mut random, -0.5..0.7);
        let size = middle.length() * 10.0_f64.powf(random.random_range(-2.5..-0.3));
        let corners = [0; 3].map(|_| middle + size * vector(&mut random, -0.3..0.0));
        let camera = if round % 3 == 0 { DVec3::ZERO } else { vector(&mut random, -0.5..1.2) };
        let edges = [(0, 1), (1, 2), (2, 0)].map(|(a, b): (usize, usize)| (corners[a], corners[b]));
        let (from, to) = edges.into_iter().max_by(|x, y| x.0.distance(x.1).total_cmp(&y.0.distance(y.1))).unwrap();
        let bound = interpolation.bound_from(camera, 0.5 * (from + to), from.distance(to));
        for (i, j) in [(0.33, 0.33), (0.5, 0.5), (0.5, 0.0), (0.1, 0.45)] {
            let shares = [1.0 - i - j, i, j];
            let place: DVec3 = corners.into_iter().zip(shares).map(|(corner, share)| corner * share).sum();
            let apparent = |at| apparent::at_rest(&observer, at).position;
            let drawn: DVec3 = corners.into_iter().zip(shares).map(|(corner, share)| apparent(corner) * share).sum();
            let (seen, drawn) = (apparent(place) - camera, drawn - camera);
            if bound.error_rad.is_finite() {
                let error = angle(seen, drawn);
                claimed += 1;
                assert!(error <= bound.error_rad * (1.0 + ROUNDING) + ROUNDING, "{error} > {}", bound.error_rad);
                tight = tight.max(error / (bound.error_rad + ROUNDING));
                assert!(angle(seen, bound.cone.axis) <= bound.cone.radius_rad + 1e-6);
            }
        }
    }
    assert!(claimed > 40_000 && tight > 0.1, "{claimed} bounds, the tightest reached to {tight:.3}");
    let at_rest = TriangleInterpolation::new(Celerity::ZERO);
    assert_eq!(at_rest.bound_from(DVec3::X, DVec3::X, 1.0).error_rad, 0.0);
}

#[test]
fn at_rest_nothing_bends() {
    let interpolation = TriangleInterpolation::new(Celerity::ZERO);
    assert_eq!(interpolation.bound(DVec3::X, 0.1).error_rad, 0.0);
    assert_eq!(interpolation.bound(DVec3::X, 100.0).error_rad, 0.0);
}

#[test]
fn around_a_moving_observer_nothing_is_claimed() {
    let interpolation = TriangleInterpolation::new(Celerity::new(DVec3::X).unwrap());
    assert_eq!(interpolation.bound(DVec3::ZERO, 1e-6).error_rad, f64::INFINITY);
    assert_eq!(interpolation.bound(DVec3::Y, 2.0).error_rad, f64::INFINITY);
}
