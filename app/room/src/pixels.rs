//! Pixels of a channel: the points of the screen that they light.

use crate::channel::Channel;
use crate::display::{Display, Screen};
use crate::projector::Projector;
use crate::surface::flat::FlatSurface;
use crate::surface::shape::ScreenSurface;
use glam::{DVec2, DVec3};
use rayon::prelude::*;

impl Channel {
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
    pub(crate) fn place_of(&self, display: &Display, uv: DVec2, point: DVec3) -> Option<DVec2> {
        let surface = &display.screens[self.screen].surface;
        let picture = match self.projector(display) {
            Some(projector) => projector.lit_place(surface, point)?,
            None => self.part.place(uv),
        };
        self.viewport_of_picture(picture)
    }

    /// Rectangle on which the viewport's pixels lie in even rows, if there is one. [`frustum()`](crate::frustum())
    /// then replaces a map.
    pub fn flat(&self, display: &Display) -> Option<FlatSurface> {
        match &display.screens[self.screen].surface {
            ScreenSurface::Flat(flat) if self.warp.is_none() && self.projector.is_none() => {
                Some(flat.part(self.part.from, self.part.to))
            }
            _ => None,
        }
    }

    /// Place in the picture, point and normal that a place of the viewport lights through a projector.
    pub(crate) fn lit(&self, screen: &Screen, projector: &Projector, place: DVec2) -> Option<(DVec2, DVec3, DVec3)> {
        let picture = self.picture(place)?;
        let hit = screen.surface.hit(projector.position_m, projector.ray(picture)?)?;
        Some((picture, hit.point, hit.normal))
    }
}
