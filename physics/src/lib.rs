//! physics

pub mod photo_surface;
