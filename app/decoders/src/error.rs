//! Reasons why bytes cannot be decoded.

use regular_file::OverBudget;
use thiserror::Error;

/// Reason why bytes cannot be decoded. The text is worded to follow the name of the thing and a colon.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum DecodeError {
    /// Fewer bytes than the data announce.
    #[error("its data end too early; it was probably cut short")]
    CutShort,
    /// Bytes that no encoder writes.
    #[error("its data are damaged: {0}")]
    Damaged(String),
    /// Variant of a format that is not read.
    #[error("it is of a kind that is not read: {0}")]
    Unsupported(String),
    /// Picture of another format.
    #[error("it is neither PNG, JPEG, WebP nor KTX2")]
    UnknownPicture,
    /// Picture with a side of no pixels, or of more than graphics processors take.
    #[error("it has {width} × {height} pixels, where sides of 1 to {most} are possible")]
    Size {
        /// Width, pixels.
        width: u32,
        /// Height, pixels.
        height: u32,
        /// Longest side that is possible, pixels.
        most: u32,
    },
    /// More memory than may be taken.
    #[error(transparent)]
    OverBudget(#[from] OverBudget),
}
