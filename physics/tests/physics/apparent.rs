//! Law: an observer sees the events on the past light cone. A wrong program would take a source where it is instead of
//! where it was, swap red for blue, or lose the companion that flies along.

use exact_reference::random::{direction, seeded, size, vector};
use physics::glam::DVec3;
use physics::{Aberration, Boost, Celerity, Event, FourVector, Observer, PointSource, apparent};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use crate::support::{EPSILON, celerity, relative_difference};

fn observer(celerity: DVec3) -> Observer {
    Observer { event: Event::default(), celerity: Celerity::new(celerity).unwrap() }
}

#[test]
fn straight_ahead_and_astern_keep_their_direction_at_every_speed() {
    /// Error of the κ written here: 1e-9 at u = 1e-9.
    const TOLERANCE: f64 = 2e-9;
    for (u, kappa) in [(0.75, 2.0), (0.0, 1.0), (1e-9, 1.0), (1e6, 2e6), (1e12, 2e12)] {
        let aberration = Aberration::new(Celerity::new(DVec3::new(0.0, 0.0, -u)).unwrap());
        let (ahead, blue) = aberration.observer_from_world(DVec3::NEG_Z);
        let (astern, red) = aberration.observer_from_world(DVec3::Z);
        assert_eq!((ahead, astern), (DVec3::NEG_Z, DVec3::Z));
        assert!((blue / kappa - 1.0).abs() < TOLERANCE && (red * kappa - 1.0).abs() < TOLERANCE, "{u}");
    }
}

#[test]
fn abeam_is_seen_at_the_arc_cosine_of_beta() {
    let aberration = Aberration::new(Celerity::new(DVec3::new(0.75, 0.0, 0.0)).unwrap());
    assert_eq!(aberration.observer_from_world(DVec3::Y), (DVec3::new(0.6, 0.8, 0.0), 1.25));
    // Light seen abeam comes from behind in the world, and is redshifted by γ.
    assert_eq!(aberration.world_from_observer(DVec3::Y), (DVec3::new(-0.6, 0.8, 0.0), 0.8));
}

#[test]
fn aberration_back_gives_the_direction() {
    /// There and back at D down to 1/2γ: each way rounds the direction once, the way back stretches it by up to 2γ.
    const TOLERANCE: f64 = 4.0 * EPSILON;
    let mut random = seeded(31);
    for _ in 0..2000 {
        let u = celerity(&mut random, -8.0..12.0);
        let aberration = Aberration::new(u);
        let n = direction(&mut random);
        let (seen, d) = aberration.observer_from_world(n);
        let (back, d_back) = aberration.world_from_observer(seen);
        let stretch = d.max(1.0);
        assert!(back.distance(n) < TOLERANCE * stretch, "{u:?} {n}");
        assert!((d_back / d - 1.0).abs() < TOLERANCE * stretch * stretch.max(2.0), "{u:?} {n}");
        assert!((seen.length() - 1.0).abs() < TOLERANCE);
    }
}

#[test]
fn direction_needs_no_length_but_must_have_one() {
    let aberration = Aberration::new(Celerity::new(DVec3::new(3.0, 4.0, 0.0)).unwrap());
    let n = DVec3::new(1.0, 2.0, -3.0);
    let (seen, doppler) = aberration.observer_from_world(n);
    for scale in [1e-300, 1e-3, 1e3, 1e300] {
        let (again, same) = aberration.observer_from_world(n * scale);
        assert!(again.distance(seen) < 4.0 * EPSILON && (same - doppler).abs() < 8.0 * EPSILON * doppler);
    }
    let (none, gamma) = aberration.observer_from_world(DVec3::ZERO);
    assert_eq!(none, DVec3::ZERO);
    assert!((gamma - 26.0_f64.sqrt()).abs() < 8.0 * EPSILON);
}

#[test]
fn observer_at_rest_sees_the_world_as_it_is() {
    let seen = apparent::at_rest(&observer(DVec3::ZERO), DVec3::new(0.1, 0.2, -0.3));
    assert_eq!(seen.position, DVec3::new(0.1, 0.2, -0.3));
    assert_eq!(seen.doppler, 1.0);
}

#[test]
fn point_ahead_recedes_and_point_astern_comes_near() {
    let ahead = apparent::at_rest(&observer(DVec3::new(0.75, 0.0, 0.0)), DVec3::new(4.0, 0.0, 0.0));
    assert_eq!((ahead.position, ahead.doppler, ahead.emitted_at), (DVec3::new(8.0, 0.0, 0.0), 2.0, -4.0));
    let astern = apparent::at_rest(&observer(DVec3::new(0.75, 0.0, 0.0)), DVec3::new(-4.0, 0.0, 0.0));
    assert_eq!((astern.position, astern.doppler, astern.emitted_at), (DVec3::new(-2.0, 0.0, 0.0), 0.5, -4.0));
}

#[test]
fn approaching_source_is_seen_where_it_was() {
    // A source at β = 0.6 towards an observer at rest, 4 m away now: light left it at −10 m, 10 m away. D = 2.
    let source = PointSource {
        position: DVec3::new(4.0, 0.0, 0.0),
        celerity: Celerity::new(DVec3::new(-0.75, 0.0, 0.0)).unwrap(),
    };
    let seen = apparent::moving(&observer(DVec3::ZERO), &source);
    assert!(seen.position.distance(DVec3::new(10.0, 0.0, 0.0)) < 1e-14);
    assert!((seen.doppler - 2.0).abs() < 1e-15 && (seen.emitted_at + 10.0).abs() < 1e-14);
}

#[test]
fn companion_looks_as_at_rest() {
    // A source that shares the observer's motion keeps its place in the observer's frame, and its colour, at every γ.
    let mut random = seeded(32);
    for _ in 0..500 {
        let u = celerity(&mut random, -3.0..12.0);
        // Abeam, where both frames agree on the place to the last bit that f64 positions have.
        let abeam = direction(&mut random).cross(u.vector()).normalize() * size(&mut random, -3.0..3.0);
        let seen = apparent::moving(
            &Observer { event: Event::default(), celerity: u },
            &PointSource { position: abeam, celerity: u },
        );
        // Rounding of `abeam` along the motion is stretched by γ.
        let tolerance = 8.0 * EPSILON * u.gamma();
        assert!(relative_difference(seen.position, abeam) < tolerance, "{u:?}");
        assert!((seen.doppler - 1.0).abs() < 8.0 * EPSILON, "{u:?} {seen:?}");
    }
}

#[test]
fn source_at_the_eye_is_seen_there() {
    let u = Celerity::new(DVec3::new(0.75, 0.0, 0.0)).unwrap();
    let observer = Observer { event: Event { ct: 7.0, position: DVec3::ONE }, celerity: u };
    let seen = apparent::at_rest(&observer, DVec3::ONE);
    assert_eq!((seen.position, seen.emitted_at, seen.doppler), (DVec3::ZERO, 7.0, 1.25));
    let here = PointSource { position: DVec3::ONE, celerity: Celerity::ZERO };
    assert_eq!(apparent::moving(&observer, &here), seen);
}

/// A random observer and source, γ to about 30.
fn pair(random: &mut ChaCha8Rng) -> (Observer, PointSource) {
    let observer = Observer {
        event: Event { ct: random.random_range(-10.0..10.0), position: vector(random, -1.0..1.0) },
        celerity: celerity(random, -2.0..1.5),
    };
    (observer, PointSource { position: vector(random, -1.0..1.0), celerity: celerity(random, -2.0..1.5) })
}

#[test]
fn moving_source_is_where_bisection_finds_it() {
    /// Rounding of places of 10 m, with γ³ of 30 in the bisected root.
    const TOLERANCE: f64 = 1e-9;
    let mut random = seeded(33);
    for _ in 0..500 {
        let (observer, source) = pair(&mut random);
        let beta = source.celerity.beta().vector();
        let displacement = |time: f64| source.position + beta * time - observer.event.position;
        // The light-cone equation, by bisection in the world's frame.
        let (mut early, mut late) = (observer.event.ct - 1e6, observer.event.ct);
        for _ in 0..200 {
            let middle = 0.5 * (early + late);
            let light_is_late = displacement(middle).length() > observer.event.ct - middle;
            if light_is_late { late = middle } else { early = middle }
        }
        let d = displacement(early);
        let light = FourVector { t: early - observer.event.ct, r: d };
        let expected = Boost::observer_from_world(observer.celerity).apply(light).r;
        let n = d.normalize();
        let factor = |u: Celerity| u.gamma() + u.vector().dot(n);

        let seen = apparent::moving(&observer, &source);
        assert!((seen.emitted_at - early).abs() < TOLERANCE * light.t.abs(), "{observer:?} {source:?}");
        assert!(relative_difference(seen.position, expected) < TOLERANCE, "{observer:?} {source:?}");
        let doppler = factor(observer.celerity) / factor(source.celerity);
        assert!((seen.doppler / doppler - 1.0).abs() < TOLERANCE, "{observer:?} {source:?}");
    }
}

#[test]
fn doppler_factor_is_the_rate_at_which_the_source_is_seen_to_age() {
    /// The error of a centred difference over a thousandth of the distance.
    const TOLERANCE: f64 = 1e-3;
    let mut random = seeded(34);
    for _ in 0..500 {
        let (observer, source) = pair(&mut random);
        let seen = apparent::moving(&observer, &source);
        let step = 1e-4 * seen.position.length().min(observer.event.ct - seen.emitted_at) / source.celerity.gamma();
        let [before, after] = [-step, step].map(|tau| {
            let own = FourVector { t: observer.celerity.gamma() * tau, r: observer.celerity.vector() * tau };
            let event = observer.event + own;
            apparent::moving(&Observer { event, ..observer }, &source).emitted_at / source.celerity.gamma()
        });
        let rate = (after - before) / (2.0 * step);
        assert!((seen.doppler / rate - 1.0).abs() < TOLERANCE, "{observer:?} {source:?} {rate} {}", seen.doppler);
    }
}

#[test]
fn source_at_rest_is_the_slowest_moving_one() {
    let mut random = seeded(35);
    for _ in 0..500 {
        let (observer, source) = pair(&mut random);
        let resting = PointSource { celerity: Celerity::ZERO, ..source };
        let (moving, at_rest) = (apparent::moving(&observer, &resting), apparent::at_rest(&observer, source.position));
        assert_eq!(moving.position, at_rest.position);
        assert_eq!(moving.doppler, at_rest.doppler);
        assert!((moving.emitted_at - at_rest.emitted_at).abs() < 8.0 * EPSILON * (10.0 + at_rest.emitted_at.abs()));
    }
}
