//! Daylight in the world frame, and what is seen infinitely far away.

use glam::Vec3;

/// Daylight in the world frame: the light on lit materials, and the sky seen where no surface is.
///
/// Colours are linear radiance on the scale where a white unlit surface is 1. A lit surface of albedo ρ sends out
/// ρ (sun · max(0, n·s) · visibility + sky hemisphere), so sun + sky near 1 keeps whites just below clipping.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lighting {
    /// Unit vector towards the sun, world axes.
    pub sun_direction: Vec3,
    /// Light of the sun on a surface that faces it.
    pub sun: [f32; 3],
    /// Light from above, on a surface that faces up.
    pub sky: [f32; 3],
    /// Light bounced from the ground, on a surface that faces down.
    pub ground: [f32; 3],
    /// Sky seen at the zenith.
    pub zenith: [f32; 3],
    /// Sky seen at the horizon.
    pub horizon: [f32; 3],
    /// True if the sun casts shadows.
    pub shadows: bool,
}

impl Default for Lighting {
    /// Light of a clear late morning.
    fn default() -> Self {
        Self {
            sun_direction: Vec3::new(0.45, 0.75, 0.48).normalize(),
            sun: [0.80, 0.74, 0.64],
            sky: [0.30, 0.36, 0.46],
            ground: [0.16, 0.14, 0.12],
            zenith: [0.16, 0.32, 0.66],
            horizon: [0.62, 0.74, 0.86],
            shadows: true,
        }
    }
}
