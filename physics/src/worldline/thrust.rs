//! Thrust and turn rate of a vehicle at one instant, and what they do to whoever is on board.
//!
//! A rigid vehicle that turns carries its points along: in the frame in which its reference point rests now, a point at
//! r moves at β = ω × r / (1 + a·r), since time at r runs 1 + a·r times as fast as at the reference point. A head
//! that moves through the vehicle by u metres of its axes per metre of the head's own time has the celerity
//! U = γβ + u there, with γ² = 1 + U², so γ = (β·u + √((β·u)² + (1 − β²)(1 + u²)))/(1 − β²).

use glam::DVec3;

use crate::celerity::Celerity;

/// Least lapse of time at a place of a vehicle, as a share of that at its reference point. Where it would be less, the
/// place is at a horizon that no rigid vehicle reaches.
const LEAST_LAPSE: f64 = 0.01;

/// Fastest motion that a turn gives a place of a vehicle, in units of c. Beyond lies a place that no rigid vehicle has.
const FASTEST_TURN: f64 = 0.999;

/// Motion below which a turn is the rounding of none, in units of c.
const NO_TURN: f64 = 1e-12;

/// Push and turn at one instant, both in the pilot's own axes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Thrust {
    /// Proper acceleration, what an accelerometer on board shows, in units of c² per metre (1/m).
    pub acceleration: DVec3,
    /// Rotation against gyroscopes on board, right-handed, in radians per metre of proper time.
    pub turn_rate: DVec3,
}

impl Thrust {
    /// Celerity of a head that moves in the vehicle, in the frame in which the reference point rests now.
    ///
    /// *Frames, units:* `place` from the reference point, metres, and `celerity`, metres of the vehicle's own axes for
    /// each metre of the head's own time, both in the pilot's axes; so is the result.
    pub fn carried(&self, place: DVec3, celerity: Celerity) -> Celerity {
        let carried = self.turn_rate.cross(place) / self.lapse(place);
        let beta = carried.clamp_length_max(FASTEST_TURN);
        if beta.length() <= NO_TURN || !beta.is_finite() {
            return celerity;
        }
        let u = celerity.vector();
        let (along, rest) = (beta.dot(u), 1.0 - beta.length_squared());
        let gamma = (along + (along * along + rest * (1.0 + u.length_squared())).sqrt()) / rest;
        Celerity::new(gamma * beta + u).unwrap_or(celerity)
    }

    /// Own time of the vehicle's reference point for each unit of own time of a head that moves in the vehicle:
    /// γ/(1 + a·r), of arguments as for [`Thrust::carried`].
    pub fn time_ratio(&self, place: DVec3, celerity: Celerity) -> f64 {
        self.carried(place, celerity).gamma() / self.lapse(place)
    }

    /// Time that passes at `place` while a unit of it passes at the reference point.
    fn lapse(&self, place: DVec3) -> f64 {
        let lapse = 1.0 + self.acceleration.dot(place);
        if lapse.is_finite() { lapse.max(LEAST_LAPSE) } else { 1.0 }
    }
}
