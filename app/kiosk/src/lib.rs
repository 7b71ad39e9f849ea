//! A ride that visitors of a museum take one after the other: who rides when, the ride that is shown while nobody
//! does, and the day's log.

mod attract;
mod day_log;
mod frame_tally;
mod head_watch;
mod reach;
mod turns;
mod visitors;

pub use day_log::{DayLog, DayLogError};
pub use visitors::Kiosk;
