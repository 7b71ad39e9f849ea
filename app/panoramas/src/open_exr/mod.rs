//! OpenEXR: the part and the channels that make a panorama (`part`), the blocks of numbers (`blocks`), and the way
//! from these to linear sRGB (`read`).
//!
//! The crate `exr` reads headers and unpacks blocks. Blocks are found and cut into channels here, because a panorama
//! needs what the crate's own reader of pictures leaves out: channels at a lower resolution (luminance and chroma),
//! files that end too early, and bounds on memory.

mod blocks;
mod part;
mod read;

pub(super) use read::read;
