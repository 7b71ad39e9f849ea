//! A journey along a worldline, cut into equal steps.

use super::control::Control;
use super::error::WorldlineError;
use super::integrator::Integrator;
use super::limits::MOST_STEPS;
use super::state::WorldlineState;

/// Follows a worldline for a proper time `duration` in equal steps, as few as are none longer than `longest_step`.
///
/// # Errors
///
/// `duration` is negative or `longest_step` not positive, either is not finite, they ask for more than [`MOST_STEPS`],
/// or a step fails.
///
/// # Example
///
/// One unit of proper time at unit acceleration is one of rapidity.
///
/// ```
/// use physics::{glam::DVec3, worldline::{Exact, WorldlineState, Thrust, travel}};
/// let thrust = Thrust { acceleration: DVec3::NEG_Z, turn_rate: DVec3::ZERO };
/// let end = travel(&Exact, &WorldlineState::default(), 1.0, 1.0 / 240.0, &thrust)?;
/// assert!((end.celerity.rapidity() - 1.0).abs() < 1e-14);
/// # Ok::<(), physics::worldline::WorldlineError>(())
/// ```
pub fn travel(
    integrator: &dyn Integrator,
    start: &WorldlineState,
    duration: f64,
    longest_step: f64,
    control: &dyn Control,
) -> Result<WorldlineState, WorldlineError> {
    /// A quotient this little above a whole number is that number.
    const ROUNDING: f64 = 1e-9;
    let valid = duration.is_finite() && duration >= 0.0 && longest_step.is_finite() && longest_step > 0.0;
    if !valid {
        return Err(WorldlineError::Duration { duration, longest_step });
    }
    let steps = (duration / longest_step * (1.0 - ROUNDING)).ceil();
    if steps > MOST_STEPS {
        return Err(WorldlineError::TooManySteps { duration, longest_step });
    }
    let mut state = *start;
    for _ in 0..steps as u64 {
        state = integrator.step(&state, duration / steps, control)?;
    }
    Ok(state)
}
