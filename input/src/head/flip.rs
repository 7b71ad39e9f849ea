//! Mirrors: axes that a tracker counts the other way.

use glam::{DQuat, DVec3};
use serde::{Deserialize, Serialize};

/// Direction that a tracker counts the other way.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum FlipAxis {
    /// The tracker's x axis is mirrored, and turns about y and z with it.
    X,
    /// The tracker's y axis is mirrored, and turns about x and z with it.
    Y,
    /// The tracker's z axis is mirrored, and turns about x and y with it: so a left-handed tracker becomes a
    /// right-handed one.
    Z,
    /// Yaw alone, of a tracker that sends angles.
    Yaw,
    /// Pitch alone, of a tracker that sends angles.
    Pitch,
    /// Roll alone, of a tracker that sends angles.
    Roll,
}

impl FlipAxis {
    /// Index of the axis that is mirrored; `None` for a single angle.
    fn axis(self) -> Option<usize> {
        match self {
            Self::X => Some(0),
            Self::Y => Some(1),
            Self::Z => Some(2),
            Self::Yaw | Self::Pitch | Self::Roll => None,
        }
    }

    /// True if this is a single angle, which only a tracker that sends angles has.
    pub(super) fn is_angle(self) -> bool {
        self.axis().is_none()
    }
}

/// Pose seen in mirrors: place M p and turn M R M, where M changes the sign of each axis among `flips`.
///
/// *Equation:* a mirror takes the axis n and the angle φ of a turn to M n and −φ. A quaternion with the vector part v
/// becomes one with −M v.
pub(super) fn mirrored(flips: &[FlipAxis], place: DVec3, turn: DQuat) -> (DVec3, DQuat) {
    let (mut place, mut turn) = (place.to_array(), turn.to_array());
    for axis in flips.iter().filter_map(|flip| flip.axis()) {
        place[axis] = -place[axis];
        (0..3).filter(|other| *other != axis).for_each(|other| turn[other] = -turn[other]);
    }
    (DVec3::from_array(place), DQuat::from_array(turn))
}

#[cfg(test)]
mod tests {
    //! Law: a mirrored pose is the mirror's image of the pose, M R M; a turn that keeps its sign would send the head
    //! the other way.
    use super::*;
    use glam::DMat3;

    #[test]
    fn a_mirrored_turn_is_the_turn_between_two_mirrors() {
        let turn = DQuat::from_xyzw(0.1, -0.5, 0.7, 0.5).normalize();
        let place = DVec3::new(1.0, 2.0, 3.0);
        for (flips, signs) in [
            (&[FlipAxis::X][..], DVec3::new(-1.0, 1.0, 1.0)),
            (&[FlipAxis::Y], DVec3::new(1.0, -1.0, 1.0)),
            (&[FlipAxis::Z], DVec3::new(1.0, 1.0, -1.0)),
            (&[FlipAxis::X, FlipAxis::Z], DVec3::new(-1.0, 1.0, -1.0)),
            (&[FlipAxis::Yaw], DVec3::ONE),
        ] {
            let mirror = DMat3::from_diagonal(signs);
            let (seen, turned) = mirrored(flips, place, turn);
            assert_eq!(seen, mirror * place);
            let difference = DMat3::from_quat(turned) - mirror * DMat3::from_quat(turn) * mirror;
            assert!(difference.to_cols_array().iter().all(|entry| entry.abs() < 1e-15), "{flips:?}: {difference}");
        }
    }
}
