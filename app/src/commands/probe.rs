//! `rapidity probe`: questions on standard input, answers on standard output.

use crate::error::Error;
use std::process::ExitCode;

/// Carries out `rapidity probe`. The exit status tells whether all questions could be answered.
///
/// # Errors
/// An error of reading or writing.
pub fn probe() -> Result<ExitCode, Error> {
    let all_answered = probe::run(std::io::stdin().lock(), std::io::stdout().lock())?;
    Ok(if all_answered { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}
