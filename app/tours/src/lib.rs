//! Tours: short guided rides that switch effects on one at a time, explain what is seen, and ask.
//!
//! A tour is a TOML file (docs/TOURS.md). `tour_file` reads it strictly into a plan (`plan`). The player (`player`) is
//! a pure function of time and of the vehicle: it gives the samples of a rider who is nobody (`rider`), what is to be
//! shown, and the text to show with it. It stops where the tour asks, or where the visitor does, and goes on from
//! there. `built_in` holds the tours of the program.

mod built_in;
mod change;
mod plan;
mod player;
mod rider;
mod tour_error;
mod tour_file;

pub use built_in::{BUILT_IN, built_in, built_in_plans};
pub use change::TourChange;
pub use plan::{
    StationRide, TourAnswer, TourEvent, TourPanel, TourPlan, TourQuestion, TourRoute, TourStation, TourText, TourView,
};
pub use player::{TourPlayer, TourStep};
pub use tour_error::{PlayError, TourError};
pub use tour_file::{LARGEST_BYTES, parse, read};
