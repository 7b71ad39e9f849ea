//! Bounds of an animated body in motion, and hits of rays that are followed through it.

use crate::curve::{Curve, SLACK};
use crate::hit::RayHit;
use crate::observer::SightLine;
use crate::triangles::{Triangle, TriangleTree};
use glam::DVec3;
use physics::{Aberration, Beta, Celerity, Event, Observer, compose};
use scene::Scene;
use scene::motion::{Animated, Ball};
use std::sync::Arc;

/// Bounds of an animated body in motion.
pub struct Swept {
    /// Body.
    pub animated: Arc<Animated>,
    /// Ball around the body's triangles, in its own frame.
    ball: Ball,
    /// Largest radius of that ball in the world, metres.
    world_radius: f64,
    /// Ball that the body never leaves, in the frame in which the chain begins.
    reach: Ball,
}

impl Swept {
    /// Bounds of the meshes that have this motion.
    pub fn new(scene: &Scene, motion: Option<usize>, animated: &Arc<Animated>) -> Self {
        let places = || {
            let meshes = scene.meshes.iter().filter(|mesh| mesh.motion == motion);
            meshes.flat_map(|mesh| &mesh.positions).filter(|place| place.is_finite()).map(|place| place.as_dvec3())
        };
        let bounds = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let (low, high) = places().fold(bounds, |(low, high), place| (low.min(place), high.max(place)));
        let centre = if low.is_finite() { 0.5 * (low + high) } else { DVec3::ZERO };
        let radius = places().map(|place| place.distance(centre)).fold(0.0, f64::max);
        let ball = Ball { centre, radius };
        // Only the radius matters, so the ball is taken about the body's own origin.
        let world_radius = animated.stretch() * radius;
        Self { animated: Arc::clone(animated), ball, world_radius, reach: animated.reach(ball) }
    }

    /// Margin of the boxes around the body's triangles, metres: the largest distance of a chord from its curve.
    pub fn margin(&self) -> f64 {
        SLACK * self.ball.radius
    }

    /// Celerity of a point of the body at a time of the frame in which the chain begins, axes of that frame; zero if
    /// the point is not slower than light.
    fn own_celerity(&self, ct: f64, place: DVec3) -> Celerity {
        Beta::new(self.animated.in_carrier(ct).beta(place)).map(Beta::celerity).unwrap_or_default()
    }

    /// Event of a point of the body in the world, at a time of the frame in which the chain begins, with the celerity.
    pub fn in_world(&self, ct: f64, place: DVec3) -> Observer {
        let position = self.animated.in_carrier(ct).position(place);
        let own = self.own_celerity(ct, place);
        let carrier = self.animated.carrier();
        let celerity = carrier.map_or(own, |carrier| compose(carrier.celerity, own).celerity);
        Observer { event: self.animated.world_event(Event { ct, position }), celerity }
    }

    /// Nearest hit beyond `after` on the curve of a ray in the body's frame, and D from there. The distance is that in
    /// the frame in which the chain begins.
    pub fn first(
        &self,
        tree: &TriangleTree,
        observer: &Observer,
        line: &SightLine,
        after: f64,
        is_there: impl Fn(&RayHit) -> bool,
    ) -> Option<(RayHit, f64)> {
        let observer = &self.animated.own_observer(observer);
        let curve = Curve { animated: &self.animated, observer, direction: line.direction, time: line.time };
        let hit = curve.first(after, &self.ball, self.world_radius, &self.reach, |chord| {
            let [from, to] = chord.ends;
            let [first, last] = chord.span;
            let share = (to - from).length() / (last - first);
            let meet = |triangle: &Triangle| {
                let hit = triangle.meet_curve(&curve, chord)?;
                (hit.distance > after && (hit.front || triangle.double_sided) && is_there(&hit)).then_some(hit)
            };
            let direction = (to - from).try_normalize()?;
            tree.nearest(from, direction, meet, |hit| ((hit.distance - first) * share).max(0.0))
        })?;
        let sent = self.own_celerity(curve.ct(hit.distance), hit.position);
        let doppler = if line.is_of_light() {
            line.doppler / Aberration::new(sent).observer_from_world(line.direction).1
        } else {
            1.0
        };
        Some((hit, doppler))
    }
}
