//! Tracked head as the walls take it.

use glam::{DMat3, DVec3};
use input::HeadState;
use physics::Celerity;
use walls::RoomHead;

/// Head as a tracker reports it, in a world whose speed of light is `speed_of_light` m/s.
///
/// A velocity or a turn that is not finite counts as zero.
pub fn head(state: &HeadState, speed_of_light: f64) -> RoomHead {
    let turn_rate = state.turn_rad_s / speed_of_light;
    RoomHead {
        place_m: state.position_m,
        room_from_head: DMat3::from_quat(state.orientation),
        celerity: Celerity::new(state.velocity_m_s / speed_of_light).unwrap_or_default(),
        turn_rate: if turn_rate.is_finite() { turn_rate } else { DVec3::ZERO },
    }
}

#[cfg(test)]
mod tests {
    //! Law under test: a tracked velocity, metres per second of the user, is celerity times the speed of light.
    #![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

    use super::*;
    use glam::DQuat;
    use input::head::Tracking;

    #[test]
    fn a_tracked_velocity_is_celerity_times_c() {
        let state = HeadState {
            position_m: DVec3::new(0.1, 1.7, 0.2),
            orientation: DQuat::from_rotation_y(0.3),
            velocity_m_s: DVec3::new(0.0, 0.0, -6.25),
            turn_rad_s: DVec3::new(0.0, 2.5, 0.0),
            tracked: Tracking::Tracked,
        };
        let head = head(&state, 25.0 / 3.0);
        assert_eq!(head.celerity.vector(), DVec3::new(0.0, 0.0, -0.75)); // β = 0.6
        assert_eq!((head.place_m, head.turn_rate), (state.position_m, DVec3::new(0.0, 0.3, 0.0)));
    }
}
