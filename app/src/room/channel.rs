//! Channels: one screen for one eye in a rectangle of a window.

use super::{Display, Eye, Flat, Gains, Surface};
use glam::{DVec2, DVec3};

/// A rectangle of a surface in uv.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Part {
    /// Lower left.
    pub from: DVec2,
    /// Upper right.
    pub to: DVec2,
}

impl Default for Part {
    fn default() -> Self {
        Self { from: DVec2::ZERO, to: DVec2::ONE }
    }
}

impl Part {
    /// Place on the surface of a place in the picture (0 to 1, y down).
    pub fn uv(&self, place: DVec2) -> DVec2 {
        self.from + DVec2::new(place.x, 1.0 - place.y) * (self.to - self.from)
    }

    /// The picture's place of a place on the surface; beyond 0 to 1 where the part does not reach.
    pub fn place(&self, uv: DVec2) -> DVec2 {
        let place = (uv - self.from) / (self.to - self.from);
        DVec2::new(place.x, 1.0 - place.y)
    }
}

/// What one eye sees of one screen, and where in which window that is drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct Channel {
    /// Unique among the channels, and good as a file's name.
    pub name: String,
    /// Index into [`Display::screens`].
    pub screen: usize,
    /// Whose.
    pub eye: Eye,
    /// Index into [`Display::windows`].
    pub window: usize,
    /// x, y, width and height in the window, pixels from its upper left.
    pub viewport: [u32; 4],
    /// Which part of the screen the viewport spans, where no projector says it.
    pub part: Part,
}

impl Channel {
    /// Width and height of its picture, pixels.
    pub fn size(&self) -> [u32; 2] {
        [self.viewport[2], self.viewport[3]]
    }

    /// The point of the screen that a place in the viewport (0 to 1, x right, y down from its upper left; pixel centres are at
    /// (i + ½)/size) lights: room axes, metres. `None`: nothing, draw black.
    pub fn point(&self, display: &Display, place: DVec2) -> Option<DVec3> {
        Some(display.screens[self.screen].surface.point(self.part.uv(place)))
    }

    /// The rectangle that the viewport's pixels lie on in even rows, if there is one: [`frustum()`](super::frustum()) then serves
    /// instead of a map.
    pub fn flat(&self, display: &Display) -> Option<Flat> {
        match &display.screens[self.screen].surface {
            Surface::Flat(flat) => Some(flat.part(self.part.from, self.part.to)),
        }
    }

    /// Factors of its pixels, `size` of them, evenly over the viewport. `None`: all are 1.
    pub fn gains(&self, _display: &Display, _size: [u32; 2]) -> Option<Gains> {
        None
    }
}
