//! Hands of a clock: their shapes, and the keys that turn them.
//!
//! A dial has twelve numbers. The hand of seconds goes round in twelve seconds, from number to number in one; the hand
//! of rounds counts its rounds. So the time is read off as on any clock, and what a ride of a minute does to it is
//! seen.

use crate::shape::{FaceColour, Shape};
use glam::{DQuat, DVec3, Vec3};
use scene::Mesh;
use scene::motion::{Keyed, Track, TrackKeys};
use std::f64::consts::FRAC_1_SQRT_2;

/// Time of one round of the hand of seconds, seconds.
pub const ROUND_S: f64 = 12.0;
/// Time of one round of the hand of rounds, seconds.
pub const ROUNDS_S: f64 = 12.0 * ROUND_S;

/// Kind of hand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum HandKind {
    /// Long hand that goes round in twelve seconds.
    Seconds,
    /// Short hand that goes round in twelve rounds of the other.
    Rounds,
}

impl HandKind {
    /// Time of one round, seconds.
    pub(crate) fn round_s(self) -> f64 {
        match self {
            Self::Seconds => ROUND_S,
            Self::Rounds => ROUNDS_S,
        }
    }

    /// Turn of the hand about the dial's axis, clockwise from the top at time 0, for ever.
    pub(crate) fn turn(self) -> Keyed {
        let half = FRAC_1_SQRT_2;
        // Quarter turns about the axis out of the dial; the last is the first, turned once round.
        let quarters = [[0.0, 1.0], [-half, half], [-1.0, 0.0], [-half, -half], [0.0, -1.0]];
        let quarters = quarters.map(|[z, w]| DQuat::from_xyzw(0.0, 0.0, z, w));
        let times = (0..5).map(|quarter| f64::from(quarter) * self.round_s() / 4.0).collect();
        let keys = TrackKeys::slerp(times, quarters.to_vec()).expect("times ascend, and quarters are rotations");
        let keys = keys.repeating([0.0, self.round_s()], quarters[4]);
        Keyed { translation: Track::Fixed(DVec3::ZERO), rotation: Track::Keyed(keys), scale: Track::Fixed(DVec3::ONE) }
    }

    /// Shape of the hand on a dial of this radius, metres: it points up, in front of the dial.
    pub(crate) fn mesh(self, radius: f32, material: usize) -> Mesh {
        const RED: FaceColour = [0.50, 0.015, 0.02];
        const BLACK: FaceColour = [0.012, 0.012, 0.016];
        let (name, length, width, height, colour) = match self {
            Self::Seconds => ("hand of seconds", 0.92, 0.075, 0.07, RED),
            Self::Rounds => ("hand of rounds", 0.55, 0.11, 0.04, BLACK),
        };
        let at = |x: f32, y: f32| Vec3::new(x, y, height) * radius;
        let mut shape = Shape::new(name, material, false);
        let tail = -0.2;
        shape.face(&[at(-0.6 * width, tail), at(0.6 * width, tail), at(width, 0.1), at(-width, 0.1)], colour);
        shape.face(&[at(-width, 0.1), at(width, 0.1), at(0.2 * width, length), at(-0.2 * width, length)], colour);
        shape.finish(None)
    }
}

#[cfg(test)]
mod tests {
    //! Law: a hand stands at the angle of the time, to 1e-6 of a radian, for ever, and turns clockwise.

    use super::*;
    use scene::SceneClock;
    use scene::motion::{Animated, ChainLink};

    #[test]
    fn a_hand_stands_at_the_angle_of_the_time() {
        let real_light_m_s = Animated::new("", vec![]).speed_of_light_m_s();
        for kind in [HandKind::Seconds, HandKind::Rounds] {
            let hand = Animated::new("hand", vec![ChainLink::Keyed(kind.turn())]);
            for time_s in [-31.0, 0.0, 0.4, 3.0, 7.3, 11.999, 25.0, 5003.1] {
                let tip = hand.at(time_s * real_light_m_s).position(DVec3::Y);
                let angle = SceneClock::hand_rad(time_s, kind.round_s());
                let expected = DVec3::new(angle.sin(), angle.cos(), 0.0);
                assert!(tip.distance(expected) < 1e-6, "{kind:?} at {time_s} s: {tip} {expected}");
            }
        }
    }

    #[test]
    fn hands_face_the_observer_in_front_of_the_dial() {
        for kind in [HandKind::Seconds, HandKind::Rounds] {
            let mesh = kind.mesh(2.0, 0);
            assert!(mesh.normals.iter().all(|normal| *normal == Vec3::Z));
            assert!(mesh.positions.iter().all(|at| at.z > 0.0 && at.length() < 2.0));
        }
    }
}
