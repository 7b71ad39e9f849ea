//! A point of a worldline, and how an increment is added to it without losing what rounding drops.

use glam::{DQuat, DVec3};

use super::WorldlineError;
use crate::double_double::DoubleDouble;
use crate::{Celerity, Event, Observer};

/// Where a vehicle is in spacetime, how fast it moves, and how it is turned.
///
/// The fields may be set at will (a wall, a cap); the orientation has to stay a unit quaternion.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct State {
    /// τ, the time on the vehicle's own clock, metres.
    pub proper_time: f64,
    /// ct in the world, metres.
    pub ct: f64,
    /// Place in the world, metres.
    pub position: DVec3,
    /// Celerity in the world.
    pub celerity: Celerity,
    /// Rotation from the pilot's axes to the axes of the pure boost from the world.
    pub orientation: DQuat,
    /// What the sums in `proper_time`, `ct` and `position` have lost to rounding.
    remainder: Remainder,
}

#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Remainder {
    proper_time: f64,
    ct: f64,
    position: DVec3,
}

/// What a step adds to a state.
pub(super) struct Increment {
    pub(super) ct: f64,
    pub(super) position: DVec3,
    /// The new celerity, not a difference.
    pub(super) celerity: DVec3,
    /// The new orientation; its length is corrected.
    pub(super) orientation: DQuat,
}

impl State {
    /// A vehicle at an event, its own clock at zero.
    pub fn new(event: Event, celerity: Celerity, orientation: DQuat) -> Self {
        let Event { ct, position } = event;
        Self { ct, position, celerity, orientation, ..Self::default() }
    }

    /// The event.
    pub fn event(&self) -> Event {
        Event { ct: self.ct, position: self.position }
    }

    /// Someone who rests in the vehicle's reference point.
    pub fn observer(&self) -> Observer {
        Observer { event: self.event(), celerity: self.celerity }
    }

    /// The state after a step, if it is finite.
    pub(super) fn advanced(&self, step: f64, increment: &Increment) -> Result<Self, WorldlineError> {
        let overflow = WorldlineError::Overflow { proper_time: self.proper_time, step };
        let celerity = Celerity::new(increment.celerity).map_err(|_| overflow)?;
        let orientation = unit_quaternion(increment.orientation).ok_or(overflow)?;
        let (proper_time, lost_proper_time) = sum(self.proper_time, self.remainder.proper_time, step);
        let (ct, lost_ct) = sum(self.ct, self.remainder.ct, increment.ct);
        let [x, y, z] = [0, 1, 2].map(|i| sum(self.position[i], self.remainder.position[i], increment.position[i]));
        let position = DVec3::new(x.0, y.0, z.0);
        if !(proper_time.is_finite() && ct.is_finite() && position.is_finite()) {
            return Err(overflow);
        }
        let lost_position = DVec3::new(x.1, y.1, z.1);
        let remainder = Remainder { proper_time: lost_proper_time, ct: lost_ct, position: lost_position };
        Ok(Self { proper_time, ct, position, celerity, orientation, remainder })
    }
}

/// `total` plus an increment and what earlier sums lost, and what this sum loses.
fn sum(total: f64, lost: f64, increment: f64) -> (f64, f64) {
    let sum = DoubleDouble::sum(total, increment + lost);
    (sum.high, sum.low)
}

/// The quaternion at length 1; untouched, to the bit, where it is that long already.
fn unit_quaternion(quaternion: DQuat) -> Option<DQuat> {
    const ROUNDING: f64 = 4.0 * f64::EPSILON;
    let squared = quaternion.length_squared();
    if (squared - 1.0).abs() <= ROUNDING {
        Some(quaternion)
    } else {
        (squared.is_normal()).then(|| quaternion * squared.sqrt().recip())
    }
}
