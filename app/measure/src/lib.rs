//! `rapidity measure`: the error that each speed-up costs, and the error of the physics in the hardest cases.

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
/// Any fault that prevents measuring or writing, and errors of the physics beyond its limit.
pub fn measure(options: &MeasureOptions) -> Result<(), Error> {
    if options.extremes { extremes::run() } else { sweep::run(options) }
}
