//! Uniform motion: bodies that rest in a frame of their own.
//!
//! A uniformly moving body is modelled at rest: the file places it as it stands in its own frame. The axes of that
//! frame are a pure boost of the world's, and its origin event is the node's own place at world time `at`. In the
//! world the body is therefore shorter along its motion. In its own frame light behaves as in a scene at rest, and
//! the observer has another celerity. So each group of one celerity is drawn as a resting scene, seen by the eye of
//! [`Uniform::seen_by`] (W 5.1.2).

use glam::{DQuat, DVec3};
use physics::{Boost, Celerity, Event, FourVector, Observer, compose};

/// Uniform motion of a group of meshes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Uniform {
    /// Celerity in the world, world axes.
    pub celerity: Celerity,
    /// Event of the node's origin in the world. Its place in the object's own frame is the same three numbers.
    pub anchor: Event,
}

/// Observer in the frame of a uniformly moving object.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SeenBy {
    /// Position of the observer in the object's frame, metres: in the coordinates that the file uses for the object.
    pub position: DVec3,
    /// Celerity of the observer in that frame.
    pub celerity: Celerity,
    /// Rotation from the axes of the pure boost out of the object's frame to the observer's own (a pure boost of the
    /// world's): Wigner's rotation.
    pub observer_from_group: DQuat,
}

impl Uniform {
    /// Event in the object's own frame. At the anchor both frames show the same four numbers.
    pub fn own_from_world(&self, event: Event) -> Event {
        self.anchor + Boost::observer_from_world(self.celerity).apply(event - self.anchor)
    }

    /// Event in the world, from the object's own frame.
    pub fn world_from_own(&self, event: Event) -> Event {
        self.anchor + Boost::observer_from_world(self.celerity).inverse().apply(event - self.anchor)
    }

    /// Observer in the object's frame.
    ///
    /// *Equation:* B(u_o) B(−u) = R(wigner) B(u_rel): from the object's frame to the world's, and on to the
    /// observer's (W 4.1).
    pub fn seen_by(&self, observer: &Observer) -> SeenBy {
        let object_from_world = Boost::observer_from_world(self.celerity);
        let apart =
            FourVector { t: observer.event.ct - self.anchor.ct, r: observer.event.position - self.anchor.position };
        let both = compose(-self.celerity, observer.celerity);
        SeenBy {
            position: self.anchor.position + object_from_world.apply(apart).r,
            celerity: both.celerity,
            observer_from_group: both.wigner,
        }
    }
}

#[cfg(test)]
mod tests {
    //! Law under test: seen from the object's own frame, a point of it has the same apparent position and colour as a
    //! moving point seen from the world. A boost the wrong way, or a missing Wigner rotation, shows at once.

    use super::*;
    use physics::{PointSource, apparent};
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    #[test]
    fn a_point_of_an_object_appears_where_a_moving_point_does() {
        let mut random = ChaCha8Rng::seed_from_u64(7);
        for _ in 0..2000 {
            let mut vector = |size: f64| DVec3::from_array([0, 1, 2].map(|_| size * random.random_range(-1.0..1.0)));
            let celerity = |vector: DVec3| Celerity::new(vector).expect("finite");
            let anchor = Event { ct: vector(10.0).x, position: vector(30.0) };
            let motion = Uniform { celerity: celerity(vector(3.0)), anchor };
            let observer = Observer {
                event: Event { ct: vector(20.0).x, position: vector(30.0) },
                celerity: celerity(vector(3.0)),
            };
            let place = vector(30.0);

            // The point rests in the object's frame.
            let seen_by = motion.seen_by(&observer);
            let own = Observer { event: Event { ct: 0.0, position: seen_by.position }, celerity: seen_by.celerity };
            let seen = apparent::at_rest(&own, place);
            let position = seen_by.observer_from_group * seen.position;

            // The point moves in the world: its position at world time 0 follows from its worldline, transformed from
            // the object's frame.
            let world_from_object = Boost::observer_from_world(motion.celerity).inverse();
            let event = world_from_object.apply(FourVector { t: 0.0, r: place - anchor.position });
            let beta = motion.celerity.beta().vector();
            let at_zero = anchor.position + event.r - beta * (anchor.ct + event.t);
            let direct = apparent::moving(&observer, &PointSource { position: at_zero, celerity: motion.celerity });

            let scale = 1e-12 * (direct.position.length() + 200.0);
            assert!(position.distance(direct.position) < scale, "{position} {}", direct.position);
            assert!((seen.doppler / direct.doppler - 1.0).abs() < 1e-11, "{} {}", seen.doppler, direct.doppler);
        }
    }
}
