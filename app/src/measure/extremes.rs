//! The numbers at the extremes, against arithmetic of 50 digits.

use crate::error::Error;

/// Prints the table.
///
/// # Errors
/// None yet.
pub fn run() -> Result<(), Error> {
    Ok(())
}
