//! Animated body as one observer sees it: each of its points at its own retarded event.
//!
//! The retarded event lies on the observer's past light cone, like those of resting points. The point therefore
//! appears where a resting point at that event would appear. Only its Doppler factor depends on its own motion.

use std::sync::Arc;

use glam::DVec3;
use physics::interpolation_error::TriangleInterpolation;
use physics::retarded::retarded;
use physics::simultaneous::simultaneous;
use physics::{Aberration, Beta, Celerity, Contraction, Event, Observer};
use view::Places;

use super::animated::{Animated, Pose};

/// Animated body together with the observer that sees it.
#[derive(Clone, Debug)]
pub struct ObservedBody {
    animated: Arc<Animated>,
    observer: Observer,
    bend: TriangleInterpolation,
    aberration: Aberration,
    contraction: Contraction,
}

/// Point of an animated body as the observer sees or measures it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SeenPoint {
    /// Event of the point in the world that is shown: the one at which the light left it, if it is seen.
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
            contraction: Contraction::new(observer.celerity),
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

    /// Place of a point at the observer's present, and its event there; D is 1, since no light brings it. `None` if the
    /// worldline does not cross that present, which can happen to one faster than light.
    ///
    /// *Equation:* the event simultaneous for the observer ([`simultaneous`]); its place is that of a resting point
    /// there ([`Contraction`]).
    pub fn measured(&self, place: DVec3) -> Option<SeenPoint> {
        let found = simultaneous(&self.observer, &self.animated.point(place)).ok()?;
        let apparent = self.contraction.observer_from_world(found.position - self.observer.event.position);
        let event = Event { ct: found.ct, position: found.position };
        apparent.is_finite().then_some(SeenPoint { event, apparent, doppler: 1.0 })
    }

    /// Observer that sees the body.
    pub fn observer(&self) -> &Observer {
        &self.observer
    }
}

impl Animated {
    /// Pose of the body at the event of its middle that is shown.
    pub fn as_shown(&self, observer: &Observer, places: Places) -> Pose {
        let middle = self.point(self.ball.centre);
        let ct = match places {
            Places::Seen => retarded(observer.event, &middle).ok().map(|seen| seen.ct),
            Places::Measured => simultaneous(observer, &middle).ok().map(|present| present.ct),
            Places::Instant => None,
        };
        self.at(ct.unwrap_or(observer.event.ct))
    }

    /// Celerity of the body's middle in such a pose.
    pub fn celerity(&self, pose: &Pose) -> Celerity {
        Beta::new(pose.beta(self.ball.centre)).map(Beta::celerity).unwrap_or_default()
    }
}
