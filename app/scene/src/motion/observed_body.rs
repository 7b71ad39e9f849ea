//! Animated body as one observer sees it: each of its points at its own retarded event.
//!
//! The retarded event lies on the observer's past light cone, like those of resting points. The point therefore
//! appears where a resting point at that event would appear. Only its Doppler factor depends on its own motion.

use std::sync::Arc;

use glam::DVec3;
use physics::interpolation_error::TriangleInterpolation;
use physics::retarded::retarded;
use physics::{Aberration, Beta, Celerity, Event, Observer};

use super::animated::{Animated, Pose};

/// Animated body together with the observer that sees it.
#[derive(Clone, Debug)]
pub struct ObservedBody {
    animated: Arc<Animated>,
    observer: Observer,
    bend: TriangleInterpolation,
    aberration: Aberration,
}

/// Point of an animated body as the observer sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SeenPoint {
    /// Retarded event: the event in the world at which the light left the point.
    pub event: Event,
    /// Apparent position relative to the observer, observer's axes, metres.
    pub apparent: DVec3,
    /// Doppler factor, ν_observed / ν_sent.
    pub doppler: f64,
}

impl ObservedBody {
    /// Pairs an animated body with one observer.
    pub fn new(animated: &Arc<Animated>, observer: &Observer) -> Self {
        Self {
            animated: Arc::clone(animated),
            observer: *observer,
            bend: TriangleInterpolation::new(observer.celerity),
            aberration: Aberration::new(observer.celerity),
        }
    }

    /// Apparent position and Doppler factor of a point given in the body's own frame. `None` if its worldline does
    /// not cross the past light cone, which can happen to one faster than light.
    ///
    /// *Equation:* D = D_observer / D_source, each γ + u·n with n in the world towards the source.
    ///
    /// *Accuracy:* 1e-9, and far better (tests/tests/system/animated.rs).
    pub fn seen(&self, place: DVec3) -> Option<SeenPoint> {
        let found = retarded(self.observer.event, &self.animated.point(place)).ok()?;
        let towards = found.position - self.observer.event.position;
        let apparent = self.bend.apparent(towards);
        let sent = Beta::new(found.beta).ok()?.celerity();
        let doppler =
            self.aberration.observer_from_world(towards).1 / Aberration::new(sent).observer_from_world(towards).1;
        let event = Event { ct: found.ct, position: found.position };
        (apparent.is_finite() && doppler > 0.0).then_some(SeenPoint { event, apparent, doppler })
    }

    /// Observer that sees the body.
    pub fn observer(&self) -> &Observer {
        &self.observer
    }
}

impl Animated {
    /// Pose of the body when its middle is seen (`delayed`), or at the observer's time.
    pub fn as_seen(&self, observer: &Observer, delayed: bool) -> Pose {
        let seen = if delayed { retarded(observer.event, &self.point(self.ball.centre)).ok() } else { None };
        self.at(seen.map_or(observer.event.ct, |seen| seen.ct))
    }

    /// Celerity of the body's middle in such a pose.
    pub fn celerity(&self, pose: &Pose) -> Celerity {
        Beta::new(pose.beta(self.ball.centre)).map(Beta::celerity).unwrap_or_default()
    }
}
