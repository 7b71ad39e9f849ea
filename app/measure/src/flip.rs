//! FLIP, the visible difference between two pictures on a screen that alternate in the same place.
//!
//! *Source:* Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström and Fairchild, *FLIP: A Difference Evaluator for
//! Alternating Images*, Proceedings of the ACM on Computer Graphics and Interactive Techniques 3 (2), 2020; equation
//! numbers below are those of the paper. In words:
//!
//! - **Colour.** The eye blurs fine patterns, those of colour more than those of brightness, so each picture is
//!   filtered by the eye's contrast sensitivity. The filtered colours differ by the HyAB distance in CIELAB, in which
//!   dark colours count for less (Hunt's effect); large differences are compressed.
//! - **Features.** If an edge or a point is in one picture and not in the other, the difference is more visible.
//!
//! The distance of a pixel is ΔE_colour^(1 − ΔE_features), from 0, alike, to 1. The distance of two pictures is the
//! mean over their pixels.

use std::f64::consts::PI;

use glam::DVec3;
use physics::colour::difference::lab_from_xyz;
use physics::colour::{rgb_from_xyz, xyz_from_rgb};
use rayon::prelude::*;

/// Pixels in a degree of the field of view, at 0.7 m from a screen that is 0.7 m wide and 3840 pixels across (section
/// 4.1).
pub const PIXELS_PER_DEGREE: f64 = 3840.0 * PI / 180.0;

/// Contrast sensitivity for luminance, red–green and blue–yellow, as sums of Gaussians over the angle in degrees
/// (table 1): weight a and breadth b of each.
const LUMINANCE: &[[f64; 2]] = &[[1.0, 0.0047]];
const RED_GREEN: &[[f64; 2]] = &[[1.0, 0.0053]];
const BLUE_YELLOW: &[[f64; 2]] = &[[34.1, 0.04], [13.5, 0.025]];
/// Largest breadth of all, which decides the reach of the filters.
const BROADEST: f64 = 0.04;

/// Exponent that compresses differences of colour (q_c, eq. 12), and the share of the largest difference up to which
/// the compressed one rises to `KNEE_HEIGHT` (p_c and p_t, eq. 13).
const COLOUR_EXPONENT: f64 = 0.7;
const KNEE: f64 = 0.4;
const KNEE_HEIGHT: f64 = 0.95;

/// Breadth of an edge or point that the eye can see, degrees (w, section 4.3), and the exponent of its difference
/// (q_f, eq. 15).
const FEATURE_DEGREES: f64 = 0.082;
const FEATURE_EXPONENT: f64 = 0.5;

/// Picture in the form in which FLIP compares it.
#[derive(Clone, Debug, PartialEq)]
pub struct Perceived {
    size: [u32; 2],
    /// CIELAB colours after filtering, with a* and b* by Hunt's effect.
    lab: Vec<DVec3>,
    edges: Vec<f64>,
    points: Vec<f64>,
}

impl Perceived {
    /// Perceived form of linear sRGB colours from 0 to 1, row by row.
    pub fn new(size: [u32; 2], rgb: &[DVec3], pixels_per_degree: f64) -> Self {
        let white = xyz_from_rgb() * DVec3::ONE;
        let opponent: Vec<DVec3> = rgb.iter().map(|rgb| opponent_from_xyz(xyz_from_rgb() * *rgb / white)).collect();
        let channel = |index: usize| Plane { size, values: opponent.iter().map(|colour| colour[index]).collect() };
        let luminance = channel(0);

        // Filter by contrast sensitivity, then limit the colours to those of the screen.
        let radius = (3.0 * (BROADEST / (2.0 * PI * PI)).sqrt() * pixels_per_degree).ceil() as i32;
        let filtered = [(luminance.clone(), LUMINANCE), (channel(1), RED_GREEN), (channel(2), BLUE_YELLOW)]
            .map(|(plane, gaussians)| plane.contrast(gaussians, radius, pixels_per_degree));
        let lab = (0..rgb.len()).into_par_iter().map(|pixel| {
            let xyz = xyz_from_opponent(DVec3::from(filtered.each_ref().map(|plane| plane.values[pixel]))) * white;
            let shown = (rgb_from_xyz() * xyz).clamp(DVec3::ZERO, DVec3::ONE);
            hunt(lab_from_xyz(xyz_from_rgb() * shown, white))
        });
        let lab = lab.collect();

        let luminance = Plane { values: luminance.values.iter().map(|y| (y + 16.0) / 116.0).collect(), ..luminance };
        let [edges, points] = luminance.features(pixels_per_degree);
        Self { size, lab, edges, points }
    }
}

/// Distance of each pixel, 0 to 1, row by row. Both pictures must have the same size.
pub fn distances(first: &Perceived, second: &Perceived) -> Vec<f64> {
    debug_assert_eq!(first.size, second.size);
    let largest = largest_difference();
    let pixels = (0..first.lab.len().min(second.lab.len())).into_par_iter();
    let distance = |pixel: usize| {
        let colour = compressed(hyab(first.lab[pixel], second.lab[pixel]).powf(COLOUR_EXPONENT), largest);
        let edge = (first.edges[pixel] - second.edges[pixel]).abs();
        let point = (first.points[pixel] - second.points[pixel]).abs();
        let feature = (edge.max(point) / 2.0_f64.sqrt()).powf(FEATURE_EXPONENT);
        colour.powf(1.0 - feature)
    };
    pixels.map(distance).collect()
}

/// Mean of the pixels' distances, which is the distance of the pictures.
pub fn mean(distances: &[f64]) -> f64 {
    distances.iter().sum::<f64>() / distances.len().max(1) as f64
}

/// Opponent colour Y C_x C_z of tristimulus values relative to white: CIELAB without its cube roots (eq. 2).
fn opponent_from_xyz(xyz: DVec3) -> DVec3 {
    DVec3::new(116.0 * xyz.y - 16.0, 500.0 * (xyz.x - xyz.y), 200.0 * (xyz.y - xyz.z))
}

fn xyz_from_opponent(opponent: DVec3) -> DVec3 {
    let y = (opponent.x + 16.0) / 116.0;
    DVec3::new(y + opponent.y / 500.0, y, y - opponent.z / 200.0)
}

/// Colour with Hunt's effect: colours look paler in the dark (eq. 9).
fn hunt(lab: DVec3) -> DVec3 {
    let factor = 0.01 * lab.x;
    DVec3::new(lab.x, factor * lab.y, factor * lab.z)
}

/// HyAB distance of two colours, for large differences a better measure than the Euclidean distance (eq. 10).
fn hyab(first: DVec3, second: DVec3) -> f64 {
    let apart = first - second;
    apart.x.abs() + apart.y.hypot(apart.z)
}

/// Largest difference of colours, compressed: that of the screen's green and blue (eq. 11).
fn largest_difference() -> f64 {
    let white = xyz_from_rgb() * DVec3::ONE;
    let [green, blue] = [DVec3::Y, DVec3::Z].map(|rgb| hunt(lab_from_xyz(xyz_from_rgb() * rgb, white)));
    hyab(green, blue).powf(COLOUR_EXPONENT)
}

/// Difference mapped to 0 to 1, most of the range for differences below the knee (eq. 13).
fn compressed(difference: f64, largest: f64) -> f64 {
    let knee = KNEE * largest;
    if difference < knee {
        difference * KNEE_HEIGHT / knee
    } else {
        KNEE_HEIGHT + (difference - knee) / (largest - knee) * (1.0 - KNEE_HEIGHT)
    }
}

/// One number for each pixel, row by row.
#[derive(Clone)]
struct Plane {
    size: [u32; 2],
    values: Vec<f64>,
}

impl Plane {
    /// Plane filtered by Gaussians whose sum over the square of the radius is 1 (eq. 5 to 7).
    fn contrast(&self, gaussians: &[[f64; 2]], radius: i32, pixels_per_degree: f64) -> Self {
        let kernels: Vec<(f64, Vec<f64>)> = gaussians
            .iter()
            .map(|&[weight, breadth]| {
                let degrees = |pixels: i32| f64::from(pixels) / pixels_per_degree;
                let value = |pixels| (-(PI * degrees(pixels)).powi(2) / breadth).exp();
                (weight * (PI / breadth).sqrt(), (-radius..=radius).map(value).collect())
            })
            .collect();
        let total: f64 = kernels.iter().map(|(weight, kernel)| weight * kernel.iter().sum::<f64>().powi(2)).sum();
        let mut sum = vec![0.0; self.values.len()];
        for (weight, kernel) in &kernels {
            let blurred = self.across(kernel).down(kernel);
            sum.iter_mut().zip(&blurred.values).for_each(|(sum, value)| *sum += weight / total * value);
        }
        Self { size: self.size, values: sum }
    }

    /// Strength of the edge and of the point at each pixel: lengths of the filtered gradient and second derivative
    /// (section 4.3).
    fn features(&self, pixels_per_degree: f64) -> [Vec<f64>; 2] {
        let deviation = 0.5 * FEATURE_DEGREES * pixels_per_degree;
        let radius = (3.0 * deviation).ceil() as i32;
        let kernel = |factor: fn(f64) -> f64| -> Vec<f64> {
            let value = |pixels: i32| {
                let place = f64::from(pixels) / deviation;
                factor(place) * (-0.5 * place * place).exp()
            };
            (-radius..=radius).map(value).collect()
        };
        let smooth = balanced(kernel(|_| 1.0));
        let slope = balanced(kernel(|place| -place));
        let curve = balanced(kernel(|place| place * place - 1.0));
        let along = |kernel: &[f64]| {
            let (x, y) = (self.across(kernel).down(&smooth), self.across(&smooth).down(kernel));
            x.values.iter().zip(&y.values).map(|(x, y)| x.hypot(*y)).collect()
        };
        [along(&slope), along(&curve)]
    }

    /// Plane with each row filtered. Rows continue beyond their ends with the end value.
    fn across(&self, kernel: &[f64]) -> Self {
        let width = self.size[0] as usize;
        let radius = kernel.len() / 2;
        let mut values = vec![0.0; self.values.len()];
        let rows = values.par_chunks_mut(width.max(1)).zip(self.values.par_chunks(width.max(1)));
        rows.for_each(|(filtered, row)| {
            for (place, value) in filtered.iter_mut().enumerate() {
                let at = |tap: usize| row[(place + tap).saturating_sub(radius).min(width - 1)];
                *value = kernel.iter().enumerate().map(|(tap, weight)| weight * at(tap)).sum();
            }
        });
        Self { size: self.size, values }
    }

    /// Plane with each column filtered.
    fn down(&self, kernel: &[f64]) -> Self {
        let [width, height] = self.size.map(|side| side as usize);
        let radius = kernel.len() / 2;
        let mut values = vec![0.0; self.values.len()];
        values.par_chunks_mut(width.max(1)).enumerate().for_each(|(row, filtered)| {
            for (tap, weight) in kernel.iter().enumerate() {
                let from = (row + tap).saturating_sub(radius).min(height - 1) * width;
                let source = &self.values[from..from + width];
                filtered.iter_mut().zip(source).for_each(|(value, source)| *value += weight * source);
            }
        });
        Self { size: self.size, values }
    }
}

/// A kernel whose positive values add up to 1, and whose negative ones to −1.
fn balanced(mut kernel: Vec<f64>) -> Vec<f64> {
    let sum = |sign: f64| kernel.iter().map(|value| (sign * value).max(0.0)).sum::<f64>();
    let (above, below) = (sum(1.0), sum(-1.0));
    kernel.iter_mut().for_each(|value| *value /= if *value < 0.0 { below } else { above });
    kernel
}

#[cfg(test)]
mod tests;
