//! Movable corners of channels: the chosen corner, the places of all corners, and the action of each key. No window
//! and no device is used here.

use glam::DVec2;
use room::{Channel, CornerWarp, Display, NotConvex, Warp};
use thiserror::Error;

/// Distance that a key press moves a corner, pixels.
pub const STEP: f64 = 1.0;
/// Distance that a key press with Shift moves a corner, pixels.
pub const LONG_STEP: f64 = 10.0;
/// Parts of a pixel to which places are rounded. A number from a file then survives a division by the viewport's size
/// and a multiplication by it.
const PER_PIXEL: f64 = 1e6;

/// Key that chooses or moves corners.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CornerKey {
    /// Chooses the next corner, or with Shift the one before. After a channel's last corner comes the next channel.
    Tab,
    /// Moves the corner to the right.
    Right,
    /// Moves the corner to the left.
    Left,
    /// Moves the corner up.
    Up,
    /// Moves the corner down.
    Down,
    /// Puts the corner back to its place in the file, or with Shift into its corner of the viewport.
    Back,
}

/// Reason why a key press is refused.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum CalibrationError {
    /// A channel that is warped by a measured grid.
    #[error("channel {channel} has a measured warp, so its corners cannot be moved")]
    MeasuredWarp {
        /// Name of the channel.
        channel: String,
    },
    /// A move after which the corners would no longer be convex.
    #[error("channel {channel}: {error}")]
    NotConvex {
        /// Name of the channel.
        channel: String,
        /// Error of the corners' map.
        error: NotConvex,
    },
}

/// Corners of all channels of a display, one of them chosen.
#[derive(Clone, Debug, PartialEq)]
pub struct Calibration {
    channels: Vec<ChannelCorners>,
    channel: usize,
    corner: usize,
}

/// Corners of one channel, pixels from the viewport's upper left, y down.
#[derive(Clone, Debug, PartialEq)]
struct ChannelCorners {
    name: String,
    viewport: [DVec2; 4],
    in_file: [DVec2; 4],
    now: [DVec2; 4],
    /// True if the channel is warped by a measured grid.
    measured: bool,
}

impl Calibration {
    /// Creates the calibration of a display as its file describes it. The first corner is chosen.
    pub fn new(display: &Display) -> Self {
        let corners = |channel: &Channel| {
            let [width, height] = channel.size().map(f64::from);
            let viewport = [DVec2::ZERO, DVec2::new(width, 0.0), DVec2::new(width, height), DVec2::new(0.0, height)];
            let pixels = |place: DVec2| (place * DVec2::new(width, height) * PER_PIXEL).round() / PER_PIXEL;
            let corners = match &channel.warp {
                Some(Warp::Corners(corners)) => corners.places.map(pixels),
                _ => viewport,
            };
            let measured = matches!(channel.warp, Some(Warp::Grid(_)));
            ChannelCorners { name: channel.name.clone(), viewport, in_file: corners, now: corners, measured }
        };
        Self { channels: display.channels.iter().map(corners).collect(), channel: 0, corner: 0 }
    }

    /// Indices of the channel and of its corner that keys act on.
    pub fn chosen(&self) -> (usize, usize) {
        (self.channel, self.corner)
    }

    /// Performs a key's action. Returns the channel whose corners have moved, if any have.
    ///
    /// # Errors
    /// [`CalibrationError`]; the corner then stays where it is.
    pub fn press(&mut self, key: CornerKey, shift: bool) -> Result<Option<usize>, CalibrationError> {
        if key == CornerKey::Tab {
            self.choose(shift);
            return Ok(None);
        }
        let step = if shift { LONG_STEP } else { STEP };
        let (corners, corner) = (&mut self.channels[self.channel], self.corner);
        if corners.measured {
            return Err(CalibrationError::MeasuredWarp { channel: corners.name.clone() });
        }
        let mut moved = corners.now;
        moved[corner] = match key {
            CornerKey::Tab => moved[corner],
            CornerKey::Right => moved[corner] + DVec2::new(step, 0.0),
            CornerKey::Left => moved[corner] - DVec2::new(step, 0.0),
            CornerKey::Down => moved[corner] + DVec2::new(0.0, step),
            CornerKey::Up => moved[corner] - DVec2::new(0.0, step),
            CornerKey::Back if shift => corners.viewport[corner],
            CornerKey::Back => corners.in_file[corner],
        };
        if moved == corners.now {
            return Ok(None);
        }
        corners.warp_of(moved).map_err(|error| CalibrationError::NotConvex { channel: corners.name.clone(), error })?;
        corners.now = moved;
        Ok(Some(self.channel))
    }

    /// Present warp of a channel; `None` if it has none.
    pub fn warp(&self, channel: usize) -> Option<Warp> {
        let corners = &self.channels[channel];
        corners.warp_of(corners.now).expect("corners that no picture has are refused").map(Warp::Corners)
    }

    /// Names and corners (pixels) of the channels whose corners differ from the file's; `None` for the viewport's own
    /// corners.
    pub fn changed(&self) -> Vec<(&str, Option<[DVec2; 4]>)> {
        let changed = self.channels.iter().filter(|corners| corners.now != corners.in_file);
        changed
            .map(|corners| (corners.name.as_str(), (corners.now != corners.viewport).then_some(corners.now)))
            .collect()
    }

    /// Records that the file now has the present corners.
    pub fn saved(&mut self) {
        for corners in &mut self.channels {
            corners.in_file = corners.now;
        }
    }

    /// Channel's name and the place of the chosen corner, pixels; true if the file has the channel's corners there.
    pub fn place(&self) -> (&str, DVec2, bool) {
        let corners = &self.channels[self.channel];
        (&corners.name, corners.now[self.corner], corners.now == corners.in_file)
    }

    fn choose(&mut self, backwards: bool) {
        let count = self.channels.len() * 4;
        let step = if backwards { count - 1 } else { 1 };
        let chosen = (self.channel * 4 + self.corner + step) % count;
        (self.channel, self.corner) = (chosen / 4, chosen % 4);
    }
}

impl ChannelCorners {
    /// Warp that corners given in pixels make; `None` if they are the viewport's own.
    fn warp_of(&self, pixels: [DVec2; 4]) -> Result<Option<CornerWarp>, NotConvex> {
        let size = self.viewport[2];
        if pixels == self.viewport { Ok(None) } else { CornerWarp::new(pixels.map(|place| place / size)).map(Some) }
    }
}

#[cfg(test)]
mod tests;
