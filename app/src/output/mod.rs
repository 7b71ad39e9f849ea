//! What the program writes: pictures, light, films, and bars on long waits.

pub mod exr;
pub mod files;
pub mod film;
pub mod progress;
pub mod say;
