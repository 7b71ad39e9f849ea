//! Channels: one screen for one eye in a rectangle of a window.

use super::gains::{self, Map};
use super::projector::Projector;
use super::{Display, Eye, Flat, Gains, Screen, Surface, Warp};
use glam::{DVec2, DVec3};
use rayon::prelude::*;

/// Rectangle of a surface, in uv.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Part {
    /// Lower left corner, uv.
    pub from: DVec2,
    /// Upper right corner, uv.
    pub to: DVec2,
}

impl Default for Part {
    fn default() -> Self {
        Self { from: DVec2::ZERO, to: DVec2::ONE }
    }
}

impl Part {
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
    /// Index into [`Display::screens`].
    pub screen: usize,
    /// Eye for which the channel is drawn.
    pub eye: Eye,
    /// Index into [`Display::windows`].
    pub window: usize,
    /// Rectangle in the window: x, y, width and height, pixels from the window's upper left.
    pub viewport: [u32; 4],
    /// Part of the screen that the picture spans; not used for a projector's channel.
    pub part: Part,
    /// Map from places of the viewport to places of the picture; `None` if they are equal.
    pub warp: Option<Warp>,
    /// Index into [`Display::projectors`] of the projector whose light falls on the screen. `None` if the picture is
    /// the screen's part itself.
    pub projector: Option<usize>,
    /// Measured factor of the channel's pixels, in linear light.
    pub alpha: Option<Map>,
    /// Measured black level of the channel's pixels: light becomes light × (1 − beta) + beta.
    pub beta: Option<Map>,
}

impl Channel {
    /// Width and height of the channel's picture, pixels.
    pub fn size(&self) -> [u32; 2] {
        [self.viewport[2], self.viewport[3]]
    }

    /// Projector whose light shows the channel, if any.
    pub fn projector<'a>(&self, display: &'a Display) -> Option<&'a Projector> {
        Some(&display.projectors[self.projector?])
    }

    /// Point of the screen that is lit by a place in the viewport (0 to 1, x right, y down from its upper left; pixel
    /// centres are at (i + ½)/size): room axes, metres. `None` if the place lights nothing and is to be drawn black.
    ///
    /// *Equation.* For a projector, B eq. 4.2: `S_C(R_p, M_p φ_p)`.
    pub fn point(&self, display: &Display, place: DVec2) -> Option<DVec3> {
        let screen = &display.screens[self.screen];
        match self.projector(display) {
            Some(projector) => Some(self.lit(screen, projector, place)?.1),
            None => screen.surface.point(self.part.uv(self.picture(place)?)),
        }
    }

    /// Points that [`point`](Self::point) gives at the centres of `size` pixels spread evenly over the viewport, row
    /// by row from the upper left.
    ///
    /// The points do not depend on the eye: they are computed once and stay valid while the head moves (B 4.1).
    pub fn points(&self, display: &Display, size: [u32; 2]) -> Vec<Option<DVec3>> {
        let pixels = DVec2::new(f64::from(size[0]), f64::from(size[1]));
        let point = |index: u64| {
            let at = DVec2::new((index % u64::from(size[0])) as f64, (index / u64::from(size[0])) as f64);
            self.point(display, (at + 0.5) / pixels)
        };
        (0..u64::from(size[0]) * u64::from(size[1])).into_par_iter().map(point).collect()
    }

    /// Place in the viewport that lights a point of the screen, if there is one: the inverse of
    /// [`point`](Self::point).
    pub fn place(&self, display: &Display, point: DVec3) -> Option<DVec2> {
        let surface = &display.screens[self.screen].surface;
        let uv = if self.projector.is_none() { surface.uv(point)? } else { DVec2::ZERO };
        self.place_of(display, uv, point)
    }

    /// Place in the viewport as in [`place`](Self::place), for a point whose place `uv` on the surface is known.
    pub(super) fn place_of(&self, display: &Display, uv: DVec2, point: DVec3) -> Option<DVec2> {
        let surface = &display.screens[self.screen].surface;
        let picture = match self.projector(display) {
            Some(projector) => projector.lit_place(surface, point)?,
            None => self.part.place(uv),
        };
        self.viewport_of_picture(picture)
    }

    /// Rectangle on which the viewport's pixels lie in even rows, if there is one. [`frustum()`](super::frustum())
    /// then replaces a map.
    pub fn flat(&self, display: &Display) -> Option<Flat> {
        match &display.screens[self.screen].surface {
            Surface::Flat(flat) if self.warp.is_none() && self.projector.is_none() => {
                Some(flat.part(self.part.from, self.part.to))
            }
            _ => None,
        }
    }

    /// Factors of the channel's pixels at `size` pixels spread evenly over the viewport; `None` if all are 1.
    pub fn gains(&self, display: &Display, size: [u32; 2]) -> Option<Gains> {
        gains::gains(display, self, size)
    }

    /// Place in the picture, point and normal that a place of the viewport lights through a projector.
    pub(super) fn lit(&self, screen: &Screen, projector: &Projector, place: DVec2) -> Option<(DVec2, DVec3, DVec3)> {
        let picture = self.picture(place)?;
        let hit = screen.surface.hit(projector.position_m, projector.ray(picture)?)?;
        Some((picture, hit.point, hit.normal))
    }

    /// Place of the picture that a place of the viewport shows; both 0 to 1, y down.
    pub fn picture(&self, viewport: DVec2) -> Option<DVec2> {
        self.warp.as_ref().map_or(Some(viewport), |warp| warp.picture(viewport))
    }

    /// Place of the viewport that shows a place of the picture.
    pub(super) fn viewport_of_picture(&self, picture: DVec2) -> Option<DVec2> {
        match &self.warp {
            Some(warp) => warp.viewport(picture),
            None => super::projector::inside(picture).then_some(picture),
        }
    }

    /// Weight of the channel for blending: 0 on the edges of its picture, rising inwards without a kink.
    pub(super) fn ramp(&self, viewport: DVec2) -> f64 {
        let product = |place: DVec2| {
            let both = (place * (1.0 - place)).max(DVec2::ZERO);
            16.0 * both.x * both.y
        };
        let own = product(viewport);
        own * own * self.warp.as_ref().map_or(1.0, |warp| warp.picture(viewport).map_or(0.0, product))
    }
}
