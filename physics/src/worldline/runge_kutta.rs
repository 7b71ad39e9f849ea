//! Explicit Runge–Kutta steps: the right-hand side of the worldline's equations, and the stages of any tableau.
//!
//! The small functions are marked for inlining because a step is little more than calls to them: a third of its time
//! (`benches/worldline.rs`).

use glam::{DQuat, DVec3};

use super::control::{Control, finite_thrust};
use super::error::WorldlineError;
use super::state::{Increment, LowParts, WorldlineState};

/// Rates of change with proper time.
#[derive(Clone, Copy, Default)]
pub(super) struct Rates {
    pub(super) ct: f64,
    pub(super) position: DVec3,
    pub(super) celerity: DVec3,
    /// Rates of the quaternion's four components.
    pub(super) orientation: DQuat,
}

impl Rates {
    /// Rates by the equations at the head of [`super`].
    #[inline]
    pub(super) fn of(state: &WorldlineState, control: &dyn Control) -> Result<Self, WorldlineError> {
        let thrust = finite_thrust(control, state)?;
        let (u, gamma) = (state.celerity.vector(), state.celerity.gamma());
        let acceleration = state.orientation * thrust.acceleration;
        let thomas = acceleration.cross(u) / (1.0 + gamma);
        let rotation = 0.5 * (thomas + state.orientation * thrust.turn_rate);
        Ok(Self {
            ct: gamma,
            position: u,
            celerity: acceleration + u * (u.dot(acceleration) / (1.0 + gamma)),
            orientation: DQuat::from_xyzw(rotation.x, rotation.y, rotation.z, 0.0) * state.orientation,
        })
    }

    /// Sum of `weights` times `rates`.
    #[inline]
    pub(super) fn weighted<const N: usize>(weights: &[f64; N], rates: &[Self; N]) -> Self {
        let mut sum = Self { orientation: DQuat::from_xyzw(0.0, 0.0, 0.0, 0.0), ..Self::default() };
        for (&weight, rate) in weights.iter().zip(rates).filter(|(weight, _)| **weight != 0.0) {
            sum.ct += weight * rate.ct;
            sum.position += weight * rate.position;
            sum.celerity += weight * rate.celerity;
            sum.orientation += rate.orientation * weight;
        }
        sum
    }

    /// The state that these rates lead to in a proper time `span`.
    pub(super) fn applied(&self, state: &WorldlineState, span: f64) -> Result<WorldlineState, WorldlineError> {
        state.advanced(span, &self.increment(state, span))
    }

    fn increment(&self, state: &WorldlineState, span: f64) -> Increment {
        Increment {
            ct: span * self.ct,
            position: span * self.position,
            celerity: state.celerity.vector() + span * self.celerity,
            orientation: state.orientation + self.orientation * span,
            rest: LowParts::default(),
        }
    }
}

/// The coefficients of an explicit method of N stages.
pub(super) struct Tableau<const N: usize> {
    /// Nodes c of the stages, as shares of the step.
    pub(super) nodes: [f64; N],
    /// Weights of the earlier stages, row i for stage i.
    pub(super) stages: [[f64; N]; N],
}

impl<const N: usize> Tableau<N> {
    /// Rates at all stages, the first of them given.
    #[inline]
    pub(super) fn rates(
        &self,
        state: &WorldlineState,
        step: f64,
        first: Rates,
        control: &dyn Control,
    ) -> Result<[Rates; N], WorldlineError> {
        let mut rates = [first; N];
        for stage in 1..N {
            let increment = Rates::weighted(&self.stages[stage], &rates).increment(state, step);
            let at = state.staged(step * self.nodes[stage], &increment)?;
            rates[stage] = Rates::of(&at, control)?;
        }
        Ok(rates)
    }
}
