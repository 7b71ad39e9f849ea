//! Panoramas: pictures of all directions as scenes, from PNG, JPEG, WebP, TIFF, HDR (Radiance) or EXR.
//!
//! The kind of a picture follows from its bytes (`kind`), its layout from its proportions (`shape`) or its header.
//! Each reader (`common`, `radiance`, `open_exr`) hands over a few rows at a time, in linear sRGB; the `canvas` scales
//! them down, if graphics processors do not take such a width, and rounds them to half floats. So a picture is held
//! once. Cubes (`cube`) are converted at the end: all later code knows one layout. Sizes are known, and their memory is
//! taken from a budget, before anything is decoded.

mod canvas;
mod common;
mod cube;
mod decode;
mod error;
mod gpano;
mod intake;
mod jpeg_end;
mod kind;
mod load;
mod open_exr;
mod primaries;
mod radiance;
mod shape;
#[cfg(test)]
mod tests;
mod turn;

pub use decode::decode;
pub use error::{MAX_WIDTH, PanoramaError};
pub use load::load_described;
pub use load::{is_picture, load};
pub use shape::is_equirectangular;
