//! Frame rate that a window or a room holds by its resolution.

use walls::Governor;

/// Frame rate that a window or a room holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FrameRate {
    /// Frames per second.
    Held(f64),
    /// Any rate: every pixel is drawn.
    Any,
}

impl Default for FrameRate {
    fn default() -> Self {
        Self::Held(30.0)
    }
}

impl FrameRate {
    /// Governor that holds the rate; `None` for any rate.
    pub fn governor(self) -> Option<Governor> {
        match self {
            Self::Held(frame_rate) => Some(Governor::new(frame_rate)),
            Self::Any => None,
        }
    }
}
