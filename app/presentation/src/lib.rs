//! How a ride is shown: effects, exposure, what is open, the language.
//!
//! A [`Presentation`] is changed by [`input::Action`]s alone, and they are recorded, so a replay shows what the rider
//! saw. What it begins with stands in the recording's header, by the names and texts of the command line.

mod latency;
mod presentation;
mod texts;
mod vignette;

pub use latency::Latency;
pub use presentation::{Presentation, colouring, view, vignette};
pub use vignette::Vignette;
