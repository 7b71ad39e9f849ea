//! Uniform motion: a frame of its own.
//!
//! A uniformly moving body is modelled at rest: the file places it as it would stand in its own frame, whose axes are a pure boost of the
//! world's and whose origin event is the node's own place at world time `at`. In the world it is therefore shorter along its motion, and all
//! its own laws of light are those of a scene at rest: an observer is to it what he is to the world, with another celerity. So each group of one
//! celerity is drawn as a world of its own, seen by [`Uniform::seen_by`]'s eye (W 5.1.2).

use glam::{DQuat, DVec3};
use physics::{Boost, Celerity, Event, FourVector, Observer, compose};

/// Uniform motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Uniform {
    /// In the world.
    pub celerity: Celerity,
    /// Where the node's origin is when, in the world; its place in the object's own frame is the same three numbers.
    pub anchor: Event,
}

/// An observer as a uniformly moving object has him.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SeenBy {
    /// Where he is in the object's frame, metres: in the coordinates in which the file has the object.
    pub position: DVec3,
    /// How he moves in that frame.
    pub celerity: Celerity,
    /// From the axes of the pure boost out of the object's frame to the observer's own (a pure boost of the world's): Wigner's rotation.
    pub observer_from_group: DQuat,
}

impl Uniform {
    /// The observer in the object's frame.
    ///
    /// *Equation:* B(u_o) B(−u) = R(wigner) B(u_rel): from the object's frame to the world's, and on to the observer's (W 4.1).
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
    //! An object's own world shows the observer what the world does: a point of it appears where, and in the colour in which, a moving point
    //! appears to him directly. A boost the wrong way, or Wigner's rotation left out, shows at once.

    use super::*;
    use physics::{Source, apparent};
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

            // In the object's frame it rests.
            let seen_by = motion.seen_by(&observer);
            let own = Observer { event: Event { ct: 0.0, position: seen_by.position }, celerity: seen_by.celerity };
            let seen = apparent::at_rest(&own, place);
            let position = seen_by.observer_from_group * seen.position;

            // In the world it moves: at world time 0 it is where its worldline, taken from the object's frame, crosses that time.
            let world_from_object = Boost::observer_from_world(motion.celerity).inverse();
            let event = world_from_object.apply(FourVector { t: 0.0, r: place - anchor.position });
            let beta = motion.celerity.beta().vector();
            let at_zero = anchor.position + event.r - beta * (anchor.ct + event.t);
            let direct = apparent::moving(&observer, &Source { position: at_zero, celerity: motion.celerity });

            let scale = 1e-12 * (direct.position.length() + 200.0);
            assert!(position.distance(direct.position) < scale, "{position} {}", direct.position);
            assert!((seen.doppler / direct.doppler - 1.0).abs() < 1e-11, "{} {}", seen.doppler, direct.doppler);
        }
    }
}
