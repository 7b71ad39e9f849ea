//! The spectra that a material or a light may have.
//!
//! One type serves for light and for reflectance, since a scene file gives either in the same words;
//! [`Spectrum::reflectance`] says what a Planck spectrum, say, means as a reflectance.

use std::ops::Range;
use std::sync::Arc;

use glam::DVec3;
use thiserror::Error;

use super::planck;
use super::shares::{shares, white};

/// The spectrum of light that is sent out, or of the share of light that a surface returns.
#[derive(Clone, Debug, PartialEq)]
pub enum Spectrum {
    /// A black body of this temperature.
    Planck {
        /// Kelvin, above 0 and finite.
        kelvin: f64,
    },
    /// Values measured at given wavelengths.
    Sampled(SampledSpectrum),
    /// The smooth spectrum of a linear sRGB colour.
    Rgb([f64; 3]),
    /// An even spectrum, as far as the eye can tell: white light, or a reflectance of 1 at every wavelength.
    Gray,
}

/// Values at given wavelengths: linear between them, constant beyond the ends. Cheap to clone.
#[derive(Clone, Debug, PartialEq)]
pub struct SampledSpectrum {
    samples: Arc<[[f64; 2]]>,
}

/// The reasons why numbers are no spectrum.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum SpectrumError {
    /// A temperature that is zero, negative or not finite.
    #[error("expected a temperature in kelvin, a finite number above 0, not {kelvin}")]
    Temperature {
        /// Value given.
        kelvin: f64,
    },
    /// A list without samples.
    #[error("expected at least one sample of [wavelength in nm, value]")]
    Empty,
    /// A wavelength that is not a positive number, or out of order.
    #[error("expected wavelengths in nm, above 0 and ascending, but sample {index} is at {nm}")]
    Wavelength {
        /// Index of the sample, from 0.
        index: usize,
        /// Value given.
        nm: f64,
    },
    /// A value below zero or not finite.
    #[error("expected values of 0 or more, but sample {index} is {value}")]
    Value {
        /// Index of the sample, from 0.
        index: usize,
        /// Value given.
        value: f64,
    },
    /// A colour with a channel that is negative or not finite.
    #[error("expected three finite numbers of 0 or more as colour, not {rgb:?}")]
    Colour {
        /// Value given.
        rgb: [f64; 3],
    },
}

impl Spectrum {
    /// A black body. *Units:* kelvin.
    ///
    /// # Errors
    /// [`SpectrumError::Temperature`].
    pub fn planck(kelvin: f64) -> Result<Self, SpectrumError> {
        if kelvin.is_finite() && kelvin > 0.0 {
            Ok(Self::Planck { kelvin })
        } else {
            Err(SpectrumError::Temperature { kelvin })
        }
    }

    /// Samples of [wavelength in nm, value], ascending.
    ///
    /// # Errors
    /// [`SpectrumError`], about the first bad sample.
    pub fn sampled(samples: impl Into<Arc<[[f64; 2]]>>) -> Result<Self, SpectrumError> {
        SampledSpectrum::new(samples).map(Self::Sampled)
    }

    /// A linear sRGB colour.
    ///
    /// # Errors
    /// [`SpectrumError::Colour`].
    pub fn rgb(rgb: [f64; 3]) -> Result<Self, SpectrumError> {
        if rgb.iter().all(|channel| channel.is_finite() && *channel >= 0.0) {
            Ok(Self::Rgb(rgb))
        } else {
            Err(SpectrumError::Colour { rgb })
        }
    }

    /// Spectral radiance L(λ), if this is the spectrum of light.
    ///
    /// A black body's is that of its temperature, measured values are taken as they are, and colours are parts of
    /// [`white`]. *Units:* nm; W sr⁻¹ m⁻³.
    pub fn radiance(&self, wavelength_nm: f64) -> f64 {
        self.lifted_radiance(wavelength_nm, 0.0)
    }

    /// Reflectance ρ(λ), the share of light that is returned, if this is the spectrum of a surface.
    ///
    /// Measured values are taken as they are, also above 1; a colour returns Σ cᵢ Sᵢ, and a thermal spectrum what it is
    /// of its own maximum. *Units:* nm.
    pub fn reflectance(&self, wavelength_nm: f64) -> f64 {
        self.lifted_reflectance(wavelength_nm, 0.0)
    }

    /// Radiance, times e^lift.
    pub(super) fn lifted_radiance(&self, nm: f64, lift: f64) -> f64 {
        match self {
            Self::Planck { kelvin } => planck::radiance(*kelvin, nm, lift),
            Self::Sampled(sampled) => sampled.at(nm),
            Self::Rgb(_) | Self::Gray => self.reflectance(nm) * white(nm),
        }
    }

    /// Reflectance, times e^lift.
    pub(super) fn lifted_reflectance(&self, nm: f64, lift: f64) -> f64 {
        match self {
            Self::Planck { kelvin } => planck::share(*kelvin, nm, lift),
            Self::Sampled(sampled) => sampled.at(nm),
            Self::Rgb(rgb) => DVec3::from_array(*rgb).dot(DVec3::from_array(shares(nm))),
            Self::Gray => 1.0,
        }
    }

    /// Logarithm by which Wien's law takes light of this wavelength down; 0 for a spectrum that is not thermal.
    pub(super) fn wien_exponent(&self, nm: f64) -> f64 {
        match self {
            Self::Planck { kelvin } => planck::exponent(*kelvin, nm),
            Self::Sampled(_) | Self::Rgb(_) | Self::Gray => 0.0,
        }
    }

    /// The wavelengths within this range at which the spectrum is not smooth, ascending. *Units:* nm.
    pub(super) fn bends_within(&self, nm: Range<f64>) -> impl Iterator<Item = f64> {
        let samples = match self {
            Self::Sampled(sampled) => sampled.within(nm),
            Self::Planck { .. } | Self::Rgb(_) | Self::Gray => &[],
        };
        samples.iter().map(|[nm, _]| *nm)
    }
}

impl SampledSpectrum {
    /// Checks samples of [wavelength in nm, value] and keeps them.
    ///
    /// # Errors
    /// [`SpectrumError`], about the first bad sample.
    pub fn new(samples: impl Into<Arc<[[f64; 2]]>>) -> Result<Self, SpectrumError> {
        let samples = samples.into();
        if samples.is_empty() {
            return Err(SpectrumError::Empty);
        }
        let mut before = 0.0;
        for (index, &[nm, value]) in samples.iter().enumerate() {
            if !nm.is_finite() || nm <= before {
                return Err(SpectrumError::Wavelength { index, nm });
            }
            if !value.is_finite() || value < 0.0 {
                return Err(SpectrumError::Value { index, value });
            }
            before = nm;
        }
        Ok(Self { samples })
    }

    /// The samples, ascending in wavelength: [nm, value].
    pub fn samples(&self) -> &[[f64; 2]] {
        &self.samples
    }

    /// The value at a wavelength in nm.
    fn at(&self, nm: f64) -> f64 {
        let above = self.samples.partition_point(|[sample_nm, _]| *sample_nm <= nm);
        match (above.checked_sub(1).map(|below| self.samples[below]), self.samples.get(above)) {
            (Some([left, low]), Some([right, high])) => low + (high - low) * ((nm - left) / (right - left)),
            (Some([_, end]), None) | (None, Some(&[_, end])) => end,
            (None, None) => 0.0,
        }
    }

    /// The samples at these wavelengths in nm.
    fn within(&self, nm: Range<f64>) -> &[[f64; 2]] {
        let below = |limit: f64| self.samples.partition_point(|[sample_nm, _]| *sample_nm < limit);
        let start = below(nm.start);
        &self.samples[start..below(nm.end).max(start)]
    }
}
