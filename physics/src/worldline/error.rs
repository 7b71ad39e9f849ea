//! The errors of a step or a journey along a worldline.

use thiserror::Error;

use super::limits::{LEAST_TOLERANCE, MOST_STEPS};
use super::thrust::Thrust;
use crate::celerity::Celerity;

/// The reasons why a step was not taken. The state before it is still good.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum WorldlineError {
    /// A step that is infinite or not a number.
    #[error("a step of proper time must be finite, not {step}")]
    StepNotFinite {
        /// The step asked for, metres.
        step: f64,
    },
    /// A thrust asked for by the control that is infinite or not a number.
    #[error(
        "the control asked for an acceleration of {} and a turn rate of {} at proper time {proper_time} m; both must be finite",
        thrust.acceleration, thrust.turn_rate
    )]
    ThrustNotFinite {
        /// Thrust that the control asked for.
        thrust: Thrust,
        /// Proper time at that moment, metres.
        proper_time: f64,
    },
    /// A celerity, position or time beyond the range that is computed.
    #[error(
        "a step of {step} m from proper time {proper_time} m leads beyond what can be computed (celerities to {limit:e}); \
         take shorter steps, thrust less, or cap the rapidity",
        limit = Celerity::LIMIT
    )]
    Overflow {
        /// Proper time at the start of the step, metres.
        proper_time: f64,
        /// Length of the step, metres of proper time.
        step: f64,
    },
    /// An adaptive integrator that cannot reach its tolerance.
    #[error(
        "from proper time {proper_time} m the next {remaining} m do not converge to a tolerance of {tolerance:e}; \
         loosen it, or make the control vary less abruptly"
    )]
    NotConverged {
        /// Proper time reached, metres.
        proper_time: f64,
        /// Rest of the step, metres of proper time.
        remaining: f64,
        /// Tolerance asked for.
        tolerance: f64,
    },
    /// A tolerance that cannot be met.
    #[error("a tolerance must lie between {least:e} and 1, not {tolerance}", least = LEAST_TOLERANCE)]
    Tolerance {
        /// The tolerance asked for.
        tolerance: f64,
    },
    /// A journey of no sensible length.
    #[error(
        "a journey needs a finite duration of 0 or more and a finite step above 0, not {duration} and {longest_step}"
    )]
    Duration {
        /// The duration asked for, metres of proper time.
        duration: f64,
        /// The longest step asked for, metres of proper time.
        longest_step: f64,
    },
    /// A journey of too many steps.
    #[error("{duration} m in steps of {longest_step} m is more than {MOST_STEPS:e} steps; take longer ones")]
    TooManySteps {
        /// The duration asked for, metres of proper time.
        duration: f64,
        /// The longest step asked for, metres of proper time.
        longest_step: f64,
    },
}
