//! Rapidity, the program, as a library: `main.rs` only calls it, and so do the tests.
//!
//! [`frame`] shows the path of one frame through the program on one page. Commands are in [`commands`], their options
//! in [`command`]. The crates beside this folder hold everything else.
#![allow(clippy::print_stdout, clippy::print_stderr, reason = "this crate alone reports to the user")]

mod canvas;
pub mod command;
pub mod commands;
pub mod error;
pub mod frame;
mod output;
mod session;
mod stage_times;
mod window;
