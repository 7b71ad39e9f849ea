//! Output of the program: pictures, light, films, lines, and progress bars.

pub mod exr;
pub mod files;
pub mod film;
pub mod progress;
pub mod say;
