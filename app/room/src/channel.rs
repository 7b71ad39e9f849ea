//! Channels: one screen for one eye in a rectangle of a window.

use crate::gain_map::GainMap;
use crate::unit_square::inside;
use crate::viewer::EyeSide;
use crate::warp::Warp;
use glam::DVec2;

/// Rectangle of a surface, in uv.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChannelPart {
    /// Lower left corner, uv.
    pub from: DVec2,
    /// Upper right corner, uv.
    pub to: DVec2,
}

impl Default for ChannelPart {
    fn default() -> Self {
        Self { from: DVec2::ZERO, to: DVec2::ONE }
    }
}

impl ChannelPart {
    /// Place uv on the surface of a place in the picture (0 to 1, y down).
    pub fn uv(&self, place: DVec2) -> DVec2 {
        self.from + DVec2::new(place.x, 1.0 - place.y) * (self.to - self.from)
    }

    /// Place in the picture of a place uv on the surface; outside 0 to 1 if the surface's place is outside the part.
    pub fn place(&self, uv: DVec2) -> DVec2 {
        let place = (uv - self.from) / (self.to - self.from);
        DVec2::new(place.x, 1.0 - place.y)
    }
}

/// View of one screen for one eye, drawn in a rectangle of a window.
#[derive(Clone, Debug, PartialEq)]
pub struct Channel {
    /// Name, unique among the channels and valid as a file's name.
    pub name: String,
    /// Index into [`Display::screens`](crate::Display::screens).
    pub screen: usize,
    /// Eye for which the channel is drawn.
    pub eye: EyeSide,
    /// Index into [`Display::windows`](crate::Display::windows).
    pub window: usize,
    /// Rectangle in the window: x, y, width and height, pixels from the window's upper left.
    pub viewport: [u32; 4],
    /// Part of the screen that the picture spans; not used for a projector's channel.
    pub part: ChannelPart,
    /// Map from places of the viewport to places of the picture; `None` if they are equal.
    pub warp: Option<Warp>,
    /// Index into [`Display::projectors`](crate::Display::projectors) of the projector whose light falls on the
    /// screen. `None` if the picture is the screen's part itself.
    pub projector: Option<usize>,
    /// Measured factor of the channel's pixels, in linear light.
    pub alpha: Option<GainMap>,
    /// Measured black level of the channel's pixels: light becomes light × (1 − beta) + beta.
    pub beta: Option<GainMap>,
}

impl Channel {
    /// Width and height of the channel's picture, pixels.
    pub fn size(&self) -> [u32; 2] {
        [self.viewport[2], self.viewport[3]]
    }

    /// Place of the picture that a place of the viewport shows; both 0 to 1, y down.
    pub fn picture(&self, viewport: DVec2) -> Option<DVec2> {
        self.warp.as_ref().map_or(Some(viewport), |warp| warp.picture(viewport))
    }

    /// Place of the viewport that shows a place of the picture.
    pub(crate) fn viewport_of_picture(&self, picture: DVec2) -> Option<DVec2> {
        match &self.warp {
            Some(warp) => warp.viewport(picture),
            None => inside(picture).then_some(picture),
        }
    }

    /// Weight of the channel for blending: 0 on the edges of its picture, rising inwards without a kink.
    pub(crate) fn ramp(&self, viewport: DVec2) -> f64 {
        let product = |place: DVec2| {
            let both = (place * (1.0 - place)).max(DVec2::ZERO);
            16.0 * both.x * both.y
        };
        let own = product(viewport);
        own * own * self.warp.as_ref().map_or(1.0, |warp| warp.picture(viewport).map_or(0.0, product))
    }
}
