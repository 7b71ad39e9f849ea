//! The interface that all integrators share.

use super::control::Control;
use super::error::WorldlineError;
use super::state::WorldlineState;

/// A way to take a step along a worldline.
pub trait Integrator {
    /// The state a proper time `step` (metres, of either sign) after `state`.
    ///
    /// # Errors
    ///
    /// The step or a thrust asked of `control` is not finite, the result would overflow, or the integrator does not
    /// reach its tolerance.
    fn step(&self, state: &WorldlineState, step: f64, control: &dyn Control) -> Result<WorldlineState, WorldlineError>;
}
