//! Parts of a session besides its pictures: the requested scene, the ride's beginning, the user's preferences, the
//! head's tracker, live devices, interruption.

#[cfg(test)]
#[path = "crossing/tests.rs"]
mod crossing_tests;
#[cfg(test)]
#[path = "desk/tests.rs"]
mod desk_tests;
pub mod interrupt;
pub mod live;
mod live_told;
mod lost_time;
pub mod making;
pub mod preferences;
mod recorded_ride;
#[cfg(test)]
#[path = "recorded/tests.rs"]
mod recorded_tests;
pub mod reel;
pub mod scenes;
pub mod start;
pub mod tour_ride;
pub mod tracker;
pub mod waiting;
