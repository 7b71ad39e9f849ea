//! The spectrum of a black body.
//!
//! Planck's law falls below every f64 far on its short-wave side: at 50 K, visible light is a factor e⁻⁶⁰⁰ down. The
//! functions here therefore take a `lift` and return e^lift times their value, so that a caller can compute the colour
//! of light that is too faint for an f64 and keep the logarithm of its brightness beside it.

/// Planck's constant, J s. This constant and the next two are exact (SI since 2019).
const PLANCK: f64 = 6.626_070_15e-34;
/// Speed of light, m s⁻¹.
const LIGHT: f64 = 299_792_458.0;
/// Boltzmann's constant, J K⁻¹.
const BOLTZMANN: f64 = 1.380_649e-23;

/// Exponent hc/λkT at the wavelength where the spectrum of any temperature is highest: x = 5 (1 − e⁻ˣ).
const EXPONENT_AT_MAXIMUM: f64 = 4.965_114_231_744_276;

/// Exponent hc/λkT, limited so that a difference of two is a number.
pub(super) fn exponent(kelvin: f64, nm: f64) -> f64 {
    /// Exponent beyond which nothing is left of any light.
    const LARGEST: f64 = 1e30;
    (PLANCK * LIGHT / BOLTZMANN / (nm * 1e-9 * kelvin)).min(LARGEST)
}

/// Spectral radiance of a black body, times e^lift.
///
/// *Equation:* L = 2hc²/λ⁵ · 1/(e^{hc/λkT} − 1) (W 3.4). *Units:* W sr⁻¹ m⁻³.
pub(super) fn radiance(kelvin: f64, nm: f64, lift: f64) -> f64 {
    2.0 * PLANCK * LIGHT * LIGHT / (nm * 1e-9).powi(5) * occupation(exponent(kelvin, nm), lift)
}

/// Spectral radiance as a share of its maximum over all wavelengths, times e^lift.
pub(super) fn share(kelvin: f64, nm: f64, lift: f64) -> f64 {
    let exponent = exponent(kelvin, nm);
    (exponent / EXPONENT_AT_MAXIMUM).powi(5) * occupation(exponent, lift) / occupation(EXPONENT_AT_MAXIMUM, 0.0)
}

/// Mean occupation e^lift / (eˣ − 1), without loss at either end.
fn occupation(x: f64, lift: f64) -> f64 {
    (lift - x).exp() / -(-x).exp_m1()
}
