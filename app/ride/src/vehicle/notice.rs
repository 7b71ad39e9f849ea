//! Notices for the rider during a ride.

use std::fmt;

/// Largest rapidity of a vehicle, γ = 2.7e11. There, a boost and its inverse in f64 are off by |δu| ≈ εγ = 6e-5
/// (NUMERICS).
pub const RAPIDITY_CAP: f64 = 27.0;

/// Deviation of the last step from what was asked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Notice {
    /// The rapidity has reached its cap.
    RapidityCapped,
    /// A control was not a finite number and counted as released.
    ControlsNotFinite,
    /// The chosen integrator failed in a step, and RK4 took the step.
    TakenByRk4,
    /// A step could not be integrated and was not taken.
    NotIntegrated,
    /// The walls are too close for this celerity, so the vehicle was slowed down.
    HeldByWalls,
    /// The speed of light that was asked for is out of range.
    SpeedOfLightRefused,
}

impl fmt::Display for Notice {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::RapidityCapped => write!(formatter, "rapidity capped at {RAPIDITY_CAP}"),
            Self::ControlsNotFinite => write!(formatter, "a control is not a finite number: it counts as let go"),
            Self::TakenByRk4 => write!(formatter, "the chosen integrator gave up on a step: RK4 took it"),
            Self::NotIntegrated => write!(formatter, "a step could not be computed: the vehicle waits"),
            Self::HeldByWalls => write!(formatter, "too fast for these walls: slowed down"),
            Self::SpeedOfLightRefused => write!(formatter, "no world can be computed with such a speed of light"),
        }
    }
}
