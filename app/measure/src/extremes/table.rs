//! Rows of the table of extremes, and the table as a document.

use thiserror::Error;

use super::light;
use super::row::{ExtremesRow, LIMIT, RK4_LIMIT};
use super::worldline::{self, Lengths, Refused};

/// Extent of the measurement: numbers of cases and steps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extent {
    /// Number of cases of each row about light.
    pub light_cases: u32,
    /// Lengths of the journeys.
    pub journeys: Lengths,
}

impl Extent {
    /// Full measurement for the table: minutes.
    pub const FULL: Self = Self {
        light_cases: 300,
        journeys: Lengths { coasting: 1_000_000_000, turns: 1000, reversals: 1000, cases: 200, steps: 1_000_000 },
    };
    /// Quick measurement, the same rows with fewer cases and steps: seconds.
    pub const QUICK: Self = Self {
        light_cases: 60,
        journeys: Lengths { coasting: 1_000_000, turns: 10, reversals: 20, cases: 20, steps: 100_000 },
    };
}

/// Reason for which the table is not complete, or not within the limit.
#[derive(Debug, Error)]
pub enum ExtremesError {
    /// A journey that the physics refused.
    #[error("a journey could not be measured: {0}")]
    Journey(#[from] Refused),
    /// A thread for coasting that could not be started.
    #[error("no thread could be started: {0}")]
    Thread(#[source] std::io::Error),
    /// Errors beyond the limit.
    #[error(
        "{count} of the errors exceed {LIMIT:e}; the largest, {error:e}, is in {what}: {quantity}",
        error = worst.error, what = worst.what, quantity = worst.quantity
    )]
    Exceeded {
        /// Number of such errors.
        count: usize,
        /// Row of the largest error.
        worst: Box<ExtremesRow>,
    },
}

/// Rows of the table, in its order.
///
/// # Errors
///
/// [`ExtremesError`] if a journey is refused or no thread starts.
pub fn rows(extent: Extent) -> Result<Vec<ExtremesRow>, ExtremesError> {
    // Coasting takes as long as the rest of the rows together.
    std::thread::scope(|scope| {
        let coasting = std::thread::Builder::new()
            .name("coasting".into())
            .spawn_scoped(scope, || worldline::coasting(extent.journeys.coasting))
            .map_err(ExtremesError::Thread)?;
        let mut rows = light::rows(extent.light_cases);
        rows.extend(worldline::rows(extent.journeys)?);
        rows.extend(coasting.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))?);
        Ok(rows)
    })
}

/// Checks that all rows are within the limit.
///
/// # Errors
///
/// [`ExtremesError::Exceeded`] if an error is beyond the limit.
pub fn check(rows: &[ExtremesRow]) -> Result<(), ExtremesError> {
    let exceeding = rows.iter().filter(|row| !row.holds());
    let count = exceeding.clone().count();
    match exceeding.max_by(|a, b| a.error.total_cmp(&b.error)) {
        Some(worst) => Err(ExtremesError::Exceeded { count, worst: Box::new(worst.clone()) }),
        None => Ok(()),
    }
}

/// Table with its heading, as Markdown.
pub fn document(rows: &[ExtremesRow]) -> String {
    let of_rounding = rows.iter().filter(|row| row.limit <= LIMIT);
    let worst = of_rounding.map(|row| row.error).fold(0.0, f64::max);
    let mut text = format!(
        "# Accuracy at the extremes\n\n\
        How far the physics, computed in f64, is off where formulas tend to break down: at speeds next to rest and next to that of light,\n\
        straight behind, at the eye and far away, in tiny steps and in a billion. No error exceeds {LIMIT:e}, except for RK4, which\n\
        rides use by default and which is of fourth order; apart from that, the largest is {worst:.1e}.\n\n\
        The reference is computed at 600 bits, 180 decimal digits, with [dashu-float](https://crates.io/crates/dashu-float), from the very\n\
        f64 numbers that the program is given, and by other formulas: light by the textbook's boost and retardation, journeys by one exponential\n\
        of a five-by-five matrix (tetrad and event). Errors are the largest of all cases. Directions are in radians; a share is relative.\n\
        A γ takes every decade as often as any other, and both ends. Journeys are in a world in which light covers 10 m in a second.\n\n\
        This file is written by `rapidity measure --extremes > ACCURACY.md`, which fails if a line exceeds {LIMIT:e}, or one of\n\
        thrust by RK4 {RK4_LIMIT:e}.\n\n\
        | cases | how many | quantity | largest error |\n|---|--:|---|--:|\n"
    );
    let mut last = "";
    for ExtremesRow { what, cases, quantity, error, .. } in rows {
        // The name of a group is written once.
        let (name, number) =
            if what == last { (String::new(), String::new()) } else { (what.clone(), cases.to_string()) };
        let error = if *error == 0.0 { "0".to_owned() } else { format!("{error:.1e}") };
        text.push_str(&format!("| {name} | {number} | {quantity} | {error} |\n"));
        last = what;
    }
    text
}
