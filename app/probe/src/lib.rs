//! `rapidity probe`: numbers on request, one JSON question a line, one JSON answer a line.
//!
//! For worksheets, for scripts, and for checking the physics from outside: nothing lies between question and answer but
//! the crate `physics`. c = 1, lengths and times in metres, velocities as celerity (`celerity`, γβ) or, instead, as
//! `beta`; numbers go in and out as f64 to the last bit.
//!
//! A line passes three doors. `json` makes a tree of it that forgets nothing, doubled keys included; `keys` reads typed
//! values from the tree and knows the path of each; `questions` asks the physics. What fails at any of them is a
//! [`ProbeError`], the line is answered with its sentence, and the next line is read.
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

/// The longest line that is read, in bytes. A question of this length has some fifty thousand legs; beyond it a line is
/// no question but something else on standard input, and must not fill the memory.
pub const LONGEST_LINE: usize = 4 << 20;

/// The most steps of one `worldline` question, all legs together: seconds of computing.
pub const MOST_STEPS: f64 = 1e8;

/// Answers one line.
///
/// # Errors
/// The line is not a question, or its answer cannot be computed; the sentence says what, which key, and what was
/// expected.
pub fn answer(line: &str) -> Result<Value, ProbeError> {
    questions::answer(&json::parse(line)?)
}

/// Answers every line of `reader` on a line of `writer`, in order, each flushed before the next is read.
///
/// Returns whether all lines could be answered. Blank lines are skipped. Ends in peace when nobody reads any more (a
/// broken pipe).
///
/// # Errors
/// Reading or writing fails.
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
