//! Bodies of a scene: the first triangle on a ray's way back, among all of them.
//!
//! Each group of meshes with one motion is a body with its own frame, in which it rests. Along one sight line the
//! apparent distance is |x'| = r D, with r in the body's frame and D from that frame to the observer. For every body
//! it is the time since the light left, by the observer's clock, so the smallest one is seen.

use crate::hit::{Emission, FirstHit, RayHit, TracedPlace, Turn};
use crate::observer::{LightDelay, ObserverInBodies, ObserverInBody};
use crate::swept::Swept;
use crate::triangles::{Triangle, TriangleTree};
use glam::{DMat3, DVec3};
use physics::{Boost, Celerity, Event, Observer};
use scene::motion::{Motion, Uniform};
use scene::{Alpha, Mesh, Scene};
use std::sync::Arc;
use view::Places;

/// Distance from a surface at which a turned ray begins, relative to its coordinates. It is beyond the rounding error
/// of a place on the surface.
const SKIN: f64 = 1e-10;

/// Bodies of a scene, which rays can meet.
pub struct Bodies {
    bodies: Vec<TracedBody>,
    /// Meshes, all at rest, that cast shadows of the sun and of lamps.
    casters: Vec<bool>,
    /// True if light goes through glass. Then glass has no shadow, and rays also meet its inner side.
    pub clear_glass: bool,
}

/// Meshes with one motion.
struct TracedBody {
    motion: Option<usize>,
    tree: TriangleTree,
    /// Bounds of the body in motion, if it is animated.
    swept: Option<Swept>,
}

impl Bodies {
    /// Sorts a scene's triangles. Triangles with a vertex that is not finite are left out.
    pub fn new(scene: &Arc<Scene>) -> Self {
        let motions = std::iter::once(None).chain((0..scene.motions.len()).map(Some));
        let body = |motion: Option<usize>| {
            let animated = motion.and_then(|motion| scene.motions[motion].animated());
            let swept = animated.map(|animated| Swept::new(scene, motion, animated));
            let margin = swept.as_ref().map_or(0.0, Swept::margin);
            let tree = TriangleTree::new(scene, margin, |mesh| scene.meshes[mesh].motion == motion);
            TracedBody { motion, tree, swept }
        };
        let bodies = motions.map(body).filter(|body| !body.tree.is_empty()).collect();
        let casts = |mesh: &Mesh| {
            let material = &scene.materials[mesh.material];
            scene.light.shadows && mesh.motion.is_none() && !material.unlit && material.alpha != Alpha::Blend
        };
        let casters = scene.meshes.iter().map(casts).collect();
        Self { bodies, casters, clear_glass: false }
    }

    /// Observer in the frames of all bodies.
    pub fn observer(&self, scene: &Scene, observer: &Observer, places: Places) -> ObserverInBodies {
        ObserverInBodies::new(scene, self.bodies.iter().map(|body| body.motion), observer, places)
    }

    /// First hit in a direction, beyond the given distance in each body's frame, among the hits for which `is_there`
    /// is true.
    pub fn first(
        &self,
        observer: &ObserverInBodies,
        seen: DVec3,
        beyond: &[f64],
        is_there: impl Fn(&RayHit) -> bool,
    ) -> Option<FirstHit> {
        let mut first: Option<FirstHit> = None;
        for (index, ((body, own), &after)) in self.bodies.iter().zip(observer.bodies()).zip(beyond).enumerate() {
            let line = own.line(seen);
            let found = match (&body.swept, &own.delay) {
                (Some(swept), LightDelay::Travel(_) | LightDelay::Present(_)) => {
                    swept.first(&body.tree, &observer.observer, &line, after, &is_there)
                }
                _ => {
                    // Animated bodies turn no rays.
                    let clear_glass = self.clear_glass && body.swept.is_none();
                    let hit = body.tree.first(own.position, line.direction, after, clear_glass, &is_there);
                    hit.map(|hit| (hit, line.doppler))
                }
            };
            let Some((hit, doppler)) = found else { continue };
            let apparent = hit.distance * line.apparent;
            if first.as_ref().is_none_or(|first| apparent < first.apparent) {
                first = Some(FirstHit { hit, doppler, body: index, apparent, time: line.time });
            }
        }
        first
    }

    /// Distances just beyond a hit, in each body's frame.
    pub fn beyond(&self, observer: &ObserverInBodies, seen: DVec3, found: &FirstHit) -> Vec<f64> {
        let after = |(index, own): (usize, &ObserverInBody)| {
            if index == found.body { found.hit.distance } else { found.apparent / own.line(seen).apparent }
        };
        observer.bodies().iter().enumerate().map(after).collect()
    }

    /// Hit of a ray inside a body with that body, in its own frame.
    pub fn within(&self, turn: &Turn, is_there: impl Fn(&RayHit) -> bool) -> Option<RayHit> {
        let tree = &self.bodies[turn.emission.body].tree;
        tree.first(turn.position, turn.direction, skin(turn.position), true, is_there)
    }

    /// Place in the scene of a hit.
    pub fn place(&self, seen: DVec3, found: &FirstHit) -> TracedPlace {
        TracedPlace {
            position: found.hit.position,
            motion: self.bodies[found.body].motion,
            apparent: seen * found.apparent,
            doppler: found.doppler,
        }
    }

    /// Emission of the light that is seen as `found`.
    ///
    /// *Equation:* by the body's own clock it is earlier by the length of the way; at the observer's present it is
    /// later by u·x'. If light takes no time, it is when the world's clock shows the observer's time: t' = t/γ − β·x'.
    pub fn emission(&self, scene: &Scene, observer: &ObserverInBodies, found: &FirstHit) -> Emission {
        let own = &observer.bodies()[found.body];
        let world_ct = observer.world_ct();
        let ct = match (&own.delay, self.uniform(scene, found.body)) {
            (LightDelay::Travel(_) | LightDelay::Present(_), _) => own.ct + found.time * found.hit.distance,
            (LightDelay::PoseNow { .. }, _) => own.ct,
            (LightDelay::MomentNow { .. }, None) => world_ct,
            (LightDelay::MomentNow { .. }, Some(Uniform { celerity, anchor })) => {
                let away = found.hit.position + scene.origin - anchor.position;
                anchor.ct + (world_ct - anchor.ct) / celerity.gamma() - celerity.beta().vector().dot(away)
            }
        };
        Emission { body: found.body, ct }
    }

    /// Event of a body in the world, with the body's celerity there.
    pub fn in_world(&self, scene: &Scene, emission: Emission, position: DVec3) -> Observer {
        if let Some(swept) = &self.bodies[emission.body].swept {
            return swept.in_world(emission.ct, position);
        }
        let own = Event { ct: emission.ct, position: position + scene.origin };
        match self.uniform(scene, emission.body) {
            None => Observer { event: own, celerity: Celerity::ZERO },
            Some(Uniform { celerity, anchor }) => {
                let apart = Boost::observer_from_world(celerity).inverse().apply(own - anchor);
                Observer { event: anchor + apart, celerity }
            }
        }
    }

    /// Rotation of a body's axes against the world's.
    pub fn axes(&self, emission: Emission) -> DMat3 {
        let swept = self.bodies[emission.body].swept.as_ref();
        swept.map_or(DMat3::IDENTITY, |swept| swept.animated.in_carrier(emission.ct).axes())
    }

    /// Turn of a ray at the surface that it meets. Animated bodies turn no rays.
    pub fn turn(&self, scene: &Scene, observer: &ObserverInBodies, seen: DVec3, found: &FirstHit) -> Turn {
        let direction = observer.bodies()[found.body].line(seen).direction;
        Turn { emission: self.emission(scene, observer, found), position: found.hit.position, direction }
    }

    /// Observer at a turn, direction in which that observer sees the turned ray, and distance at which each body's ray
    /// begins.
    ///
    /// Mirrors and glass obey their laws in the frame in which they rest. So a turned ray is what an observer sees who
    /// rests on the surface at the event at which the light left it. That event and the surface's celerity define this
    /// observer, and the light it sees comes with one more Doppler factor. In the frame of its own body, the observer
    /// is placed exactly where the ray met the surface, to the last bit.
    ///
    /// What is measured is shown by no light, so nothing turns it.
    pub fn onward(&self, scene: &Scene, turn: &Turn, places: Places) -> (ObserverInBodies, DVec3, Vec<f64>) {
        let body = turn.emission.body;
        let on_surface = self.in_world(scene, turn.emission, turn.position);
        let mut observer = self.observer(scene, &on_surface, places);
        let mut start = observer.start();
        start[body] = skin(turn.position);
        let mut seen = turn.direction;
        if places == Places::Seen {
            observer.place_at_rest(body, turn.position, turn.emission.ct);
        } else {
            // At one moment of the world the body is contracted along its motion.
            let along = on_surface.celerity.vector().normalize_or_zero();
            let shorter = 1.0 - 1.0 / on_surface.celerity.gamma();
            seen = (seen - along * (along.dot(seen) * shorter)).normalize();
        }
        (observer, seen, start)
    }

    /// True if the sun's light reaches a point with this normal that rests in the world. The point is relative to the
    /// scene's origin.
    ///
    /// The ray begins off the surface, beyond the rounding error of its place.
    pub fn sunlit(&self, position: DVec3, normal: DVec3, towards_sun: DVec3) -> bool {
        let from = position + skin(position) * normal;
        self.is_free(from, towards_sun, f64::INFINITY)
    }

    /// True if nothing is between a point at rest in the world and one of the lamps, `away` from it. `normal` is as
    /// for [`Bodies::sunlit`]; it is zero if the point moves, since its frame has another normal.
    pub fn lamplit(&self, position: DVec3, normal: DVec3, away: DVec3) -> bool {
        let offset = skin(position) * normal;
        let distance = (away - offset).length();
        self.is_free(position + offset, (away - offset) / distance, distance)
    }

    fn is_free(&self, from: DVec3, direction: DVec3, until: f64) -> bool {
        // A smooth normal may lead a little into the surface.
        let after = 8.0 * skin(from);
        let Some(resting) = self.bodies.iter().find(|body| body.motion.is_none()) else { return true };
        let meet = |triangle: &Triangle| {
            if !self.casters[triangle.mesh] {
                return None;
            }
            let hit = triangle.meet(from, direction)?;
            let blocks = hit.distance > after && hit.distance < until && !(self.clear_glass && triangle.glass);
            blocks.then_some(hit)
        };
        resting.tree.nearest(from, direction, meet, |hit| hit.distance).is_none()
    }

    fn uniform(&self, scene: &Scene, body: usize) -> Option<Uniform> {
        match &scene.motions[self.bodies[body].motion?] {
            Motion::Uniform(uniform) => Some(*uniform),
            Motion::Animated(_) => None,
        }
    }
}

fn skin(position: DVec3) -> f64 {
    SKIN * (1.0 + position.abs().max_element())
}
