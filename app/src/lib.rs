//! Rapidity, the program, as a library: `main.rs` only calls it, and so do the tests.
//!
//! [`frame`] shows the whole of it on one page. Commands are in [`commands`], their options in [`command`]; everything
//! that is not a program of its own is in the crates beside this folder.

mod canvas;
pub mod command;
pub mod commands;
pub mod error;
pub mod frame;
mod output;
mod session;
mod stage_times;
mod window;
