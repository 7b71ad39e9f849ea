//! What the program writes: pictures, light, films, and bars on long waits.

pub mod exr;
pub mod film;
pub mod files;
pub mod progress;
pub mod say;
