//! The commands of the program, a file each.

mod bicycle_file;
mod calibrate;
pub mod calibrating_error;
mod cameraman;
pub mod check;
pub mod devices;
mod film_titles;
pub mod measure;
pub mod probe;
pub mod render;
mod render_room;
pub mod ride;
mod ride_film;
mod tour_film;
pub mod town;
