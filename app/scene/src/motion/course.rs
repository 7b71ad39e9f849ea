//! An animated body as one observer sees it: each of its points at its own retarded event.
//!
//! That event is on the observer's past light cone, as those of what rests are; so it appears where a point at rest would that was there, and only its
//! Doppler factor knows of its own motion.

use std::sync::Arc;

use glam::DVec3;
use physics::bend::Bend;
use physics::retarded::retarded;
use physics::{Aberration, Beta, Celerity, Event, Observer};

use super::animated::{Animated, Pose};

/// An animated body, and who sees it.
#[derive(Clone, Debug)]
pub struct Course {
    animated: Arc<Animated>,
    observer: Observer,
    bend: Bend,
    aberration: Aberration,
}

/// A point of an animated body as it is seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seen {
    /// When and where in the world the light left.
    pub event: Event,
    /// Apparent position: relative to the observer, his axes, metres.
    pub apparent: DVec3,
    /// ν_observed / ν_sent.
    pub doppler: f64,
}

impl Course {
    /// Of one observer.
    pub fn new(animated: &Arc<Animated>, observer: &Observer) -> Self {
        Self {
            animated: Arc::clone(animated),
            observer: *observer,
            bend: Bend::new(observer.celerity),
            aberration: Aberration::new(observer.celerity),
        }
    }

    /// A point of the body, in the body's own frame. `None` where its worldline does not cross the past light cone, as one faster than light
    /// may not.
    ///
    /// *Equation:* D = D_observer / D_source, each γ + u·n with n in the world towards the source.
    ///
    /// *Accuracy:* 1e-9, and far better (tests/tests/animated.rs).
    pub fn seen(&self, place: DVec3) -> Option<Seen> {
        let found = retarded(self.observer.event, &self.animated.point(place)).ok()?;
        let towards = found.position - self.observer.event.position;
        let apparent = self.bend.apparent(towards);
        let sent = Beta::new(found.beta).ok()?.celerity();
        let doppler =
            self.aberration.observer_from_world(towards).1 / Aberration::new(sent).observer_from_world(towards).1;
        let event = Event { ct: found.ct, position: found.position };
        (apparent.is_finite() && doppler > 0.0).then_some(Seen { event, apparent, doppler })
    }

    /// Who sees it.
    pub fn observer(&self) -> &Observer {
        &self.observer
    }
}

impl Animated {
    /// How the body is when its middle is seen, or, without light's delay, at the observer's time.
    pub fn as_seen(&self, observer: &Observer, delayed: bool) -> Pose {
        let seen = if delayed { retarded(observer.event, &self.point(self.ball.centre)).ok() } else { None };
        self.at(seen.map_or(observer.event.ct, |seen| seen.ct))
    }

    /// How its middle moves in such a pose.
    pub fn celerity(&self, pose: &Pose) -> Celerity {
        Beta::new(pose.beta(self.ball.centre)).map(Beta::celerity).unwrap_or_default()
    }
}
