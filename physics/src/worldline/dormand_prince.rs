//! The method of Dormand and Prince, order 5 with an embedded order 4, as an adaptive integrator (DOPRI5).
//!
//! Each step asked for is cut into as many as the tolerance needs. The difference of the two orders estimates the
//! error of the lower one; the result of the higher one is kept. The last stage is the first of the next step.
//! Coefficients: J. R. Dormand, P. J. Prince, "A family of embedded Runge–Kutta formulae", J. Comp. Appl. Math. 6
//! (1980); step control: E. Hairer et al., *Solving Ordinary Differential Equations I*, II.4.

use super::control::Control;
use super::error::WorldlineError;
use super::integrator::Integrator;
use super::limits::LEAST_TOLERANCE;
use super::runge_kutta::{Rates, Tableau};
use super::state::WorldlineState;

/// An integrator that chooses its own steps.
#[derive(Clone, Copy, Debug)]
pub struct DormandPrince {
    tolerance: f64,
    most_trials: usize,
}

const TABLEAU: Tableau<7> = Tableau {
    nodes: [0.0, 1.0 / 5.0, 3.0 / 10.0, 4.0 / 5.0, 8.0 / 9.0, 1.0, 1.0],
    stages: [
        [0.0; 7],
        [1.0 / 5.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        [3.0 / 40.0, 9.0 / 40.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        [44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0, 0.0, 0.0, 0.0, 0.0],
        [19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0, 0.0, 0.0, 0.0],
        [9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0, -5103.0 / 18656.0, 0.0, 0.0],
        WEIGHTS,
    ],
};

/// Weights of order 5, also the last row of the tableau.
const WEIGHTS: [f64; 7] = [35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0, 0.0];

/// Weights of order 5 less those of order 4.
const ERROR_WEIGHTS: [f64; 7] =
    [71.0 / 57600.0, 0.0, -71.0 / 16695.0, 71.0 / 1920.0, -17253.0 / 339200.0, 22.0 / 525.0, -1.0 / 40.0];

/// Largest number of trials, taken or rejected, before a step is given up: more than any control that is worth
/// following needs.
const MOST_TRIALS: usize = 100_000;

impl DormandPrince {
    /// The smallest tolerance accepted: rounding hides errors below it.
    pub const LEAST_TOLERANCE: f64 = LEAST_TOLERANCE;

    /// An integrator with this error allowed per inner step: in rapidity, in radians, and in time and way as shares of
    /// those of the step.
    ///
    /// # Errors
    ///
    /// The tolerance is below [`DormandPrince::LEAST_TOLERANCE`], above 1, or not a number.
    pub fn new(tolerance: f64) -> Result<Self, WorldlineError> {
        if (Self::LEAST_TOLERANCE..=1.0).contains(&tolerance) {
            Ok(Self { tolerance, ..Self::default() })
        } else {
            Err(WorldlineError::Tolerance { tolerance })
        }
    }

    /// The same integrator that gives a step up after this number of trials, taken or rejected, instead of 100 000.
    #[must_use]
    pub fn with_most_trials(self, most_trials: usize) -> Self {
        Self { most_trials, ..self }
    }
}

impl Default for DormandPrince {
    /// A tolerance of 1e-8.
    fn default() -> Self {
        Self { tolerance: 1e-8, most_trials: MOST_TRIALS }
    }
}

impl Integrator for DormandPrince {
    fn step(&self, state: &WorldlineState, step: f64, control: &dyn Control) -> Result<WorldlineState, WorldlineError> {
        if !step.is_finite() {
            return Err(WorldlineError::StepNotFinite { step });
        }
        let mut state = *state;
        let mut first = Rates::of(&state, control)?;
        let (mut remaining, mut trial) = (step, step);
        for _ in 0..self.most_trials {
            let error = match self.attempt(&state, trial, step, first, control) {
                Ok(attempt) => {
                    if attempt.error <= 1.0 {
                        if trial == remaining {
                            return Ok(attempt.end);
                        }
                        (state, first) = (attempt.end, attempt.last);
                        remaining -= trial;
                    }
                    attempt.error
                }
                // Too long a trial may overflow where shorter ones do not.
                Err(WorldlineError::Overflow { .. }) => f64::INFINITY,
                Err(error) => return Err(error),
            };
            // Choose the next trial: the error grows with the fifth power of the step. Aim a little lower, and change
            // by no more than five times.
            trial *= (0.9 * libm::pow(error, -0.2)).clamp(0.2, 5.0);
            if trial.abs() >= remaining.abs() {
                trial = remaining;
            } else if trial.abs() < f64::EPSILON * step.abs() {
                if error.is_infinite() {
                    return Err(WorldlineError::Overflow { proper_time: state.proper_time, step: remaining });
                }
                break;
            }
        }
        Err(WorldlineError::NotConverged { proper_time: state.proper_time, remaining, tolerance: self.tolerance })
    }
}

/// An inner step that may or may not be taken.
struct Attempt {
    /// Largest error as a share of the tolerance.
    error: f64,
    end: WorldlineState,
    /// Rates at the end of the step.
    last: Rates,
}

impl DormandPrince {
    /// Tries one inner step of the step asked for.
    fn attempt(
        &self,
        state: &WorldlineState,
        trial: f64,
        step: f64,
        first: Rates,
        control: &dyn Control,
    ) -> Result<Attempt, WorldlineError> {
        let rates = TABLEAU.rates(state, trial, first, control)?;
        let end = Rates::weighted(&WEIGHTS, &rates).applied(state, trial)?;
        let difference = Rates::weighted(&ERROR_WEIGHTS, &rates);
        let gamma = state.celerity.gamma().max(end.celerity.gamma());
        let share = (trial / step).abs();
        let error = [
            difference.celerity.length() / gamma * trial.abs(),
            2.0 * difference.orientation.length() * trial.abs(),
            difference.ct.abs() / gamma * share,
            difference.position.length() / gamma * share,
        ];
        let largest = error.into_iter().fold(0.0, f64::max);
        Ok(Attempt { error: largest / self.tolerance, end, last: rates[6] })
    }
}
