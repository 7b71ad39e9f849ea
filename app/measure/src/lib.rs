//! `rapidity measure`: what each speed-up costs in error, and what the physics is off by where it is hardest.

pub mod choice;
pub mod clock;
pub mod colour;
pub mod dials;
pub mod direction;
pub mod extremes;
pub mod flip;
pub mod pictures;
pub mod plot;
mod precision;
pub mod quantiles;
pub mod reference;
mod samples;
mod shift_table;
mod steps;
pub mod sweep;
pub mod table;
pub mod views;

use crate::command::MeasureOptions;
use crate::error::Error;

/// Carries out `rapidity measure`.
///
/// # Errors
/// Whatever keeps it from being measured or written, and errors of the physics beyond what it promises.
pub fn measure(options: &MeasureOptions) -> Result<(), Error> {
    if options.extremes { extremes::run() } else { sweep::run(options) }
}
