//! Measured maps of the factors of a channel's pixels.

use glam::DVec2;
use std::sync::Arc;

/// Measured map of a channel's pixels: linear light, 0 to 1, of any size. Copies share their samples.
#[derive(Clone, Debug, PartialEq)]
pub struct GainMap {
    /// Width and height, samples.
    pub size: [u32; 2],
    /// Samples row by row from the upper left.
    pub values: Arc<Vec<f32>>,
}

impl GainMap {
    /// Value at a place of the viewport (0 to 1, y down), bilinear between the centres of the map's samples.
    pub fn at(&self, place: DVec2) -> f32 {
        let size = DVec2::new(f64::from(self.size[0]), f64::from(self.size[1]));
        let scaled = (place * size - 0.5).clamp(DVec2::ZERO, size - 1.0);
        let (low, part) = (scaled.floor(), scaled.fract());
        let high = (low + 1.0).min(size - 1.0);
        let value = |x: f64, y: f64| f64::from(self.values[y as usize * self.size[0] as usize + x as usize]);
        let above = value(low.x, low.y) * (1.0 - part.x) + value(high.x, low.y) * part.x;
        let below = value(low.x, high.y) * (1.0 - part.x) + value(high.x, high.y) * part.x;
        (above * (1.0 - part.y) + below * part.y) as f32
    }
}
