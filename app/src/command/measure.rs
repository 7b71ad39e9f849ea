//! `rapidity measure`: what each speed-up costs in error.

use clap::Args;

use super::WorldOptions;

/// What to measure.
#[derive(Args, Clone, Debug, PartialEq)]
#[command(allow_negative_numbers = true)]
pub struct MeasureOptions {
    /// Measure the numbers at the extremes instead, against arithmetic of 50 digits, and print them as a table.
    #[arg(long)]
    pub extremes: bool,
    /// The world.
    #[command(flatten)]
    pub world: WorldOptions,
}

impl MeasureOptions {
    /// Checks what the options say together.
    pub(super) fn check(&self) -> Result<(), String> {
        Ok(())
    }
}
