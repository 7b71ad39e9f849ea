//! Pictures without a window: several samples a pixel, exact to f32, read back as 8-bit sRGB or as linear light.

mod darkroom;
mod light;
mod sheet;
mod studio;

pub use darkroom::{Darkroom, Developing};
pub use light::{largest_side, light, upload};
pub use sheet::{Fetching, SCREEN_FORMAT, Sheet};
pub use studio::{Shown, Studio};
