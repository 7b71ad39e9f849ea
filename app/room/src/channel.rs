//! Channels: one screen for one eye in a rectangle of a window.

use super::gains::{self, Map};
use super::projector::Projector;
use super::{Display, Eye, Flat, Gains, Screen, Surface, Warp};
use glam::{DVec2, DVec3};
use rayon::prelude::*;

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
    /// Which part of the screen the picture spans, where no projector says it.
    pub part: Part,
    /// Where in the picture the viewport's places are; `None`: the same.
    pub warp: Option<Warp>,
    /// Index into [`Display::projectors`]: whose light lies on the screen. `None`: the picture is the screen's part itself.
    pub projector: Option<usize>,
    /// A measured factor of its pixels.
    pub alpha: Option<Map>,
    /// A measured black level of its pixels: light becomes light × (1 − beta) + beta.
    pub beta: Option<Map>,
}

impl Channel {
    /// Width and height of its picture, pixels.
    pub fn size(&self) -> [u32; 2] {
        [self.viewport[2], self.viewport[3]]
    }

    /// Whose light it is.
    pub fn projector<'a>(&self, display: &'a Display) -> Option<&'a Projector> {
        Some(&display.projectors[self.projector?])
    }

    /// The point of the screen that a place in the viewport (0 to 1, x right, y down from its upper left; pixel centres are at
    /// (i + ½)/size) lights: room axes, metres. `None`: nothing, draw black.
    ///
    /// *Equation.* Of a projector, B eq. 4.2: `S_C(R_p, M_p φ_p)`.
    pub fn point(&self, display: &Display, place: DVec2) -> Option<DVec3> {
        let screen = &display.screens[self.screen];
        match self.projector(display) {
            Some(projector) => Some(self.lit(screen, projector, place)?.1),
            None => screen.surface.point(self.part.uv(self.picture(place)?)),
        }
    }

    /// [`point`](Self::point) at the centres of `size` pixels spread evenly over the viewport, row by row from the upper left.
    ///
    /// It does not depend on the eye: it is made once, and serves however the head moves (B 4.1).
    pub fn points(&self, display: &Display, size: [u32; 2]) -> Vec<Option<DVec3>> {
        let pixels = DVec2::new(f64::from(size[0]), f64::from(size[1]));
        let point = |index: u64| {
            let at = DVec2::new((index % u64::from(size[0])) as f64, (index / u64::from(size[0])) as f64);
            self.point(display, (at + 0.5) / pixels)
        };
        (0..u64::from(size[0]) * u64::from(size[1])).into_par_iter().map(point).collect()
    }

    /// The place in the viewport that lights a point of the screen, if one does: [`point`](Self::point) backwards.
    pub fn place(&self, display: &Display, point: DVec3) -> Option<DVec2> {
        let surface = &display.screens[self.screen].surface;
        let uv = if self.projector.is_none() { surface.uv(point)? } else { DVec2::ZERO };
        self.place_of(display, uv, point)
    }

    /// As [`place`](Self::place), of a point whose place on the surface is known.
    pub(super) fn place_of(&self, display: &Display, uv: DVec2, point: DVec3) -> Option<DVec2> {
        let surface = &display.screens[self.screen].surface;
        let picture = match self.projector(display) {
            Some(projector) => projector.lit_place(surface, point)?,
            None => self.part.place(uv),
        };
        self.viewport_of_picture(picture)
    }

    /// The rectangle that the viewport's pixels lie on in even rows, if there is one: [`frustum()`](super::frustum()) then serves
    /// instead of a map.
    pub fn flat(&self, display: &Display) -> Option<Flat> {
        match &display.screens[self.screen].surface {
            Surface::Flat(flat) if self.warp.is_none() && self.projector.is_none() => {
                Some(flat.part(self.part.from, self.part.to))
            }
            _ => None,
        }
    }

    /// Factors of its pixels, `size` of them, evenly over the viewport. `None`: all are 1.
    pub fn gains(&self, display: &Display, size: [u32; 2]) -> Option<Gains> {
        gains::gains(display, self, size)
    }

    /// Place in the picture, point and normal that a place of the viewport lights by a projector.
    pub(super) fn lit(&self, screen: &Screen, projector: &Projector, place: DVec2) -> Option<(DVec2, DVec3, DVec3)> {
        let picture = self.picture(place)?;
        let hit = screen.surface.hit(projector.position_m, projector.ray(picture)?)?;
        Some((picture, hit.point, hit.normal))
    }

    /// The place of the picture that a place of the viewport shows; both 0 to 1, y down.
    pub fn picture(&self, viewport: DVec2) -> Option<DVec2> {
        self.warp.as_ref().map_or(Some(viewport), |warp| warp.picture(viewport))
    }

    /// Where in the viewport a place of the picture is shown.
    pub(super) fn viewport_of_picture(&self, picture: DVec2) -> Option<DVec2> {
        match &self.warp {
            Some(warp) => warp.viewport(picture),
            None => super::projector::inside(picture).then_some(picture),
        }
    }

    /// 0 on the edge of what the viewport shows, rising inwards without a kink: how gladly it takes over the light there.
    pub(super) fn ramp(&self, viewport: DVec2) -> f64 {
        let product = |place: DVec2| {
            let both = (place * (1.0 - place)).max(DVec2::ZERO);
            16.0 * both.x * both.y
        };
        let own = product(viewport);
        own * own * self.warp.as_ref().map_or(1.0, |warp| warp.picture(viewport).map_or(0.0, product))
    }
}
