//! Rapidity, the program, as a library: `main.rs` only calls it, and so do the tests.
//!
//! [`frame`] shows the path of one frame through the program on one page. Commands are in [`commands`], their options
//! in the crate [`command`]. The crates beside this folder hold everything else.

mod canvas;
pub mod commands;
pub mod error;
pub mod frame;
mod output;
mod session;
mod stage_times;
mod window;

pub use output::say::tell;
