//! Carriers: the spectra that the colours of a surface are carried by.
//!
//! A renderer knows three weights per point, from textures, vertex colours and lamps. Their light is L(λ) = Q(λ) Σ cᵢ
//! Sᵢ(λ): the three shares of white ([`shares`]) of the carrier Q. For an ordinary scene Q is white, and the weights
//! are an sRGB colour; where equal weights are used, the light is Q itself, whatever its spectrum.

use glam::{DMat3, DVec3};

use super::shares::{far_white_xyz, shares};
use super::spectrum::Spectrum;
use super::{matching, srgb};

/// A spectrum Q(λ): white light, light that is sent out, or light that a surface returns.
#[derive(Clone, Debug, PartialEq)]
pub struct Carrier {
    light: Spectrum,
    reflectance: Option<Spectrum>,
}

impl Carrier {
    /// White light of 1 cd/m², the carrier of sRGB colours.
    pub fn white() -> Self {
        Self::emitted(Spectrum::Gray)
    }

    /// Light that is sent out with this spectrum.
    pub fn emitted(spectrum: Spectrum) -> Self {
        Self { light: spectrum, reflectance: None }
    }

    /// Light of an illuminant from a surface: reflectance × illuminant (W 3.3; B 2.4).
    ///
    /// A missing reflectance returns all wavelengths alike; a missing illuminant is white.
    pub fn reflected(reflectance: Option<Spectrum>, illuminant: Option<Spectrum>) -> Self {
        let light = illuminant.unwrap_or(Spectrum::Gray);
        Self { light, reflectance: reflectance.filter(|reflectance| *reflectance != Spectrum::Gray) }
    }

    /// Spectral radiance Q(λ). *Units:* nm; W sr⁻¹ m⁻³.
    pub fn radiance(&self, wavelength_nm: f64) -> f64 {
        self.lifted_radiance(wavelength_nm, [0.0; 2])
    }

    /// Tristimulus values of each weight alone, as columns, after the wavelengths have been shifted: of
    /// D (Q Sᵢ)(Dλ), which keeps the radiance of all wavelengths together. Brightness grows by D⁴ beside that.
    ///
    /// *Units:* cd/m². *Equation:* B 2.17, with X_ij D in the place of X_ij; integrated directly.
    pub fn xyz_from_weights(&self, doppler: f64) -> DMat3 {
        let (xyz, lift) = self.lifted_xyz_from_weights(doppler);
        xyz * (-lift).exp()
    }

    /// Linear sRGB of each weight alone, as columns: [`xyz_from_weights`](Self::xyz_from_weights) seen on a screen.
    /// Negative where sRGB cannot show it.
    pub fn rgb_from_weights(&self, doppler: f64) -> DMat3 {
        srgb::rgb_from_xyz() * self.xyz_from_weights(doppler)
    }

    /// Product of e^lift and [`xyz_from_weights`](Self::xyz_from_weights), and the lift, which is such that light too
    /// faint for any f64 keeps its colour.
    pub(super) fn lifted_xyz_from_weights(&self, doppler: f64) -> (DMat3, f64) {
        if let (Spectrum::Gray, None) = (&self.light, &self.reflectance)
            && let Some(xyz) = far_white_xyz(doppler)
        {
            return (xyz, 0.0);
        }
        self.integrated_xyz_from_weights(doppler)
    }

    /// As [`lifted_xyz_from_weights`](Self::lifted_xyz_from_weights), always integrated.
    fn integrated_xyz_from_weights(&self, doppler: f64) -> (DMat3, f64) {
        // Thermal light beyond Wien's maximum is strongest at the red end.
        let red_end = doppler * matching::LONGEST_NM;
        let lifts =
            [self.light.wien_exponent(red_end), self.reflectance.as_ref().map_or(0.0, |r| r.wien_exponent(red_end))];
        let weights = |nm: f64| DVec3::from_array(shares(nm)) * self.lifted_radiance(nm, lifts);
        (matching::xyz(doppler, self.bends(doppler), weights), lifts[0] + lifts[1])
    }

    fn lifted_radiance(&self, nm: f64, [light, reflectance]: [f64; 2]) -> f64 {
        self.light.lifted_radiance(nm, light)
            * self.reflectance.as_ref().map_or(1.0, |spectrum| spectrum.lifted_reflectance(nm, reflectance))
    }

    /// Wavelengths at which measured values meet, among those that are seen at this D, ascending. *Units:* nm.
    fn bends(&self, doppler: f64) -> Vec<f64> {
        let seen = || doppler * matching::SHORTEST_NM..doppler * matching::LONGEST_NM;
        let mut bends: Vec<f64> = self.light.bends_within(seen()).collect();
        if let Some(reflectance) = &self.reflectance {
            bends.extend(reflectance.bends_within(seen()));
            bends.sort_by(f64::total_cmp);
        }
        bends
    }
}

impl Spectrum {
    /// Tristimulus values (CIE 1931 2°), colour and brightness, of this light for an observer with the Doppler factor
    /// D.
    ///
    /// *Equation:* 683 ∫ D⁵ L(Dλ) x̄(λ) dλ over 360 … 830 nm, and so Y, Z (B 2.12). *Units:* cd/m². Not finite only
    /// where D⁵ L is beyond all numbers.
    pub fn xyz(&self, doppler: f64) -> DVec3 {
        Carrier::emitted(self.clone()).xyz_from_weights(doppler) * DVec3::splat(doppler.powi(4))
    }
}

#[cfg(test)]
mod tests {
    //! Law under test: far from visible light white is a power law. A program that takes it for one where the bump or
    //! the shares of colours can still be seen gets other colours.

    use super::*;

    /// Relative rounding error of sums of some hundred terms.
    const ROUNDING: f64 = 1e-12;

    #[test]
    fn far_white_is_a_power_law() {
        let white = Carrier::white();
        let mut far = 0;
        for node in -1400..=1400 {
            let doppler = (f64::from(node) * 0.01).exp();
            far += usize::from(far_white_xyz(doppler).is_some());
            let (short, _) = white.lifted_xyz_from_weights(doppler);
            let (whole, _) = white.integrated_xyz_from_weights(doppler);
            for (short, whole) in short.to_cols_array().into_iter().zip(whole.to_cols_array()) {
                assert!((short - whole).abs() <= ROUNDING * whole.abs(), "{short} instead of {whole} at D = {doppler}");
            }
        }
        assert!(far > 2400, "integrated at all but {far} of 2801 Doppler factors");
        assert!([0.4, 0.5, 1.0, 2.0].iter().all(|doppler| far_white_xyz(*doppler).is_none()));
    }
}
