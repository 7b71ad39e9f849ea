//! The classical Runge–Kutta method of fourth order, in proper time.

use super::control::Control;
use super::error::WorldlineError;
use super::integrator::Integrator;
use super::runge_kutta::{Rates, Tableau};
use super::state::WorldlineState;

/// Integrator of fourth order at a fixed cost of four thrusts a step; the default.
///
/// *Accuracy:* at 10 units of rapidity per unit of proper time the rapidity is off by 6e-5 in 60 steps, 3e-7 in 240
/// (`tests/physics/worldline.rs`). The error grows with the fifth power of the step, the thrust and the turn rate.
#[derive(Clone, Copy, Debug, Default)]
pub struct Rk4;

const TABLEAU: Tableau<4> = Tableau {
    nodes: [0.0, 0.5, 0.5, 1.0],
    stages: [[0.0; 4], [0.5, 0.0, 0.0, 0.0], [0.0, 0.5, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]],
};

const WEIGHTS: [f64; 4] = [1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0];

impl Integrator for Rk4 {
    fn step(&self, state: &WorldlineState, step: f64, control: &dyn Control) -> Result<WorldlineState, WorldlineError> {
        if !step.is_finite() {
            return Err(WorldlineError::StepNotFinite { step });
        }
        let first = Rates::of(state, control)?;
        let rates = TABLEAU.rates(state, step, first, control)?;
        Rates::weighted(&WEIGHTS, &rates).applied(state, step)
    }
}
