//! Eye that rests in the vehicle.

use glam::{DQuat, DVec3};
use physics::worldline::State;
use physics::{FourVector, Observer};

/// Observer at an eye, and the rotation of its axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Eye {
    /// Event and celerity of the eye in the world.
    pub observer: Observer,
    /// Rotation from the pilot's axes (right, up, backward) to those of the pure boost from the world.
    pub orientation: DQuat,
}

impl Eye {
    /// Eye that rests at `offset_m` (pilot's axes) from a vehicle's reference point.
    ///
    /// *Equation:* the eye is simultaneous with the reference point in the vehicle, so its event is the reference
    /// point's plus B(−u)(0, R offset). In the world, the offset is longer by γ along the motion, and the event is
    /// later by u·R offset. A view along the vehicle at one time of the world would show the vehicle contracted
    /// instead.
    pub fn at_rest_in(state: &State, offset_m: DVec3) -> Self {
        let Observer { event, celerity } = state.observer();
        let world_from_vehicle = state.observer().observer_from_world().inverse();
        let displacement = world_from_vehicle.apply(FourVector { t: 0.0, r: state.orientation * offset_m });
        Self { observer: Observer { event: event + displacement, celerity }, orientation: state.orientation }
    }
}

#[cfg(test)]
mod tests {
    //! Law under test: the eye is at its place and time in the vehicle's frame. A program that adds the offset in the
    //! world would be off by γ along the motion.
    use super::*;
    use physics::{Celerity, Event};

    fn eye(celerity: DVec3, orientation: DQuat, offset: DVec3) -> Eye {
        let event = Event { ct: 7.0, position: DVec3::new(1.0, 2.0, 3.0) };
        Eye::at_rest_in(&State::new(event, Celerity::new(celerity).unwrap(), orientation), offset)
    }

    #[test]
    fn an_eye_ahead_is_later_and_farther_by_gamma() {
        let eye = eye(DVec3::new(0.0, 0.0, -0.75), DQuat::IDENTITY, DVec3::new(0.0, 1.5, -1.0));
        assert_eq!(eye.observer.event.position, DVec3::new(1.0, 3.5, 3.0 - 1.25));
        assert_eq!(eye.observer.event.ct, 7.75);
    }

    #[test]
    fn the_offset_turns_with_the_pilot() {
        let quarter_left = DQuat::from_rotation_y(std::f64::consts::FRAC_PI_2);
        let eye = eye(DVec3::ZERO, quarter_left, DVec3::NEG_Z);
        assert!((eye.observer.event.position - DVec3::new(0.0, 2.0, 3.0)).length() < 1e-15);
        assert_eq!(eye.observer.event.ct, 7.0);
    }
}
