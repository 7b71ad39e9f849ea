//! Pictures, told apart by their first bytes and decoded to 8-bit sRGB.

mod basis;
mod decoded;
mod jpeg;
mod jpeg_outline;
mod kind;
mod ktx2;
mod ktx2_outline;
mod pixels;
mod png;
#[cfg(test)]
mod samples;
#[cfg(test)]
mod tests;
mod webp;
mod webp_outline;

pub use decoded::DecodedPicture;
pub use kind::{PictureKind, kind};
pub use pixels::{decode, size};
