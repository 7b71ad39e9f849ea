//! Lines on standard output and standard error.

use std::fmt::Display;
use std::io::{self, Write};

/// Writes a line to standard output. A closed output is an error, not a panic.
///
/// # Errors
/// An output, terminal or pipe, that is closed.
pub fn say(line: impl Display) -> io::Result<()> {
    writeln!(io::stdout(), "{line}")
}

/// Writes a line to standard error. Where nothing can be written (a full disk, a closed pipe), the work goes on
/// without: it matters more than its notices.
pub fn tell(line: impl Display) {
    // One write, so that lines of two programs are not mixed.
    let _ = io::stderr().write_all(format!("{line}\n").as_bytes());
}
