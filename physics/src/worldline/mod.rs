//! Worldlines: how a vehicle that is pushed and turned moves through spacetime, on its own clock.
//!
//! # The equations
//!
//! The state at proper time τ is an event (ct, x), a celerity u and an orientation q; the pilot's tetrad is B(u) R(q),
//! the boost from rest to u after the rotation of the pilot's axes into the axes of that boost. With a the proper
//! acceleration turned by q and ω the turn rate likewise,
//!
//! ```text
//! dct/dτ = γ      dx/dτ = u      du/dτ = a + u (u·a)/(1 + γ)      dR/dτ = ((a × u)/(1 + γ) + ω) × R
//! ```
//!
//! (W 4.7, in celerity.) The term (a × u)/(1 + γ) is Thomas precession: with ω = 0 the axes are those of
//! gyroscopes, carried along by Fermi–Walker transport. γ is always √(1 + u²); a γ integrated as a fifth variable
//! drifts off the mass shell.
//!
//! # Integrators
//!
//! | integrator | for |
//! |---|---|
//! | [`Rk4`] | the default: fourth order, a fixed cost a step |
//! | [`Exact`] | no error but rounding while thrust and turn rate are constant in the pilot's axes |
//! | [`DormandPrince`] | a tolerance instead of a step: controls that vary by an unknown amount |
//!
//! All answer the same trait, so their cost and error can be compared (`tests/worldline.rs`, `benches/worldline.rs`).
//! Each step ends in a finite state or in an error; event and clock carry what rounding left over, so that a billion
//! steps of coasting go as far as one. The exact steps carry it in celerity and orientation too: a rounding of either
//! shifts the frame in which a circle closes by γ² as much.

mod control;
mod dormand_prince;
mod error;
mod exact;
mod rk4;
mod rotation;
mod runge_kutta;
mod state;
mod transport;

pub use control::{Control, Thrust};
pub use dormand_prince::DormandPrince;
pub use error::WorldlineError;
pub use exact::Exact;
pub use rk4::Rk4;
pub use state::State;
pub use transport::{FacingMotion, Transport};

/// A way to take a step along a worldline.
pub trait Integrator {
    /// The state a proper time `step` (metres, of either sign) after `state`.
    ///
    /// # Errors
    ///
    /// The step or a thrust asked of `control` is not finite, the result would overflow, or the integrator does not
    /// reach its tolerance.
    fn step(&self, state: &State, step: f64, control: &dyn Control) -> Result<State, WorldlineError>;
}

/// The most steps that [`travel`] takes in one call.
pub const MOST_STEPS: f64 = 1e9;

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
/// use physics::{glam::DVec3, worldline::{Exact, State, Thrust, travel}};
/// let thrust = Thrust { acceleration: DVec3::NEG_Z, turn_rate: DVec3::ZERO };
/// let end = travel(&Exact, &State::default(), 1.0, 1.0 / 240.0, &thrust)?;
/// assert!((end.celerity.rapidity() - 1.0).abs() < 1e-14);
/// # Ok::<(), physics::worldline::WorldlineError>(())
/// ```
pub fn travel(
    integrator: &dyn Integrator,
    start: &State,
    duration: f64,
    longest_step: f64,
    control: &dyn Control,
) -> Result<State, WorldlineError> {
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
