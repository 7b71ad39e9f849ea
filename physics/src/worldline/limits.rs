//! Limits of what the integrators accept, shared by the integrators and by the messages of their errors.

/// Largest number of steps that [`travel`](super::travel()) takes in one call.
pub const MOST_STEPS: f64 = 1e9;

/// Smallest tolerance that an adaptive integrator accepts: rounding hides errors below it.
pub(super) const LEAST_TOLERANCE: f64 = 1e-14;
