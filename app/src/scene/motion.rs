//! What of a scene moves, and how: uniformly, as a file's `celerity` says, or as an animation has it.
//!
//! A uniformly moving body is modelled at rest: the file places it as it would stand in its own frame, whose axes are a pure boost of the
//! world's and whose origin event is the node's own place at world time `at`. In the world it is therefore shorter along its motion, and all
//! its own laws of light are those of a scene at rest: an observer is to it what he is to the world, with another celerity. So each group of one
//! celerity is drawn as a world of its own, seen by [`Uniform::seen_by`]'s eye (W 5.1.2).
//!
//! An animated body has a pose at each time of the world, and each of its points a worldline, which must stay slower than light.
//! Nothing is claimed about what holds it together.

use glam::{DAffine3, DQuat, DVec3};
use physics::retarded::Worldline;
use physics::{Boost, Celerity, Event, FourVector, Observer, compose};

/// How meshes move.
#[derive(Clone, Debug, PartialEq)]
pub enum Motion {
    /// Always at one celerity.
    Uniform(Uniform),
    /// As keys of the file say.
    Animated(Animation),
}

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

/// Motion by keys.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Animation {}

impl Animation {
    /// Where the body is at world time `ct` (metres): takes world points from where the file has them at rest to where they are then.
    pub fn world_from_rest(&self, _ct: f64) -> DAffine3 {
        DAffine3::IDENTITY
    }

    /// How fast that changes, per metre of `ct`.
    pub fn rate(&self, _ct: f64) -> DAffine3 {
        DAffine3::from_mat3_translation(glam::DMat3::ZERO, DVec3::ZERO)
    }
}

/// A point of an animated body.
#[derive(Clone, Copy, Debug)]
pub struct Point<'a> {
    /// How the body moves.
    pub animation: &'a Animation,
    /// World position where the file has it at rest, metres.
    pub rest: DVec3,
}

impl Worldline for Point<'_> {
    fn at(&self, ct: f64) -> (DVec3, DVec3) {
        let place = self.animation.world_from_rest(ct).transform_point3(self.rest);
        (place, self.animation.rate(ct).transform_point3(self.rest))
    }
}
