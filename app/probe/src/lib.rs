//! `rapidity probe`: numbers on request, one JSON question a line, one JSON answer a line.
//!
//! The command serves worksheets, scripts, and checks of the physics from outside: only the crate `physics` lies
//! between question and answer. c = 1, lengths and times in metres, velocities as celerity (`celerity`, γβ) or,
//! instead, as `beta`; numbers are read and written as f64 to the last bit.
//!
//! A line is read in three steps. `json` makes a complete tree of it, duplicate keys included; `keys` reads typed
//! values from the tree and knows the path of each; `questions` asks the physics. If a step fails, the answer is the
//! sentence of a [`ProbeError`], and the next line is read.
//!
//! ```
//! let answer = probe::answer(r#"{"ask": "aberration", "beta": [0.6, 0, 0], "direction": [0, 2, 0]}"#)?;
//! assert_eq!(answer.to_string(), r#"{"D":1.25,"direction":[0.6,0.8,0.0]}"#);
//! # Ok::<(), probe::ProbeError>(())
//! ```

#![deny(clippy::print_stdout, clippy::print_stderr, reason = "only the program prints")]

mod answers;
mod error;
mod json;
mod keys;
mod limits;
mod questions;
mod results;

pub use answers::{answer, run};
pub use error::ProbeError;
pub use limits::{LONGEST_LINE, MOST_STEPS};
