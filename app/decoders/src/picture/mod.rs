//! Pictures, told apart by their first bytes and decoded to 8-bit sRGB.

mod kind;
mod pixels;

pub use kind::{PictureKind, kind};
pub use pixels::{DecodedPicture, decode, size};
