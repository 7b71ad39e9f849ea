//! `rapidity measure`: what each speed-up costs in error.

pub mod direction;
pub mod plot;
pub mod sweep;

use crate::command::MeasureOptions;
use crate::error::Error;

/// Carries out `rapidity measure`.
///
/// # Errors
/// Whatever keeps it from being measured or written.
pub fn measure(options: &MeasureOptions) -> Result<(), Error> {
    sweep::run(options)
}
