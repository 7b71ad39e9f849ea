//! Errors of a question; the sentence of the error is given as the answer.

use std::str::Utf8Error;

use physics::CelerityError;
use physics::colour::SpectrumError;
use physics::eyes::EyesError;
use physics::stereo_perception::StereoPerceptionError;
use physics::worldline::WorldlineError;
use thiserror::Error;

use crate::limits::{LONGEST_LINE, MOST_STEPS};

/// Reason for which a line has no answer. Keys are given with their path, as in `observer.position` or
/// `legs[2].duration`.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum ProbeError {
    /// A line of more than [`LONGEST_LINE`] bytes.
    #[error("the line is too long: expected at most {LONGEST_LINE} bytes")]
    TooLong,
    /// A line that is not text.
    #[error("the line is not text: expected UTF-8 ({0})")]
    NotUtf8(#[from] Utf8Error),
    /// A line that is not JSON, or has a number that no f64 can hold.
    #[error(
        "the line cannot be read: {reason} in column {column}, at the end of `{near}`: expected one JSON object a line, \
         its numbers within 1.7e308, its brackets a hundred deep at most"
    )]
    NotJson {
        /// Reason given by the parser.
        reason: String,
        /// Column where the parser stopped, counted in bytes from 1.
        column: usize,
        /// Text before that column.
        near: String,
    },
    /// A line of JSON that is not an object.
    #[error("the line is {found}: expected an object with the key \"ask\"")]
    NotAnObject {
        /// Description of the value found.
        found: String,
    },
    /// A missing key that the question needs.
    #[error("`{key}` is missing: expected {expected}")]
    Missing {
        /// Path of the key.
        key: String,
        /// Value that the key should hold.
        expected: &'static str,
    },
    /// A key that the question does not have.
    #[error("`{key}` is unknown here: expected no other keys than {known}")]
    Unknown {
        /// Path of the key.
        key: String,
        /// Names of the keys that are allowed there.
        known: String,
    },
    /// A key twice in one object.
    #[error("`{key}` is given more than once: expected each key once")]
    Doubled {
        /// Path of the key.
        key: String,
    },
    /// A value of another kind, or out of range.
    #[error("`{key}` is {found}: expected {expected}")]
    Wrong {
        /// Path of the key.
        key: String,
        /// Description of the value found.
        found: String,
        /// Description of the value expected.
        expected: &'static str,
    },
    /// Two velocities: both `celerity` and `beta`.
    #[error("`{celerity}` and `{beta}` are both given: expected one of them")]
    TwoVelocities {
        /// Path of `celerity`.
        celerity: String,
        /// Path of `beta`.
        beta: String,
    },
    /// A value that is not a velocity.
    #[error("`{key}` is no velocity: {reason}")]
    Velocity {
        /// Path of the key.
        key: String,
        /// Reason given by the physics.
        reason: CelerityError,
    },
    /// A value that is not a spectrum.
    #[error("`{key}` is no spectrum: {reason}")]
    Spectrum {
        /// Path of the key.
        key: String,
        /// Reason given by the physics.
        reason: SpectrumError,
    },
    /// A worldline of too many steps.
    #[error("`legs` take {steps:.0} steps of `step` in all: expected at most {MOST_STEPS:.0}")]
    TooManySteps {
        /// Number of steps.
        steps: f64,
    },
    /// A pair of eyes that is not possible.
    #[error(transparent)]
    Eyes(#[from] EyesError),
    /// Two sight lines without a perceived point.
    #[error(transparent)]
    Perceived(#[from] StereoPerceptionError),
    /// A worldline that leads beyond what is computed.
    #[error("leg {leg} of `legs` fails: {reason}")]
    Worldline {
        /// Index of the leg, from 0.
        leg: usize,
        /// Reason given by the physics.
        reason: WorldlineError,
    },
    /// A result that no f64 can hold.
    #[error("the answer's `{key}` is beyond the range of 64-bit numbers: expected a question with smaller numbers")]
    NotFinite {
        /// Key of the answer.
        key: &'static str,
    },
}
