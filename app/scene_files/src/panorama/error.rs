//! Reasons why a picture is no panorama, and its limits.

use std::path::PathBuf;

/// Largest width of a panorama, pixels: the limit of graphics processors.
pub const MAX_WIDTH: u32 = 16384;

/// Largest number of bytes of a decoded picture, before it is scaled down.
pub(super) const MAX_BYTES: u64 = 4 << 30;

/// Reason why a picture is no panorama. Every message says what is wrong, where, and what to do.
#[derive(Debug, thiserror::Error)]
pub enum PanoramaError {
    /// A picture that the operating system cannot read.
    #[error("cannot read {path}: {error}; check the name and the permissions")]
    Read {
        /// Path of the picture.
        path: PathBuf,
        /// Error of the operating system.
        error: std::io::Error,
    },
    /// A file of another format.
    #[error("{path} is no picture that can be read; save it as PNG, JPEG, HDR (Radiance) or EXR")]
    Format {
        /// Path of the picture.
        path: PathBuf,
    },
    /// A damaged picture, or one of an unsupported kind.
    #[error("{path} cannot be decoded: {fault}; save it again as PNG, JPEG, HDR (Radiance) or EXR")]
    Damaged {
        /// Path of the picture.
        path: PathBuf,
        /// Message of the decoder.
        fault: String,
    },
    /// A picture that is too large to decode.
    #[error(
        "{path} would have {bytes} bytes when decoded, above {MAX_BYTES}; scale it down to {MAX_WIDTH} pixels in width"
    )]
    TooLarge {
        /// Path of the picture.
        path: PathBuf,
        /// Size of the decoded picture, bytes.
        bytes: u64,
    },
    /// A picture that does not show all directions.
    #[error(
        "{path} has {width} × {height} pixels, which is no panorama; expected 2:1 (equirectangular), or the faces of a \
         cube side by side (6:1 or 1:6) or as a cross (4:3 or 3:4)"
    )]
    Shape {
        /// Path of the picture.
        path: PathBuf,
        /// Width, pixels.
        width: u32,
        /// Height, pixels.
        height: u32,
    },
}
