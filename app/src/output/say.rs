//! Lines on standard output.

use std::io::{self, Write};

/// Writes a line to standard output. A closed output is an error, not a panic.
///
/// # Errors
/// An output, terminal or pipe, that is closed.
pub fn say(line: &str) -> io::Result<()> {
    writeln!(io::stdout(), "{line}")
}
