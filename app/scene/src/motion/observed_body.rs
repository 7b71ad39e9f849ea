//! Animated body as one observer sees it: each of its points at its own retarded event.
//!
//! The retarded event lies on the observer's past light cone, like those of resting points. The point therefore
//! appears where a resting point at that event would appear. Only its Doppler factor depends on its own motion.

use std::sync::Arc;

use glam::{DAffine3, DMat3, DVec3};
use physics::interpolation_error::TriangleInterpolation;
use physics::retarded::retarded;
use physics::simultaneous::simultaneous;
use physics::{Aberration, Beta, Celerity, Contraction, Event, Observer};
use view::Places;

use super::animated::{Animated, Ball, Pose};

/// Animated body together with the observer that sees it.
#[derive(Clone, Debug)]
pub struct ObservedBody {
    animated: Arc<Animated>,
    observer: Observer,
    /// Observer in the frame in which the body's chain begins.
    own: Observer,
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
        let own = animated.own_observer(observer);
        Self {
            animated: Arc::clone(animated),
            observer: *observer,
            own,
            bend: TriangleInterpolation::new(observer.celerity),
            aberration: Aberration::new(own.celerity),
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
        let found = retarded(self.own.event, &self.animated.point(place)).ok()?;
        let towards = found.position - self.own.event.position;
        let sent = Beta::new(found.beta).ok()?.celerity();
        let doppler =
            self.aberration.observer_from_world(towards).1 / Aberration::new(sent).observer_from_world(towards).1;
        let event = self.animated.world_event(Event { ct: found.ct, position: found.position });
        let apparent = self.bend.apparent(event.position - self.observer.event.position);
        (apparent.is_finite() && doppler > 0.0).then_some(SeenPoint { event, apparent, doppler })
    }

    /// Place of a point at the observer's present, and its event there; D is 1, since no light brings it. `None` if the
    /// worldline does not cross that present, which can happen to one faster than light.
    ///
    /// *Equation:* the event simultaneous for the observer ([`simultaneous`]), found in the frame in which the body's
    /// chain begins; its place is that of a point that rests there in the world ([`Contraction`]).
    pub fn measured(&self, place: DVec3) -> Option<SeenPoint> {
        let event = self.animated.event_shown(&self.own, Places::Measured, place)?;
        let apparent = self.contraction.observer_from_world(event.position - self.observer.event.position);
        apparent.is_finite().then_some(SeenPoint { event, apparent, doppler: 1.0 })
    }

    /// Observer that sees the body.
    pub fn observer(&self) -> &Observer {
        &self.observer
    }
}

impl Animated {
    /// Observer in the frame in which the body's chain begins.
    pub fn own_observer(&self, observer: &Observer) -> Observer {
        self.carrier().map_or(*observer, |carrier| Observer {
            event: carrier.own_from_world(observer.event),
            celerity: carrier.seen_by(observer).celerity,
        })
    }

    /// Event in the world, from the frame in which the body's chain begins.
    pub fn world_event(&self, own: Event) -> Event {
        self.carrier().map_or(own, |carrier| carrier.world_from_own(own))
    }

    /// Event in the world at which a point of the body is seen or measured by an observer, who is given in the frame in
    /// which the body's chain begins. `None` if there is none.
    fn event_shown(&self, own: &Observer, places: Places, place: DVec3) -> Option<Event> {
        let point = self.point(place);
        let shown = match places {
            Places::Seen => retarded(own.event, &point).ok().map(|seen| (seen.ct, seen.position)),
            Places::Measured => simultaneous(own, &point).ok().map(|present| (present.ct, present.position)),
            Places::Instant => None,
        };
        shown.map(|(ct, position)| self.world_event(Event { ct, position }))
    }

    /// Pose of the body at the event of its middle that is shown.
    pub fn as_shown(&self, observer: &Observer, places: Places) -> Pose {
        let event = self.event_shown(&self.own_observer(observer), places, self.ball.centre);
        self.at(event.map_or(observer.event.ct, |event| event.ct))
    }

    /// Transform from the body to the places in the world at which it is shown to an observer, fitted to the middle of
    /// its ball and to both ends of the ball along each axis. `None` if one of these is not shown.
    ///
    /// *Accuracy:* a body that turns is bent by the delays of its light; the fit halves what is left of that: half of β
    /// times the radius times the cosine between the body and the line of sight.
    pub fn pose_shown(&self, observer: &Observer, places: Places) -> Option<DAffine3> {
        if places == Places::Instant {
            return Some(self.at(observer.event.ct).world_from_body);
        }
        let own = self.own_observer(observer);
        let place = |at: DVec3| self.event_shown(&own, places, at).map(|event| event.position);
        let Ball { centre, radius } = self.ball;
        let reach = radius.max(f64::MIN_POSITIVE);
        let middle = place(centre)?;
        let mut bend = DVec3::ZERO;
        let mut axis = |along: DVec3| {
            let [low, high] = [place(centre - along * reach)?, place(centre + along * reach)?];
            bend += 0.5 * (low + high) - middle;
            Some((high - low) / (2.0 * reach))
        };
        let matrix3 = DMat3::from_cols(axis(DVec3::X)?, axis(DVec3::Y)?, axis(DVec3::Z)?);
        Some(DAffine3 { matrix3, translation: middle + 0.5 * bend - matrix3 * centre })
    }

    /// Celerity of the body's middle in such a pose.
    pub fn celerity(&self, pose: &Pose) -> Celerity {
        Beta::new(pose.beta(self.ball.centre)).map(Beta::celerity).unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    //! Law under test: a body that a carrier takes along is seen where and when its points are by the carrier's own
    //! time. A hand that turned by the world's time, or by that of the dial's middle, would stand at another angle.

    use super::*;
    use crate::motion::{ChainLink, Keyed, Track, TrackKeys, Uniform};
    use glam::DQuat;
    use physics::Boost;

    const SPEED_OF_LIGHT_M_S: f64 = 10.0;
    const PERIOD_S: f64 = 12.0;
    const PIVOT: DVec3 = DVec3::new(4.0, 1.0, -2.0);

    /// Hand about the axis z of its pivot.
    fn hand(carrier: Option<Uniform>) -> Arc<Animated> {
        let quarters: Vec<DQuat> =
            (0..=4).map(|quarter| DQuat::from_rotation_z(-f64::from(quarter) * std::f64::consts::FRAC_PI_2)).collect();
        let times = (0..=4).map(|quarter| f64::from(quarter) * PERIOD_S / 4.0).collect();
        let turn = TrackKeys::slerp(times, quarters.clone()).unwrap().repeating([0.0, PERIOD_S], quarters[0]);
        let keyed =
            Keyed { translation: Track::Fixed(PIVOT), rotation: Track::Keyed(turn), scale: Track::Fixed(DVec3::ONE) };
        let mut hand = Animated::new("hand", vec![ChainLink::Keyed(keyed)]);
        hand.speed_of_light_m_s = SPEED_OF_LIGHT_M_S;
        hand.ball = crate::motion::Ball { centre: DVec3::Y * 0.5, radius: 0.5 };
        Arc::new(carrier.into_iter().fold(hand, Animated::aboard))
    }

    #[test]
    fn a_hand_on_a_carrier_turns_by_the_carriers_time_at_each_of_its_points() {
        let celerity = Beta::new(DVec3::X * 0.6).unwrap().celerity();
        let carrier = Uniform { celerity, anchor: Event { ct: 3.0, position: DVec3::new(1.0, 0.0, 2.0) } };
        let observer = Observer {
            event: Event { ct: 57.0, position: DVec3::new(5.0, 1.7, 9.0) },
            celerity: Beta::new(DVec3::new(-0.3, 0.0, 0.5)).unwrap().celerity(),
        };
        let body = ObservedBody::new(&hand(Some(carrier)), &observer);
        for reach in [0.0, 0.4, 1.0] {
            let seen = body.seen(DVec3::Y * reach).unwrap();
            let own = carrier.own_from_world(seen.event);
            // The place by the carrier's time, and an interval of length zero to the observer.
            let angle = std::f64::consts::TAU * (own.ct / SPEED_OF_LIGHT_M_S) / PERIOD_S;
            let expected = PIVOT + DVec3::new(angle.sin(), angle.cos(), 0.0) * reach;
            assert!(own.position.distance(expected) < 1e-9, "{} {expected}", own.position);
            let apart = observer.event - seen.event;
            assert!((apart.t - apart.r.length()).abs() < 1e-9);
        }
    }

    #[test]
    fn a_hand_on_a_carrier_is_measured_by_the_carriers_time_at_the_observers_present() {
        let celerity = Beta::new(DVec3::X * 0.6).unwrap().celerity();
        let carrier = Uniform { celerity, anchor: Event { ct: 3.0, position: DVec3::new(1.0, 0.0, 2.0) } };
        let observer = Observer {
            event: Event { ct: 57.0, position: DVec3::new(5.0, 1.7, 9.0) },
            celerity: Beta::new(DVec3::new(-0.3, 0.0, 0.5)).unwrap().celerity(),
        };
        let body = ObservedBody::new(&hand(Some(carrier)), &observer);
        let boost = Boost::observer_from_world(observer.celerity);
        for reach in [0.0, 0.4, 1.0] {
            let measured = body.measured(DVec3::Y * reach).unwrap();
            let own = carrier.own_from_world(measured.event);
            let angle = std::f64::consts::TAU * (own.ct / SPEED_OF_LIGHT_M_S) / PERIOD_S;
            let expected = PIVOT + DVec3::new(angle.sin(), angle.cos(), 0.0) * reach;
            assert!(own.position.distance(expected) < 1e-9, "{} {expected}", own.position);
            // In the observer's frame the event has the observer's time, and the place that is shown.
            let apart = boost.apply(measured.event - observer.event);
            assert!(apart.t.abs() < 1e-9 && apart.r.distance(measured.apparent) < 1e-9, "{apart:?}");
        }
    }

    #[test]
    fn a_hand_at_rest_on_its_carrier_is_seen_as_in_the_world_of_that_carrier() {
        let still = Uniform { celerity: Celerity::ZERO, anchor: Event::default() };
        let observer = Observer { event: Event { ct: 20.0, ..Event::default() }, celerity: Celerity::ZERO };
        let [free, carried] = [None, Some(still)].map(|carrier| ObservedBody::new(&hand(carrier), &observer));
        assert_eq!(free.seen(DVec3::Y), carried.seen(DVec3::Y));
    }

    #[test]
    fn the_pose_in_which_a_slow_hand_is_seen_or_measured_is_right_to_centimetres() {
        let celerity = Beta::new(DVec3::Z * 0.9).unwrap().celerity();
        let carrier = Uniform { celerity: Beta::new(DVec3::X * 0.6).unwrap().celerity(), anchor: Event::default() };
        let hands = [None, Some(carrier)].map(hand);
        for (hand, ct) in hands.iter().flat_map(|hand| [20.0, 31.0, 77.7].map(|ct| (hand, ct))) {
            let observer = Observer { event: Event { ct, position: DVec3::new(9.0, 0.0, 3.0) }, celerity };
            let body = ObservedBody::new(hand, &observer);
            for (places, shown) in [
                (Places::Seen, &(|place| body.seen(place)) as &dyn Fn(DVec3) -> Option<SeenPoint>),
                (Places::Measured, &|place| body.measured(place)),
            ] {
                // Light bends what is seen of a carried body, which stands in no map.
                if hand.carrier().is_some() && places == Places::Seen {
                    continue;
                }
                let pose = hand.pose_shown(&observer, places).unwrap();
                for place in [DVec3::ZERO, DVec3::Y * 0.3, DVec3::Y, DVec3::new(0.1, 0.6, 0.0)] {
                    let off = pose.transform_point3(place).distance(shown(place).unwrap().event.position);
                    assert!(off < 1e-2, "{off} m at {place}, {places:?}");
                }
            }
        }
    }

    #[test]
    fn the_pose_of_a_carried_body_moves_as_its_rate_says() {
        let celerity = Beta::new(DVec3::new(0.5, 0.0, 0.3)).unwrap().celerity();
        let body = hand(Some(Uniform { celerity, anchor: Event::default() }));
        let (before, now, after) = (body.at(20.0 - 1e-4), body.at(20.0), body.at(20.0 + 1e-4));
        for place in [DVec3::ZERO, DVec3::Y * 0.5, DVec3::Y] {
            let moved = (after.position(place) - before.position(place)) / 2e-4;
            assert!(moved.distance(now.beta(place)) < 1e-6, "{moved} {}", now.beta(place));
        }
    }
}
