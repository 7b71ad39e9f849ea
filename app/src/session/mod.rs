//! What a session needs before and beside its pictures: the scene that is asked for, the ride's beginning, the user's
//! preferences, the head's tracker, live devices, interruption.

pub mod interrupt;
pub mod live;
pub mod preferences;
pub mod reel;
pub mod scenes;
pub mod start;
pub mod tracker;
