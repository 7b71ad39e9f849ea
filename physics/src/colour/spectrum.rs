//! The spectra that a material or a light may have.

use std::sync::Arc;
use thiserror::Error;

/// A spectrum: of light that is sent out, or of the share of light that a surface returns.
#[derive(Clone, Debug, PartialEq)]
pub enum Spectrum {
    /// A black body of this temperature.
    Planck {
        /// Kelvin, above 0 and finite.
        kelvin: f64,
    },
    /// Measured values.
    Sampled(Sampled),
    /// The smooth spectrum of a linear sRGB colour.
    Rgb([f64; 3]),
    /// The same at every wavelength as far as the eye can tell: white light, or an even reflectance of 1.
    Gray,
}

/// Values at given wavelengths: linear between them, constant beyond the ends. Cheap to clone.
#[derive(Clone, Debug, PartialEq)]
pub struct Sampled {
    samples: Arc<[[f64; 2]]>,
}

/// Why numbers are no spectrum.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum SpectrumError {
    /// No body is that cold, or that hot.
    #[error("expected a temperature in kelvin, a finite number above 0, not {kelvin}")]
    Temperature {
        /// As given.
        kelvin: f64,
    },
    /// Too few samples.
    #[error("expected at least one sample of [wavelength in nm, value]")]
    Empty,
    /// A wavelength that is none, or out of order.
    #[error("expected wavelengths in nm, above 0 and ascending, but sample {index} is at {nm}")]
    Wavelength {
        /// Which sample, from 0.
        index: usize,
        /// As given.
        nm: f64,
    },
    /// A value below zero or beyond all numbers.
    #[error("expected values of 0 or more, but sample {index} is {value}")]
    Value {
        /// Which sample, from 0.
        index: usize,
        /// As given.
        value: f64,
    },
    /// A colour that no light has.
    #[error("expected three finite numbers of 0 or more as colour, not {rgb:?}")]
    Colour {
        /// As given.
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
    /// What is wrong with the first bad sample.
    pub fn sampled(samples: impl Into<Arc<[[f64; 2]]>>) -> Result<Self, SpectrumError> {
        Sampled::new(samples).map(Self::Sampled)
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
}

impl Sampled {
    /// Checks and keeps samples of [wavelength in nm, value].
    ///
    /// # Errors
    /// What is wrong with the first bad sample.
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
}
