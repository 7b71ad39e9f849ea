//! Spectra and colours: spectral radiance, its Doppler shift, and the colour that an observer in motion sees.
//!
//! Light of the Doppler factor D has the spectral radiance L'(λ) = D⁵ L(Dλ) (W 4.8, whose D is 1/D; B 2.5). Its colour
//! is three integrals of that, which depend on D and on the whole spectrum at once. Between a scene and the screen
//! there are therefore:
//!
//! - a [`Spectrum`]: what a scene file says about a material or a light;
//! - a [`Carrier`]: the spectrum Q(λ) that shines in the end, a light or a reflectance times a light. Surfaces have
//!   three weights of it, the three [`shares`] of [`white`] that make sRGB colours of a white carrier;
//! - the [`ShiftTable`]: the colour of every carrier and weight over D, for the graphics card.
//!
//! The shift of wavelengths and the searchlight effect differ in where the five powers of D go: D L(Dλ) is the shift
//! alone, which keeps the radiance of all wavelengths together, and D⁴ is the brightness.

mod carrier;
pub mod difference;
mod matching;
mod planck;
mod shares;
mod shift_table;
pub mod spectrum;
mod srgb;
mod table;

pub use carrier::Carrier;
pub use shares::{shares, white};
pub use shift_table::ShiftTable;
pub use spectrum::{SampledSpectrum, Spectrum, SpectrumError};
pub use srgb::{luminance, rgb_from_xyz, xyz_from_rgb};
