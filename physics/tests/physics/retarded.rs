//! Law: light that arrives now left its source on the observer's past light cone. For uniform, hyperbolic and circular
//! motion the event is known by other means: in closed form, or by plain bisection.
//!
//! A wrong program shows a source where it is now, or where uniform motion would have had it.

use std::cell::Cell;

use exact_reference::random::seeded;
use physics::glam::DVec3;
use physics::retarded::{NotSeen, Worldline, retarded};
use physics::{Beta, Celerity, Event, Observer, PointSource, apparent};
use rand::RngExt;

/// Error of a position or time as a share of the distance of the event.
const TOLERANCE: f64 = 1e-9;
/// Number of looks at a worldline that a search may take: as many as bisecting an f64 to its last bit would.
const LOOKS: usize = 64;

/// A worldline that counts how often it is asked.
struct Counted<W>(W, Cell<usize>);

impl<W: Fn(f64) -> (DVec3, DVec3)> Worldline for Counted<W> {
    fn at(&self, ct: f64) -> (DVec3, DVec3) {
        self.1.set(self.1.get() + 1);
        (self.0)(ct)
    }
}

fn counted<W: Fn(f64) -> (DVec3, DVec3)>(worldline: W) -> Counted<W> {
    Counted(worldline, Cell::new(0))
}

/// Hyperbolic motion: constant proper acceleration along x from rest at the origin at ct = 0, x = (√(1 + a²t²) − 1)/a.
fn hyperbolic(a: f64) -> impl Fn(f64) -> (DVec3, DVec3) {
    move |ct| {
        let root = (1.0 + (a * ct).powi(2)).sqrt();
        (DVec3::X * (a * ct * ct / (1.0 + root)), DVec3::X * (a * ct / root))
    }
}

/// Circular motion round the z axis.
fn circular(radius: f64, rate: f64) -> impl Fn(f64) -> (DVec3, DVec3) {
    move |ct| {
        let (sine, cosine) = (rate * ct).sin_cos();
        (DVec3::new(cosine, sine, 0.0) * radius, DVec3::new(-sine, cosine, 0.0) * (radius * rate))
    }
}

#[test]
fn hyperbolic_motion_is_seen_where_its_closed_form_crosses_the_light_cone() {
    // Light cone and hyperbola meet, to the right of the source, where x − t = X − T =: k; and (x + 1/a)² − t² = 1/a²
    // makes (k + 1/a) (k + 1/a + 2t) = 1/a².
    let mut seen_at_all = 0;
    for a in [1e-6, 0.1, 1.0, 50.0] {
        for (right, time) in [(3.0, 1.0), (100.0, 40.0), (1e4, 2e4), (5.0, -20.0), (7.0, 7.01)] {
            let sum = right - time + 1.0 / a;
            let exact = 0.5 * (1.0 / (a * a * sum) - sum);
            let (place, _) = hyperbolic(a)(exact);
            // Skip observers beyond the horizon, and those that the source has passed: its light comes from the other
            // side.
            if sum <= 0.0 || place.x > right {
                continue;
            }
            seen_at_all += 1;
            let worldline = counted(hyperbolic(a));
            let seen = retarded(Event { ct: time, position: DVec3::X * right }, &worldline).unwrap();
            let scale = (time - exact).abs().max(1.0);
            assert!((seen.ct - exact).abs() < TOLERANCE * scale, "a {a}: {} instead of {exact}", seen.ct);
            assert!(seen.position.distance(place) < TOLERANCE * scale, "a {a}: {} not {place}", seen.position);
            assert!(worldline.1.get() < LOOKS, "{} looks", worldline.1.get());
        }
    }
    assert!(seen_at_all > 9, "{seen_at_all}");
}

#[test]
fn a_circling_source_is_seen_where_bisection_finds_it() {
    let mut random = seeded(3);
    for _ in 0..2000 {
        let radius = random.random_range(0.1..20.0);
        let speed: f64 = 1.0 - 10.0_f64.powf(random.random_range(-4.0..0.0));
        let motion = circular(radius, speed / radius);
        let position = DVec3::from_array([0, 1, 2].map(|_| random.random_range(-60.0..60.0)));
        let observer = Event { ct: random.random_range(-50.0..50.0), position };
        // The light cone is crossed once, and certainly within the distance of the far side.
        let (mut early, mut late) = (observer.ct - position.length() - radius - 1.0, observer.ct);
        for _ in 0..200 {
            let middle = 0.5 * (early + late);
            let inside = observer.ct - middle >= motion(middle).0.distance(position);
            *(if inside { &mut early } else { &mut late }) = middle;
        }
        let worldline = counted(&motion);
        let seen = retarded(observer, &worldline).unwrap();
        assert!(seen.position.distance(motion(early).0) < TOLERANCE, "{} {early}", seen.ct);
        assert!(worldline.1.get() < LOOKS, "{} looks at {speed} c", worldline.1.get());
    }
}

#[test]
fn from_the_middle_of_its_circle_a_source_is_seen_a_radius_late() {
    let seen = retarded(Event { ct: 5.0, position: DVec3::ZERO }, &counted(circular(2.0, 0.45))).unwrap();
    assert!((seen.ct - 3.0).abs() < 1e-14);
    assert!((seen.position - 2.0 * DVec3::new(1.35_f64.cos(), 1.35_f64.sin(), 0.0)).length() < 1e-14);
}

#[test]
fn uniform_motion_is_seen_as_apparent_moving_has_it() {
    let mut random = seeded(4);
    for _ in 0..2000 {
        let mut vector = |size: f64| DVec3::from_array([0, 1, 2].map(|_| size * random.random_range(-1.0..1.0)));
        let (position, beta, place, ct) = (vector(50.0), vector(0.57), vector(50.0), vector(50.0).x);
        let celerity = Beta::new(beta).unwrap().celerity();
        let event = Event { ct, position: place };
        let seen = retarded(event, &counted(|ct| (position + beta * ct, beta))).unwrap();
        let exact =
            apparent::moving(&Observer { event, celerity: Celerity::ZERO }, &PointSource { position, celerity });
        let scale = TOLERANCE * exact.position.length().max(1.0);
        assert!((seen.position - place - exact.position).length() < scale);
        assert!((seen.ct - exact.emitted_at).abs() < scale);
    }
}

#[test]
fn what_is_faster_than_light_is_refused_and_what_touches_the_eye_is_seen_at_once() {
    let fast = retarded(Event { ct: 0.0, position: DVec3::Y }, &counted(|ct| (DVec3::X * 1.5 * ct, DVec3::X * 1.5)));
    assert!(matches!(fast, Err(NotSeen::FasterThanLight { speed: 1.5, .. })));
    let here = retarded(Event { ct: 2.0, position: DVec3::X }, &counted(|_| (DVec3::X, DVec3::ZERO))).unwrap();
    assert_eq!(here.ct, 2.0);
    let nowhere = retarded(Event::default(), &counted(|_| (DVec3::splat(f64::NAN), DVec3::ZERO)));
    assert!(matches!(nowhere, Err(NotSeen::Never { .. })));
    // This source is nearly as fast as its own light, and the velocity given is the opposite one.
    let speed = DVec3::X * 0.999_999;
    let lying = retarded(Event::default(), &counted(|ct| (DVec3::X * 10.0 - speed * ct, speed)));
    assert!(matches!(lying, Err(NotSeen::NotConverged { .. })), "{lying:?}");
}
