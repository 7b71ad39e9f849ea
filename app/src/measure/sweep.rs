//! Every dial of the renderers, each at several settings, against the ray tracer.

use crate::command::MeasureOptions;
use crate::error::Error;

/// Measures and writes the results.
///
/// # Errors
/// None yet.
pub fn run(_options: &MeasureOptions) -> Result<(), Error> {
    Ok(())
}
