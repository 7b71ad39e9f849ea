//! Places within a pixel at which a picture is sampled.

use glam::DVec2;

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
