//! A point of a worldline, and the addition of increments to it without losing what rounding drops.

use glam::{DQuat, DVec3, DVec4};

use super::error::WorldlineError;
use super::rotation::Rotation;
use super::thrust::Thrust;
use crate::celerity::Celerity;
use crate::composition::{Composition, compose};
use crate::double_double::{DoubleDouble, DoubleDoubleVec3};
use crate::event::Event;
use crate::observer::Observer;

/// Event, celerity and orientation of a vehicle, with its clock.
///
/// The fields may be set at will (a wall, a cap); the orientation has to stay a unit quaternion.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct WorldlineState {
    /// Proper time τ on the vehicle's own clock, metres.
    pub proper_time: f64,
    /// World time ct, metres.
    pub ct: f64,
    /// Position in the world, metres.
    pub position: DVec3,
    /// Celerity, measured in the world.
    pub celerity: Celerity,
    /// Rotation from the pilot's axes to the axes of the pure boost from the world.
    pub orientation: DQuat,
    /// Remainders of the other fields, lost to rounding.
    remainder: Remainder,
}

#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Remainder {
    proper_time: f64,
    ct: f64,
    position: DVec3,
    rest: LowParts,
}

/// The change that a step makes to a state.
pub(super) struct Increment {
    pub(super) ct: f64,
    pub(super) position: DVec3,
    /// New celerity, not a difference.
    pub(super) celerity: DVec3,
    /// New orientation, not a difference; its length is corrected.
    pub(super) orientation: DQuat,
    /// Remainders of the new celerity and orientation, from a step that knows them that well.
    pub(super) rest: LowParts,
}

/// Parts of a celerity and an orientation below the last place of f64.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct LowParts {
    pub(super) celerity: DVec3,
    pub(super) orientation: DVec4,
}

impl WorldlineState {
    /// State of a vehicle at an event, its own clock at zero.
    pub fn new(event: Event, celerity: Celerity, orientation: DQuat) -> Self {
        let Event { ct, position } = event;
        Self { ct, position, celerity, orientation, ..Self::default() }
    }

    /// Event of the vehicle's reference point.
    pub fn event(&self) -> Event {
        Event { ct: self.ct, position: self.position }
    }

    /// The observer who rests in the vehicle's reference point.
    pub fn observer(&self) -> Observer {
        Observer { event: self.event(), celerity: self.celerity }
    }

    /// The observer who rests in the vehicle at `place`, at the same time for the vehicle.
    ///
    /// *Frames, units:* `place` from the vehicle's reference point, in the pilot's axes, metres; the result in the
    /// world. *Equation:* [`Observer::at_offset`].
    pub fn observer_at(&self, place: DVec3) -> Observer {
        self.observer().at_offset(self.orientation * place)
    }

    /// The state of a head that moves within the vehicle, at the same time for the vehicle (W 6.3). A head at rest
    /// in a vehicle that does not turn is [`WorldlineState::observer_at`] with the vehicle's orientation.
    ///
    /// *Frames, units:* `place` from the vehicle's reference point, in metres, and `celerity`, both measured in the
    /// vehicle and in the pilot's axes, which turn as `thrust` says ([`Thrust::carried`]). The orientation turns the
    /// axes of the head, which in the vehicle are the pilot's, into those of the one pure boost from the world to the
    /// head: Wigner's rotation is in it.
    pub fn aboard(&self, place: DVec3, celerity: Celerity, thrust: &Thrust) -> Self {
        let Event { ct, position } = self.observer_at(place).event;
        let celerity = thrust.carried(place, celerity);
        if celerity == Celerity::ZERO {
            let remainder = Remainder { rest: LowParts::default(), ..self.remainder };
            return Self { ct, position, remainder, ..*self };
        }
        let head = Celerity::from_finite(self.orientation * celerity.vector());
        let Composition { celerity, wigner } = compose(self.celerity, head);
        let orientation = wigner.inverse() * self.orientation;
        let remainder = Remainder { rest: LowParts::default(), ..self.remainder };
        Self { ct, position, celerity, orientation, remainder, ..*self }
    }

    /// The celerity to about 106 bits.
    pub(super) fn precise_celerity(&self) -> DoubleDoubleVec3 {
        let (high, low) = (self.celerity.vector(), self.remainder.rest.celerity);
        // A component that was set since keeps nothing of the remainder of its old value.
        DoubleDoubleVec3 { high, low: DVec3::select((high + low).cmpeq(high), low, DVec3::ZERO) }
    }

    /// The orientation to about 106 bits.
    pub(super) fn precise_orientation(&self) -> Rotation {
        let (high, low) = (DVec4::from(self.orientation), self.remainder.rest.orientation);
        let low = DVec4::select((high + low).cmpeq(high), low, DVec4::ZERO);
        Rotation {
            vector: DoubleDoubleVec3 { high: high.truncate(), low: low.truncate() },
            scalar: DoubleDouble { high: high.w, low: low.w },
        }
    }

    /// The state after a step, if it is finite.
    #[inline]
    pub(super) fn advanced(&self, step: f64, increment: &Increment) -> Result<Self, WorldlineError> {
        let lost = self.remainder;
        let proper_time = DoubleDouble::sum(self.proper_time, step + lost.proper_time);
        let ct = DoubleDouble::sum(self.ct, increment.ct + lost.ct);
        let position = DoubleDoubleVec3::sum(self.position, increment.position + lost.position);
        let end = Self {
            proper_time: proper_time.high,
            ct: ct.high,
            position: position.high,
            remainder: Remainder {
                proper_time: proper_time.low,
                ct: ct.low,
                position: position.low,
                rest: increment.rest,
            },
            ..self.turned(step, increment)?
        };
        if end.proper_time.is_finite() && end.ct.is_finite() && end.position.is_finite() {
            Ok(end)
        } else {
            Err(self.overflow(step))
        }
    }

    /// The state within a step, only for asking a control and taking rates there.
    #[inline]
    pub(super) fn staged(&self, span: f64, increment: &Increment) -> Result<Self, WorldlineError> {
        Ok(Self {
            proper_time: self.proper_time + span,
            ct: self.ct + increment.ct,
            position: self.position + increment.position,
            ..self.turned(span, increment)?
        })
    }

    /// The state with the increment's celerity and orientation.
    #[inline]
    fn turned(&self, step: f64, increment: &Increment) -> Result<Self, WorldlineError> {
        let celerity = Celerity::new(increment.celerity).map_err(|_| self.overflow(step))?;
        let orientation = unit_quaternion(increment.orientation).ok_or_else(|| self.overflow(step))?;
        Ok(Self { celerity, orientation, ..*self })
    }

    fn overflow(&self, step: f64) -> WorldlineError {
        WorldlineError::Overflow { proper_time: self.proper_time, step }
    }
}

/// The quaternion at length 1; untouched, to the bit, if it is that long already.
#[inline]
fn unit_quaternion(quaternion: DQuat) -> Option<DQuat> {
    const ROUNDING: f64 = 4.0 * f64::EPSILON;
    let squared = quaternion.length_squared();
    if (squared - 1.0).abs() <= ROUNDING {
        Some(quaternion)
    } else {
        (squared.is_normal()).then(|| quaternion * squared.sqrt().recip())
    }
}
