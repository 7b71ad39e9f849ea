//! Files of pictures, light and films, written whole or not at all.

mod codec;
pub mod exr;
pub mod files;
pub mod film;
mod numbers;
mod sequence;
mod spherical;

pub use codec::{FilmCodec, HdrCurve};
pub use numbers::{FarmPart, FrameNumbers, NumbersError, PartError};
pub use sequence::{SequenceName, is_whole};
pub use spherical::{FilmEyes, FilmProjection, SphericalTags};
