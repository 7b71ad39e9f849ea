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
//! let answer = rapidity::probe::answer(r#"{"ask": "aberration", "beta": [0.6, 0, 0], "direction": [0, 2, 0]}"#)?;
//! assert_eq!(answer.to_string(), r#"{"D":1.25,"direction":[0.6,0.8,0.0]}"#);
//! # Ok::<(), rapidity::probe::ProbeError>(())
//! ```

use std::io::{self, BufRead, ErrorKind, Read, Write};

use serde_json::{Value, json};

mod error;
mod json;
mod keys;
mod questions;
mod results;

pub use error::ProbeError;

/// Longest line that is read, bytes. A question of this length has some fifty thousand legs. A longer line is not a
/// question but other data on standard input, and must not fill the memory.
pub const LONGEST_LINE: usize = 4 << 20;

/// Largest number of steps of one `worldline` question, all legs together: seconds of computing.
pub const MOST_STEPS: f64 = 1e8;

/// Answers one line.
///
/// # Errors
/// [`ProbeError`] if the line is not a question, or its answer cannot be computed; the sentence gives the fault, the
/// key, and the expected value.
pub fn answer(line: &str) -> Result<Value, ProbeError> {
    questions::answer(&json::parse(line)?)
}

/// Answers every line of `reader` on a line of `writer`, in order. Each answer is flushed before the next line is
/// read.
///
/// Returns true if all lines could be answered. Blank lines are skipped. Ends without error if the reading end is
/// closed (a broken pipe).
///
/// # Errors
/// An error of reading or writing.
pub fn run(mut reader: impl BufRead, mut writer: impl Write) -> io::Result<bool> {
    let mut all_answered = true;
    let mut line = Vec::new();
    loop {
        line.clear();
        if reader.by_ref().take(LONGEST_LINE as u64 + 1).read_until(b'\n', &mut line)? == 0 {
            return Ok(all_answered);
        }
        line.pop_if(|last| *last == b'\n');
        let answer = if line.len() > LONGEST_LINE {
            reader.skip_until(b'\n')?;
            Err(ProbeError::TooLong)
        } else if line.trim_ascii().is_empty() {
            continue;
        } else {
            std::str::from_utf8(&line).map_err(ProbeError::from).and_then(answer)
        };
        let answer = answer.unwrap_or_else(|error| {
            all_answered = false;
            json!({ "error": error.to_string() })
        });
        match writer.write_all(format!("{answer}\n").as_bytes()).and_then(|()| writer.flush()) {
            Err(error) if error.kind() == ErrorKind::BrokenPipe => return Ok(all_answered),
            written => written?,
        }
    }
}
