//! Reasons why no picture can be shown in a headset.

use input::openxr::XrFault;
use thiserror::Error;

/// Reason why no picture can be shown in a headset.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum HeadsetError {
    /// A runtime that is missing, refuses, or has ended the session.
    #[error("{0}")]
    Runtime(#[from] XrFault),
    /// A graphics device that cannot be opened as the runtime wants it, and the driver's reason.
    #[error("the headset's graphics device cannot be opened: {0}; update its driver, or the OpenXR runtime")]
    Device(String),
    /// Number of views of a headset that has neither one nor two for each of two eyes.
    #[error("the headset has {0} views: Rapidity draws one or two for each of two eyes")]
    Views(usize),
    /// Formats of pictures of which none is sRGB in 8 bits.
    #[error("the OpenXR runtime takes no pictures of sRGB in 8 bits")]
    Format,
}
