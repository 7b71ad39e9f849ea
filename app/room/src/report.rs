//! Description of a display in words, for `rapidity check`.

use crate::channel::Channel;
use crate::display::{Display, Screen};
use crate::surface::shape::ScreenSurface;
use crate::window::{Combine, Monitor};
use glam::{DMat3, DVec2, DVec3};
use std::fmt::{Formatter, Result};

/// Largest number of places, each way, at which screens and viewports are examined.
const MOST_PROBES: u32 = 33;

/// Number of places of all channels together, at most, unless that leaves fewer than [`LEAST_PROBES`] each way.
const ALL_PROBES: f64 = 2e6;

/// Smallest number of places, each way.
const LEAST_PROBES: u32 = 3;

impl std::fmt::Display for Display {
    /// Writes the viewer, screens, projectors, windows, channels and notices.
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        let viewer = &self.viewer;
        let head = viewer.head_m;
        write!(
            f,
            "  eyes {} m apart, untracked head at {}, {}, {} m",
            viewer.eye_separation_m, head.x, head.y, head.z
        )?;
        if viewer.eye_scale != 1.0 {
            write!(f, ", {} times as far apart in the world", viewer.eye_scale)?;
        }
        // A display of very many channels is examined at fewer places each, so that the time stays in bounds.
        let each = ALL_PROBES / self.channels.len().max(1) as f64;
        let probes = (each.sqrt() as u32).clamp(LEAST_PROBES, MOST_PROBES);
        let mut shown: Vec<Vec<&Channel>> = vec![Vec::new(); self.screens.len()];
        for channel in &self.channels {
            shown[channel.screen].push(channel);
        }
        for (screen, channels) in self.screens.iter().zip(&shown) {
            write!(f, "\n  screen {:?}: {}", screen.name, measure(screen))?;
            let covered = 100.0 * covered(self, screen, channels, probes);
            let count = channels.len();
            write!(f, ", {covered:.0} % of it shown by {count} channel{}", if count == 1 { "" } else { "s" })?;
        }
        for projector in &self.projectors {
            let place = projector.position_m;
            write!(f, "\n  projector {:?} at {:.2}, {:.2}, {:.2} m", projector.name, place.x, place.y, place.z)?;
        }
        for window in &self.windows {
            write!(f, "\n  window {:?}: {} × {} pixels", window.name, window.size[0], window.size[1])?;
            match &window.monitor {
                Some(Monitor::Name(name)) => write!(f, " on monitor {name:?}")?,
                Some(Monitor::Index(index)) => write!(f, " on monitor {index}")?,
                None => {}
            }
            if window.fullscreen {
                write!(f, ", full screen")?;
            }
            if window.combine != Combine::None {
                write!(f, ", eyes combined by {}", window.combine.name())?;
            }
        }
        for channel in &self.channels {
            let [x, y, width, height] = channel.viewport;
            write!(
                f,
                "\n  channel {:?}: screen {:?}, {} eye, window {:?} at {x}, {y}, {width} × {height} pixels",
                channel.name,
                self.screens[channel.screen].name,
                channel.eye.name(),
                self.windows[channel.window].name,
            )?;
            let seen = seen(self, channel, probes);
            match seen.densities.as_slice() {
                [] => write!(f, ", lights nothing")?,
                all => {
                    let (least, most) = (all[0], all[all.len() - 1]);
                    write!(f, ", {least:.1} to {most:.1} pixels per degree")?;
                }
            }
            if seen.lit < 1.0 {
                write!(f, ", {:.0} % of them lit", 100.0 * seen.lit)?;
            }
        }
        for notice in &self.notices {
            write!(f, "\n  note: {notice}")?;
        }
        Ok(())
    }
}

fn measure(screen: &Screen) -> String {
    let kind = screen.surface.kind();
    match &screen.surface {
        ScreenSurface::Mesh(mesh) => {
            format!("{kind} of {} triangles, {:.2} m across", mesh.triangles().len(), mesh.size_m())
        }
        surface => {
            let size = surface.size_m();
            format!("{kind}, {:.2} m × {:.2} m", size.x, size.y)
        }
    }
}

/// Places spread evenly over the unit square, `probes` each way.
fn places(probes: u32) -> impl Iterator<Item = DVec2> {
    (0..probes * probes)
        .map(move |probe| (DVec2::new(f64::from(probe % probes), f64::from(probe / probes)) + 0.5) / f64::from(probes))
}

/// Share of a screen's places that at least one of its channels shows.
fn covered(display: &Display, screen: &Screen, channels: &[&Channel], probes: u32) -> f64 {
    let surface = &screen.surface;
    let points: Vec<(DVec2, DVec3)> = places(probes).filter_map(|uv| Some((uv, surface.point(uv)?))).collect();
    let shown =
        |&&(uv, point): &&(DVec2, DVec3)| channels.iter().any(|channel| channel.place_of(display, uv, point).is_some());
    points.iter().filter(shown).count() as f64 / points.len().max(1) as f64
}

/// View of a channel's pixels from its eye.
struct SeenPixels {
    /// Pixels per degree, coarsest first. One pixel counts as a square with the pixel's solid angle.
    densities: Vec<f64>,
    /// Share of the viewport that lights the screen.
    lit: f64,
}

fn seen(display: &Display, channel: &Channel, probes: u32) -> SeenPixels {
    let eye = display.viewer.eye_m(channel.eye, display.viewer.head_m, DMat3::IDENTITY);
    let pixel = channel.size().map(|side| 1.0 / f64::from(side));
    let direction = |place: DVec2| Some((channel.point(display, place)? - eye).normalize());
    let density = |place: DVec2| {
        let from = direction(place)?;
        let right = direction(place + DVec2::new(pixel[0], 0.0))? - from;
        let down = direction(place + DVec2::new(0.0, pixel[1]))? - from;
        Some(1.0 / right.cross(down).length().sqrt().to_degrees())
    };
    let lit = places(probes).filter(|&place| channel.point(display, place).is_some()).count();
    let mut densities: Vec<f64> = places(probes).filter_map(density).filter(|density| density.is_finite()).collect();
    densities.sort_by(f64::total_cmp);
    SeenPixels { densities, lit: lit as f64 / f64::from(probes * probes) }
}
