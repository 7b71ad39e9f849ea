//! Continuation of a sight line from a surface that it meets.
//!
//! Mirrors and glass obey their laws in the frame in which they rest. So a turned ray is what an observer sees who
//! rests on the surface at the event at which the light left it. That event and the surface's celerity define this
//! observer, and the light it sees comes with one more Doppler factor. In the frame of its own body, the observer is
//! placed exactly where the ray met the surface, to the last bit.

use super::{Bend, Bodies, Found, Hit, Seer, Sight};
use crate::surface::Surfaces;
use glam::{DMat3, DQuat, DVec3};
use physics::{Aberration, Beta, Boost, Celerity, Event, Observer};
use scene::Scene;
use scene::motion::{Motion, Uniform};

/// Distance from a surface at which a turned ray begins, relative to its coordinates. It is beyond the rounding error
/// of a place on the surface.
const SKIN: f64 = 1e-10;

/// Time at which light leaves a body, by that body's clock.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Emission {
    /// Index into the bodies.
    pub body: usize,
    /// Time in the body's frame, metres of light travel; for animated bodies, in the world's.
    pub ct: f64,
}

/// Turn of a ray at a surface, in the surface's own frame.
#[derive(Clone, Copy, Debug)]
pub struct Turn {
    /// Time at which the light left.
    pub emission: Emission,
    /// Place of the turn, metres relative to the scene's origin.
    pub position: DVec3,
    /// Direction of the ray away from the observer, against the light's way.
    pub direction: DVec3,
}

impl Bodies {
    /// Emission of the light that is seen as `found`.
    ///
    /// *Equation:* by the body's own clock it is earlier by the length of the way. If light takes no time, it is when
    /// the world's clock shows the observer's time: t' = t/γ − β·x'.
    pub fn emission(&self, scene: &Scene, sight: &Sight, found: &Found) -> Emission {
        let seer = &sight.bodies[found.body];
        let ct = match (&seer.bend, self.uniform(scene, found.body)) {
            (Bend::Light(_), _) => seer.ct - found.hit.distance,
            (Bend::Pose { .. }, _) | (Bend::Moment { .. }, None) => sight.world.ct,
            (Bend::Moment { .. }, Some(Uniform { celerity, anchor })) => {
                let away = found.hit.position + scene.origin - anchor.position;
                anchor.ct + (sight.world.ct - anchor.ct) / celerity.gamma() - celerity.beta().vector().dot(away)
            }
        };
        Emission { body: found.body, ct }
    }

    /// Event of a body in the world, with the body's celerity there.
    pub fn in_world(&self, scene: &Scene, emission: Emission, position: DVec3) -> Observer {
        if let Some(swept) = &self.bodies[emission.body].swept {
            let pose = swept.animated.at(emission.ct);
            let celerity = Beta::new(pose.beta(position)).map(Beta::celerity).unwrap_or_default();
            return Observer { event: Event { ct: emission.ct, position: pose.position(position) }, celerity };
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
        swept.map_or(DMat3::IDENTITY, |swept| swept.animated.at(emission.ct).axes())
    }

    /// Turn of a ray at the surface that it meets. Animated bodies turn no rays.
    pub fn turn(&self, scene: &Scene, sight: &Sight, seen: DVec3, found: &Found) -> Turn {
        let direction = sight.bodies[found.body].line(seen).direction;
        Turn { emission: self.emission(scene, sight, found), position: found.hit.position, direction }
    }

    /// Sight from a surface, the direction of `turn` in it, and the distance at which each body's ray begins.
    pub fn onward(&self, surfaces: &Surfaces, turn: &Turn, geometry: bool) -> (Sight, DVec3, Vec<f64>) {
        let body = turn.emission.body;
        let observer = self.in_world(&surfaces.scene, turn.emission, turn.position);
        let mut sight = self.sight_of(surfaces, &observer, geometry);
        let mut start = sight.start();
        start[body] = skin(turn.position);
        let mut seen = turn.direction;
        if geometry {
            sight.bodies[body] = Seer {
                position: turn.position,
                ct: turn.emission.ct,
                group_from_observer: DQuat::IDENTITY,
                bend: Bend::Light(Aberration::new(Celerity::ZERO)),
            };
        } else {
            // At one moment of the world the body is contracted along its motion.
            let along = observer.celerity.vector().normalize_or_zero();
            let shorter = 1.0 - 1.0 / observer.celerity.gamma();
            seen = (seen - along * (along.dot(seen) * shorter)).normalize();
        }
        (sight, seen, start)
    }

    /// Hit of a ray inside a body with that body, in its own frame.
    pub fn within(&self, turn: &Turn, is_there: impl Fn(&Hit) -> bool) -> Option<Hit> {
        let surfaces = &self.bodies[turn.emission.body].surfaces;
        surfaces.first(turn.position, turn.direction, skin(turn.position), true, is_there)
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
