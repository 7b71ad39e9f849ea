//! `rapidity measure --extremes`: errors of the physics where formulas tend to break down, as the table of
//! ACCURACY.md.
//!
//! The cases are speeds from γ = 1 + 1e-12 to 1e12, light from straight ahead, straight behind and next to it, points
//! at the eye and 1e15 m away, steps of a microsecond, and a billion steps. Each case is computed a second time at
//! 180 digits from the same f64 numbers, by formulas that the program does not use (`light`, `motion`). The
//! difference is the program's rounding.

mod light;
mod motion;
mod row;
mod table;
mod worldline;

pub use row::{ExtremesRow, LIMIT};
pub use table::{Extent, ExtremesError, check, document, rows};
pub use worldline::{Lengths, Refused};
