//! Shares of a picture's pixels that are drawn, and the rest in which more of them are.

use std::time::Duration;

/// Time without any change after which a picture is at rest.
pub const STILL_AFTER: Duration = Duration::from_millis(250);

/// Shares of a window's width and height that are drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PictureShares {
    /// Share while anything changes.
    pub moving: f64,
    /// Share at rest.
    pub resting: f64,
}

impl Default for PictureShares {
    fn default() -> Self {
        Self { moving: 1.0, resting: 1.0 }
    }
}

/// Way in which a frame was drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Drawing {
    /// A frame of a ride.
    Moving,
    /// A picture at rest or a sample of it, or nothing, since all of it is there.
    Resting,
}

/// Part of a picture's width and height, pixels.
pub fn part(size: [u32; 2], share: f64) -> [u32; 2] {
    size.map(|side| ((f64::from(side) * share).round() as u32).max(1))
}
