//! `rapidity measure`: what each speed-up costs in error, and what the physics is off by where it is hardest.

pub mod direction;
pub mod extremes;
pub mod plot;
pub mod sweep;

use crate::command::MeasureOptions;
use crate::error::Error;

/// Carries out `rapidity measure`.
///
/// # Errors
/// Whatever keeps it from being measured or written, and errors of the physics beyond what it promises.
pub fn measure(options: &MeasureOptions) -> Result<(), Error> {
    if options.extremes { extremes::run() } else { sweep::run(options) }
}
