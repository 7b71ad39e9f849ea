//! Why a line has no answer, as the sentence with which it is answered instead.

use std::str::Utf8Error;

use physics::CelerityError;
use physics::colour::SpectrumError;
use physics::eyes::EyesError;
use physics::perceived::PerceivedError;
use physics::worldline::WorldlineError;
use thiserror::Error;

use super::{LONGEST_LINE, MOST_STEPS};

/// Why a line has no answer. Keys are given with their path, as in `observer.position` or `legs[2].duration`.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum ProbeError {
    /// More than [`LONGEST_LINE`] bytes.
    #[error("the line is too long: expected at most {LONGEST_LINE} bytes")]
    TooLong,
    /// Not text.
    #[error("the line is not text: expected UTF-8 ({0})")]
    NotUtf8(#[from] Utf8Error),
    /// Not JSON, or a number that no f64 can hold.
    #[error(
        "the line cannot be read: {reason} in column {column}, at the end of `{near}`: expected one JSON object a line, \
         its numbers within 1.7e308, its brackets a hundred deep at most"
    )]
    NotJson {
        /// As the parser says it.
        reason: String,
        /// Where it stopped, counted in bytes from 1.
        column: usize,
        /// The text before that.
        near: String,
    },
    /// JSON, but no question.
    #[error("the line is {found}: expected an object with the key \"ask\"")]
    NotAnObject {
        /// What is there.
        found: String,
    },
    /// A key that the question needs is not there.
    #[error("`{key}` is missing: expected {expected}")]
    Missing {
        /// Its path.
        key: String,
        /// What it should hold.
        expected: &'static str,
    },
    /// A key that the question does not have.
    #[error("`{key}` is unknown here: expected no other keys than {known}")]
    Unknown {
        /// Its path.
        key: String,
        /// All that may stand there.
        known: String,
    },
    /// A key twice in one object.
    #[error("`{key}` is given more than once: expected each key once")]
    Doubled {
        /// Its path.
        key: String,
    },
    /// A value of another kind, or out of range.
    #[error("`{key}` is {found}: expected {expected}")]
    Wrong {
        /// Its path.
        key: String,
        /// What is there.
        found: String,
        /// What should be.
        expected: &'static str,
    },
    /// Both `celerity` and `beta`.
    #[error("`{celerity}` and `{beta}` are both given: expected one of them")]
    TwoVelocities {
        /// Path of the one.
        celerity: String,
        /// Path of the other.
        beta: String,
    },
    /// Not a velocity.
    #[error("`{key}` is no velocity: {reason}")]
    Velocity {
        /// Its path.
        key: String,
        /// What was expected.
        reason: CelerityError,
    },
    /// Not a spectrum.
    #[error("`{key}` is no spectrum: {reason}")]
    Spectrum {
        /// Its path.
        key: String,
        /// What was expected.
        reason: SpectrumError,
    },
    /// A worldline of too many steps.
    #[error("`legs` take {steps:.0} steps of `step` in all: expected at most {MOST_STEPS:.0}")]
    TooManySteps {
        /// How many.
        steps: f64,
    },
    /// No pair of eyes.
    #[error(transparent)]
    Eyes(#[from] EyesError),
    /// Nothing perceived at one place.
    #[error(transparent)]
    Perceived(#[from] PerceivedError),
    /// A worldline that leads beyond what is computed.
    #[error("leg {leg} of `legs` fails: {reason}")]
    Worldline {
        /// Its index, from 0.
        leg: usize,
        /// What went wrong.
        reason: WorldlineError,
    },
    /// A result that no f64 can hold.
    #[error("the answer's `{key}` is beyond the range of 64-bit numbers: expected a question with smaller numbers")]
    NotFinite {
        /// The answer's key.
        key: &'static str,
    },
}
