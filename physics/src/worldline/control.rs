//! Controls: thrust and turn rate as the pilot feels them, constant or depending on the state.

use glam::DVec3;

use super::error::WorldlineError;
use super::state::WorldlineState;
use super::thrust::Thrust;

impl Thrust {
    /// Thrust for a push given in the axes of the pure boost from the world to the vehicle's frame, without a turn.
    pub fn in_boost_axes(state: &WorldlineState, acceleration: DVec3) -> Self {
        Self { acceleration: state.orientation.inverse() * acceleration, turn_rate: DVec3::ZERO }
    }
}

/// The thrust as a function of the state; integrators ask for it as often within a step as their order needs.
///
/// A constant [`Thrust`] is a control, and so is any closure from a [`WorldlineState`] to a [`Thrust`].
pub trait Control {
    /// The thrust in this state.
    fn thrust(&self, state: &WorldlineState) -> Thrust;

    /// True if the thrust is the same in every state, which saves [`Exact`](super::Exact) half its work.
    fn is_constant(&self) -> bool {
        false
    }
}

impl Control for Thrust {
    fn thrust(&self, _: &WorldlineState) -> Thrust {
        *self
    }

    fn is_constant(&self) -> bool {
        true
    }
}

impl<F: Fn(&WorldlineState) -> Thrust> Control for F {
    fn thrust(&self, state: &WorldlineState) -> Thrust {
        self(state)
    }
}

/// The thrust that the control asks for, if it is finite.
#[inline]
pub(super) fn finite_thrust(control: &dyn Control, state: &WorldlineState) -> Result<Thrust, WorldlineError> {
    let thrust = control.thrust(state);
    if thrust.acceleration.is_finite() && thrust.turn_rate.is_finite() {
        Ok(thrust)
    } else {
        Err(WorldlineError::ThrustNotFinite { thrust, proper_time: state.proper_time })
    }
}
