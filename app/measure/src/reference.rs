//! Reference picture, traced ray by ray, and the comparison of other pictures with it.

use std::sync::atomic::AtomicBool;

use glam::DVec3;
use image::Rgb32FImage;

use super::colour;
use super::flip::{self, PIXELS_PER_DEGREE, Perceived};
use super::quantiles::Sorted;
use trace::RayTracer;
use view::Shot;

/// Reference picture of one shot.
pub struct Reference {
    size: [u32; 2],
    exposure: f64,
    developed: Vec<DVec3>,
    perceived: Perceived,
}

/// Differences of one picture from the reference.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Compared {
    /// ΔE2000 of each pixel.
    pub delta_e: Sorted,
    /// Mean distance by FLIP.
    pub flip: f64,
}

impl Reference {
    /// Traces the reference picture of a shot.
    pub fn trace(tracer: &RayTracer, shot: &Shot, size: [u32; 2], samples: u32, stop: &AtomicBool) -> Self {
        let traced = tracer.trace(shot, size, samples, stop, || {});
        let exposure = colour::exposure(&traced.light, &traced.at_rest, traced.stored.white);
        let developed: Vec<DVec3> = traced.light.iter().map(|light| colour::developed(*light, exposure)).collect();
        let perceived = Perceived::new(size, &developed, PIXELS_PER_DEGREE);
        Self { size, exposure, developed, perceived }
    }

    /// Develops `light`, linear sRGB in cd/m², by the exposure of the reference, and compares.
    pub fn compare(&self, light: &Rgb32FImage) -> Compared {
        let light = light.pixels().map(|pixel| DVec3::from(pixel.0.map(f64::from)));
        let developed: Vec<DVec3> = light.map(|light| colour::developed(light, self.exposure)).collect();
        let perceived = Perceived::new(self.size, &developed, PIXELS_PER_DEGREE);
        Compared {
            delta_e: colour::differences(&self.developed, &developed),
            flip: flip::mean(&flip::distances(&self.perceived, &perceived)),
        }
    }
}
