//! Law: an event simultaneous for an observer has, boosted into the observer's frame, the observer's own time. For
//! uniform motion it is where the textbook's straight line says, for hyperbolic and circular motion the boosted time is
//! zero.
//!
//! A wrong program takes the world's present, the retarded event, or runs away from the root at high speed.

use std::cell::Cell;

use exact_reference::random::{seeded, vector};
use physics::glam::DVec3;
use physics::retarded::Worldline;
use physics::simultaneous::{NotPresent, simultaneous};
use physics::{Beta, Celerity, Event, FourVector, Observer};
use rand::RngExt;

/// Number of looks at a worldline that a search may take: as many as bisecting an f64 to its last bit would.
const LOOKS: usize = 64;

/// Time in the observer's frame that counts as none, as a share of the distance times γ.
const TOLERANCE: f64 = 1e-13;

struct Counted<W>(W, Cell<usize>);

impl<W: Fn(f64) -> (DVec3, DVec3)> Worldline for Counted<W> {
    fn at(&self, ct: f64) -> (DVec3, DVec3) {
        self.1.set(self.1.get() + 1);
        (self.0)(ct)
    }
}

fn assert_present(observer: &Observer, worldline: impl Fn(f64) -> (DVec3, DVec3)) {
    let counted = Counted(&worldline, Cell::new(0));
    let found = simultaneous(observer, &counted).unwrap();
    assert_eq!(worldline(found.ct), (found.position, found.beta));
    let apart = Event { ct: found.ct, position: found.position } - observer.event;
    let boosted = observer.observer_from_world().apply(apart);
    let scale = observer.celerity.gamma() * (1.0 + apart.r.length() + found.ct.abs() + observer.event.ct.abs());
    assert!(boosted.t.abs() < TOLERANCE * scale, "{observer:?}: {boosted:?} at {found:?}");
    assert!(counted.1.get() <= LOOKS, "{} looks for {observer:?}", counted.1.get());
}

#[test]
fn an_event_of_any_worldline_has_the_observers_own_time() {
    let mut random = seeded(11);
    for _ in 0..2000 {
        let event = Event { ct: random.random_range(-50.0..50.0), position: vector(&mut random, -1.0..2.0) };
        let observer = Observer { event, celerity: Celerity::new(vector(&mut random, -2.0..2.0)).unwrap() };
        let (start, beta) = (vector(&mut random, -1.0..2.0), vector(&mut random, -2.0..2.0));
        let beta = Celerity::new(beta).unwrap().beta().vector();
        assert_present(&observer, |ct| (start + beta * ct, beta));
        let a = 10.0_f64.powf(random.random_range(-3.0..1.0));
        assert_present(&observer, |ct| {
            let root = (1.0 + (a * ct).powi(2)).sqrt();
            (DVec3::X * (a * ct * ct / (1.0 + root)), DVec3::X * (a * ct / root))
        });
        let (radius, rate) = (5.0, random.random_range(0.0..0.19));
        assert_present(&observer, |ct| {
            let (sine, cosine) = (rate * ct).sin_cos();
            (DVec3::new(cosine, sine, 0.0) * radius, DVec3::new(-sine, cosine, 0.0) * (radius * rate))
        });
    }
}

#[test]
fn a_thing_at_rest_ahead_is_met_later_by_the_world_clock() {
    // At β = 0.6 the present leads by 0.6 m of time for every metre ahead.
    let celerity = Beta::new(DVec3::X * 0.6).unwrap().celerity();
    let observer = Observer { event: Event { ct: 2.0, position: DVec3::ZERO }, celerity };
    let at_rest = Counted(|_| (DVec3::X * 10.0, DVec3::ZERO), Cell::new(0));
    let found = simultaneous(&observer, &at_rest).unwrap();
    assert!((found.ct - 8.0).abs() < 1e-14, "{found:?}");
    let boosted = observer.observer_from_world().apply(FourVector { t: 6.0, r: DVec3::X * 10.0 });
    assert!(boosted.r.distance(DVec3::X * 8.0) < 1e-14);
}

#[test]
fn what_is_no_worldline_is_told() {
    let celerity = Beta::new(DVec3::X * 0.6).unwrap().celerity();
    let observer = Observer { event: Event::default(), celerity };
    let fast = Counted(|ct| (DVec3::X * (1.0 + 2.0 * ct), DVec3::X * 2.0), Cell::new(0));
    assert!(matches!(simultaneous(&observer, &fast), Err(NotPresent::FasterThanLight { speed: 2.0, .. })));
    let nowhere = Counted(|_| (DVec3::NAN, DVec3::ZERO), Cell::new(0));
    assert!(matches!(simultaneous(&observer, &nowhere), Err(NotPresent::Never { .. })));
}
