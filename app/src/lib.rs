//! Rapidity, the program, as a library: the command line in `main.rs` only calls it, and so do the tests.
//!
//! [`frame`] shows the whole of it on one page.

pub mod check;
pub mod command;
pub mod devices;
pub mod error;
pub mod exr;
pub mod film;
pub mod film_ride;
pub mod frame;
pub mod gpu;
pub mod live;
pub mod log;
pub mod measure;
pub mod pace;
pub mod photo;
pub mod preferences;
pub mod probe;
pub mod progress;
pub mod render;
pub mod render_walls;
pub mod renderers;
pub mod ride;
pub mod room;
pub mod scene;
pub mod simulation;
pub mod vehicle;
pub mod views;
pub mod walls;
pub mod window;
