//! Brightness factors of pixels, which turn several projectors' light into one even picture (B 4.2, 5.1.6).
//!
//! Projector p delivers the luminance `L_p` (B eq. 4.5) to a point X at full white. It gets the share `w_p` of the
//! light there, `Σ w = 1`, and its pixel gets the factor `w_p · T / L_p`, with one target T for the whole screen. The
//! sum of factor times delivered luminance is then T everywhere. T is as large as possible without a factor above 1.

use crate::channel::Channel;
use crate::display::{Display, Screen};
use crate::projector::Projector;
use crate::viewer::EyeSide;
use glam::{DVec2, DVec3};
use rayon::prelude::*;

/// Number of places along and across each picture at which the target is computed.
const PROBES: u32 = 65;

/// Factors of a channel's pixels, in linear light.
#[derive(Clone, Debug, PartialEq)]
pub struct Gains {
    /// Width and height, pixels.
    pub size: [u32; 2],
    /// Multipliers of the light, 0 to 1, row by row from the upper left: brightness correction × blending × the
    /// channel's own map. The factor of a pixel that lights nothing has no meaning; in particular it does not make
    /// the pixel black.
    pub factors: Vec<f32>,
    /// Light added afterwards, so that dark parts look alike where projectors' black levels add up; `None` if nothing
    /// is added.
    pub lifts: Option<Vec<f32>>,
}

/// Projectors whose pictures form one: the channels of one eye on one screen.
struct ProjectorGroup<'a> {
    screen: &'a Screen,
    viewer_m: DVec3,
    members: Vec<(&'a Channel, &'a Projector)>,
}

impl<'a> ProjectorGroup<'a> {
    fn of(display: &'a Display, screen: usize, eye: EyeSide) -> Self {
        let members = display
            .channels
            .iter()
            .filter(|channel| channel.screen == screen && channel.eye == eye)
            .filter_map(|channel| Some((channel, channel.projector(display)?)))
            .collect();
        Self { screen: &display.screens[screen], viewer_m: display.viewer.head_m, members }
    }

    /// Luminance of a projector's white towards the viewer.
    fn delivered(&self, projector: &Projector, place: DVec2, point: DVec3, normal: DVec3) -> Option<f64> {
        let to_projector = projector.position_m - point;
        let reflected = self.screen.reflection.toward(to_projector, self.viewer_m - point, normal);
        Some(projector.illuminance(place, point, normal)? * reflected).filter(|light| light.is_finite() && *light > 0.0)
    }

    /// Share of one channel in the light at a point that the channel shows at the place `viewport`.
    fn weight(&self, channel: &Channel, projector: &Projector, viewport: DVec2, point: DVec3) -> f64 {
        if !projector.blend {
            return 1.0;
        }
        let own = channel.ramp(viewport);
        let others = self.members.iter().filter(|(other, projector)| other.name != channel.name && projector.blend);
        let ramps = others.filter_map(|(other, projector)| {
            let picture = projector.lit_place(&self.screen.surface, point)?;
            Some(other.ramp(other.viewport_of_picture(picture)?))
        });
        let (count, sum) = ramps.fold((1.0, own), |(count, sum), ramp| (count + 1.0, sum + ramp));
        // On the very edge of all pictures, all ramps are 0.
        if sum > 0.0 { own / sum } else { 1.0 / count }
    }

    /// Largest luminance that the members together can give to every place they reach.
    fn target(&self) -> f64 {
        let places: Vec<DVec2> = (0..PROBES * PROBES)
            .map(|probe| DVec2::new(f64::from(probe % PROBES), f64::from(probe / PROBES)) / f64::from(PROBES - 1))
            .collect();
        let limit = |&(channel, projector): &(&Channel, &Projector), viewport: DVec2| {
            let (picture, point, normal) = channel.lit(self.screen, projector, viewport)?;
            let weight = self.weight(channel, projector, viewport, point);
            Some(self.delivered(projector, picture, point, normal)? / weight)
        };
        self.members
            .iter()
            .filter(|(_, projector)| projector.even)
            .flat_map(|member| places.par_iter().filter_map(|&place| limit(member, place)).collect::<Vec<_>>())
            .fold(f64::INFINITY, f64::min)
    }
}

impl Channel {
    /// Factors of the channel's pixels at `size` pixels spread evenly over the viewport; `None` if all are 1.
    pub fn gains(&self, display: &Display, size: [u32; 2]) -> Option<Gains> {
        let projector = self.projector(display);
        let group = ProjectorGroup::of(display, self.screen, self.eye);
        let alone = projector.is_none_or(|projector| !projector.even && (!projector.blend || group.members.len() == 1));
        if alone && self.alpha.is_none() && self.beta.is_none() {
            return None;
        }
        let target = if projector.is_some_and(|projector| projector.even) { group.target() } else { 1.0 };
        let factor = |viewport: DVec2| -> Option<f64> {
            let Some(projector) = projector else { return Some(1.0) };
            let (picture, point, normal) = self.lit(group.screen, projector, viewport)?;
            let weight = group.weight(self, projector, viewport, point);
            if !projector.even {
                return Some(weight);
            }
            Some((weight * target / group.delivered(projector, picture, point, normal)?).min(1.0))
        };

        // Each pixel is computed on its own. NaN marks a pixel that lights nothing.
        let pixels = DVec2::new(f64::from(size[0]), f64::from(size[1]));
        let place = |index: usize| {
            let (x, y) = (index % size[0] as usize, index / size[0] as usize);
            (DVec2::new(x as f64, y as f64) + 0.5) / pixels
        };
        let count = size[0] as usize * size[1] as usize;
        let lit: Vec<f32> =
            (0..count).into_par_iter().map(|index| factor(place(index)).map_or(f32::NAN, |f| f as f32)).collect();

        let beta = |place: DVec2| self.beta.as_ref().map_or(0.0, |map| map.at(place));
        let alpha = |place: DVec2| self.alpha.as_ref().map_or(1.0, |map| map.at(place));
        let own = |index: usize| alpha(place(index)) * (1.0 - beta(place(index)));
        let factors = (0..count).map(|index| continued(&lit, size, index) * own(index)).collect();
        let lifts = self.beta.is_some().then(|| (0..count).map(|index| beta(place(index))).collect());
        Some(Gains { size, factors, lifts })
    }
}

/// Factor of a pixel. For a pixel that lights nothing, it is the mean of its lit neighbours, so that interpolation
/// between pixel centres does not mix the last lit pixel with black.
fn continued(lit: &[f32], [width, height]: [u32; 2], index: usize) -> f32 {
    if !lit[index].is_nan() {
        return lit[index];
    }
    let (width, height) = (width as usize, height as usize);
    let (x, y) = (index % width, index / width);
    let near = |at: usize, count: usize| at.saturating_sub(1)..(at + 2).min(count);
    let beside = near(y, height).flat_map(|row| near(x, width).map(move |column| row * width + column));
    let (count, sum) = beside
        .map(|index| lit[index])
        .filter(|factor| !factor.is_nan())
        .fold((0.0_f32, 0.0), |(count, sum), factor| (count + 1.0, sum + factor));
    if count > 0.0 { sum / count } else { 0.0 }
}
