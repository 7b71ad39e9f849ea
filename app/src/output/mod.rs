//! Output of the program to the terminal: lines, and progress bars.

pub mod progress;
pub mod say;
