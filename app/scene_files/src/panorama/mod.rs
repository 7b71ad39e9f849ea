//! Panoramas: pictures of all directions as scenes, from PNG, JPEG, HDR (Radiance) or EXR.
//!
//! A picture twice as wide as high is equirectangular already; the layouts of cube maps (`cube`) are converted, so
//! that all later code knows one layout. PNG and JPEG are sRGB and become linear; HDR and EXR are linear and stay
//! unchanged. Sizes are checked before anything is decoded. Pictures larger than graphics processors take are scaled
//! down while they become linear.

mod cube;
mod decode;
mod error;
mod load;

pub(crate) use decode::{decode, is_equirectangular};
pub use error::{MAX_WIDTH, PanoramaError};
pub use load::{is_picture, load};
