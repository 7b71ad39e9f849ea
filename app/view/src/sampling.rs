//! Places within a pixel at which a picture is sampled.

use glam::DVec2;

/// Where sample `index` of `count` lies within its pixel: offsets from the centre in −½…½.
///
/// The additive recurrence on the plastic number (Roberts' R₂) fills the square evenly for every count; one
/// sample is the centre itself.
pub fn sample_offset(index: u32, count: u32) -> DVec2 {
    const PLASTIC: f64 = 1.324_717_957_244_746;
    if count <= 1 {
        return DVec2::ZERO;
    }
    let step = DVec2::new(1.0 / PLASTIC, 1.0 / (PLASTIC * PLASTIC));
    (DVec2::splat(0.5) + step * f64::from(index)).fract() - 0.5
}
