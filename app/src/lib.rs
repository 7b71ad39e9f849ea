//! Rapidity, the program, as a library: the command line in `main.rs` only calls it, and so do the tests.

pub mod command;
pub mod error;
pub mod film;
pub mod gpu;
pub mod progress;
pub mod render;
pub mod renderers;
pub mod scene;
pub mod views;
