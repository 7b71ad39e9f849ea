//! Worldlines: the motion of a vehicle under thrust and turn, on its own clock.
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
//! The integrators share one trait, so that their cost and error can be compared (`tests/physics/worldline.rs`,
//! `benches/worldline.rs`). Each step ends in a finite state or in an error. Event and clock carry what rounding left
//! over, so that a billion steps of coasting go as far as one. The exact steps carry it in celerity and orientation
//! too: a rounding of either shifts the frame in which a circle closes by γ² as much.

mod control;
mod dormand_prince;
mod error;
mod exact;
mod integrator;
mod limits;
mod rk4;
mod rotation;
mod runge_kutta;
mod state;
mod thrust;
mod transport;
mod travel;

pub use control::Control;
pub use dormand_prince::DormandPrince;
pub use error::WorldlineError;
pub use exact::Exact;
pub use integrator::Integrator;
pub use limits::MOST_STEPS;
pub use rk4::Rk4;
pub use state::WorldlineState;
pub use thrust::Thrust;
pub use transport::{FacingMotion, Transport};
pub use travel::travel;
