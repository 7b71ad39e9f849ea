//! Places within a pixel at which a picture is sampled.

use glam::DVec2;

/// Sample of a picture: a place within each pixel, and the part of the pixel that it stands for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PixelSample {
    /// Place from the pixel's centre, pixels, x right and y down.
    pub offset: DVec2,
    /// Width of what it stands for, pixels: textures are averaged over that, so that the mean of all samples is the
    /// mean over the pixel, and not over its neighbours too.
    pub width: f64,
}

impl PixelSample {
    /// Sample that stands for the whole pixel.
    pub const WHOLE: Self = Self { offset: DVec2::ZERO, width: 1.0 };

    /// Sample `index` of `count`.
    pub fn of(index: u32, count: u32) -> Self {
        Self { offset: sample_offset(index, count), width: 1.0 / f64::from(count.max(1)).sqrt() }
    }
}

/// Offset of sample `index` of `count` from the centre of its pixel, pixels, in −½…½.
///
/// The additive recurrence on the plastic number (Roberts' R₂) fills the square evenly for every count. A single
/// sample is at the centre.
pub fn sample_offset(index: u32, count: u32) -> DVec2 {
    const PLASTIC: f64 = 1.324_717_957_244_746;
    if count <= 1 {
        return DVec2::ZERO;
    }
    let step = DVec2::new(1.0 / PLASTIC, 1.0 / (PLASTIC * PLASTIC));
    (DVec2::splat(0.5) + step * f64::from(index)).fract() - 0.5
}
