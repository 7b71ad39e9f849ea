//! The commands of the program, a file each.

mod cameraman;
pub mod calibrate;
pub mod check;
pub mod devices;
pub mod measure;
pub mod probe;
pub mod render;
mod render_room;
pub mod ride;
mod ride_film;
pub mod town;
