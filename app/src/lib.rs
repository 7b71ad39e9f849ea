//! Rapidity, the program, as a library: the command line in `main.rs` only calls it, and so do the tests.

pub mod command;
pub mod probe;
pub mod scene;
