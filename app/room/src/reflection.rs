//! Reflection of the projectors' light by a screen.

use glam::DVec3;

/// Reflection of light by a screen.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Reflection {
    /// Share of the light that goes into a lobe around the mirror direction; the rest is ideally diffuse. 0 for a
    /// matt screen.
    pub gloss: f64,
    /// Exponent of the cosine in the lobe: the larger it is, the narrower the lobe.
    pub exponent: f64,
}

impl Reflection {
    /// Share of the light falling on a point that reaches the viewer, per steradian: B(θ_P, θ_B) of B eq. 4.5.
    ///
    /// *Equation.* Lambert's 1/π and a normalised Phong lobe, (n + 1)/2π · cosⁿ of the angle to the mirror direction.
    pub fn toward(&self, to_projector: DVec3, to_viewer: DVec3, normal: DVec3) -> f64 {
        use std::f64::consts::{FRAC_1_PI, TAU};
        if self.gloss == 0.0 {
            return FRAC_1_PI;
        }
        let mirror = 2.0 * to_projector.dot(normal) * normal - to_projector;
        let cosine = mirror.normalize().dot(to_viewer.normalize()).max(0.0);
        let lobe = (self.exponent + 1.0) / TAU * cosine.powf(self.exponent);
        (1.0 - self.gloss) * FRAC_1_PI + self.gloss * lobe
    }
}
