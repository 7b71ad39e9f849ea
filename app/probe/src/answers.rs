//! Questions in, answers out, line by line.

use std::io::{self, BufRead, ErrorKind, Read, Write};

use serde_json::{Value, json};

use crate::error::ProbeError;
use crate::limits::LONGEST_LINE;
use crate::{json as lines, questions};

/// Answers one line.
///
/// # Errors
/// [`ProbeError`] if the line is not a question, or its answer cannot be computed; the sentence gives the fault, the
/// key, and the expected value.
pub fn answer(line: &str) -> Result<Value, ProbeError> {
    questions::answer(&lines::parse(line)?)
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
