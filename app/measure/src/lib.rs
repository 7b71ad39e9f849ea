//! Time and error of every way to draw, as tables; and the errors of the physics where they are largest.
//!
//! Scenes and points of view come in, rows and a [`view::Dial`] come out. Nothing here prints, reads a command line or
//! writes preferences.

pub mod choice;
mod clock;
pub mod colour;
mod dial_positions;
pub mod direction;
mod error;
pub mod extremes;
pub mod flip;
pub mod pictures;
pub mod plot;
pub mod precision;
pub mod quantiles;
pub mod reference;
mod row;
pub mod samples;
pub mod shift_table;
pub mod steps;
pub mod table;
pub mod views;

pub use dial_positions::{OF_RIDES, OF_STILLS};
pub use error::MeasureError;
pub use row::Row;
