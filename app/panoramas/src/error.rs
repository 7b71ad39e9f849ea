//! Reasons why a picture is no panorama, and its limits.

use regular_file::OverBudget;
use std::path::PathBuf;

/// Largest width of a panorama, pixels: the limit of graphics processors.
pub const MAX_WIDTH: u32 = 16384;

/// Reason why a picture is no panorama. Every message says what is wrong, where, and what to do.
#[derive(Debug, thiserror::Error)]
pub enum PanoramaError {
    /// A picture that the operating system cannot read.
    #[error("cannot read {}: {error}; check the name and the permissions", path.display())]
    Read {
        /// Path of the picture.
        path: PathBuf,
        /// Error of the operating system.
        error: std::io::Error,
    },
    /// A file of another format.
    #[error("{} is no picture that can be read; save it as PNG, JPEG, WebP, TIFF, HDR (Radiance) or EXR", path.display())]
    Format {
        /// Path of the picture.
        path: PathBuf,
    },
    /// A damaged picture, or one of an unsupported kind.
    #[error("{} cannot be decoded: {fault}; save it again as PNG, JPEG, HDR (Radiance) or EXR", path.display())]
    Damaged {
        /// Path of the picture.
        path: PathBuf,
        /// Message of the decoder.
        fault: String,
    },
    /// A picture that is too large.
    #[error("{}: {fault}", path.display())]
    TooLarge {
        /// Path of the picture.
        path: PathBuf,
        /// Memory that it would take.
        fault: OverBudget,
    },
    /// A picture that does not show all directions.
    #[error(
        "{} has {width} × {height} pixels, which is no panorama; expected 2:1 (equirectangular), or the faces of a \
         cube side by side (6:1 or 1:6) or as a cross (4:3 or 3:4)", path.display()
    )]
    Shape {
        /// Path of the picture.
        path: PathBuf,
        /// Width, pixels.
        width: u32,
        /// Height, pixels.
        height: u32,
    },
    /// A picture with the proportions of a cross of six faces, in whose corners there is a picture.
    #[error(
        "{} is a photo of {width} × {height} pixels, not a panorama: a cube's cross of these proportions leaves its \
         corners empty, in one colour; give a picture of all directions, 2:1 (equirectangular)", path.display()
    )]
    Photo {
        /// Path of the picture.
        path: PathBuf,
        /// Width, pixels.
        width: u32,
        /// Height, pixels.
        height: u32,
    },
}
