//! Integration of the vehicle's worldline by the integrator of its settings.

use physics::worldline::{Control, DormandPrince, Exact, Integrator, Rk4, Thrust, WorldlineError, WorldlineState};

use super::notice::{Notice, RAPIDITY_CAP};
use super::settings::IntegratorKind;
use super::vehicle::Vehicle;

/// Largest change of the rapidity, plus turn in radians, within a step of RK4: about that of the row of RK4 in
/// ACCURACY.md. The error of a journey grows with its fourth power.
const LARGEST_CHANGE: f64 = 0.005;
/// Largest number of parts of one step.
const MOST_PARTS: f64 = 64.0;
/// Largest change of that kind for which the exact method is asked. It needs two parts for each unit: beyond, a step
/// takes it longer than the step lasts, and the ride comes to a stand.
const LARGEST_EXACT_CHANGE: f64 = 1000.0;
/// Largest number of trials that DOPRI5 may take for a step: more of them, too, take longer than the step lasts.
const MOST_TRIALS: usize = 1000;

impl Vehicle {
    /// Integrates the worldline, caps the rapidity, and advances the odometer.
    pub(super) fn integrate(&mut self, own_s: f64, control: &dyn Control) {
        let before = self.state.celerity;
        let step = self.light_speed.metres(own_s);
        let keeps_time = self.settings.keeps_time;
        let taken = match self.settings.integrator {
            IntegratorKind::Rk4 => self.in_short_steps(step, control),
            IntegratorKind::Exact if keeps_time && self.change(step, control) > LARGEST_EXACT_CHANGE => {
                self.tell(Notice::TakenByRk4);
                self.in_short_steps(step, control)
            }
            IntegratorKind::Exact => Exact.step(&self.state, step, control),
            IntegratorKind::DormandPrince => {
                let adaptive = DormandPrince::default();
                let adaptive = if keeps_time { adaptive.with_most_trials(MOST_TRIALS) } else { adaptive };
                adaptive.step(&self.state, step, control)
            }
        };
        let taken = taken.or_else(|_| {
            self.tell(Notice::TakenByRk4);
            Rk4.step(&self.state, step, control)
        });
        match taken {
            Ok(state) => self.state = state,
            Err(_) => return self.tell(Notice::NotIntegrated),
        }
        self.thrust = control.thrust(&self.state);
        let capped = self.state.celerity.capped(RAPIDITY_CAP);
        if capped != self.state.celerity {
            self.state.celerity = capped;
            self.tell(Notice::RapidityCapped);
        }
        self.odometer.count(self.light_speed, own_s, before, self.state.celerity);
    }

    /// State after a step by RK4, in parts in which the rapidity changes by [`LARGEST_CHANGE`] at most, while thrust
    /// and turn stay what they are now.
    fn in_short_steps(&self, step: f64, control: &dyn Control) -> Result<WorldlineState, WorldlineError> {
        let change = self.change(step, control);
        if change <= LARGEST_CHANGE || !change.is_finite() {
            return Rk4.step(&self.state, step, control);
        }
        let parts = (change / LARGEST_CHANGE).ceil().min(MOST_PARTS);
        (0..parts as usize).try_fold(self.state, |state, _| Rk4.step(&state, step / parts, control))
    }

    /// Change of the rapidity, plus turn in radians, in a step with the thrust and turn of now.
    fn change(&self, step: f64, control: &dyn Control) -> f64 {
        let Thrust { acceleration, turn_rate } = control.thrust(&self.state);
        (acceleration.length() + turn_rate.length()) * step
    }
}
