//! Files of pictures, light and films, written whole or not at all.

pub mod exr;
pub mod files;
pub mod film;
