//! From spectra to what an observer in motion sees: spectral radiance, its Doppler shift, and its colour.

pub mod spectrum;

pub use spectrum::{Sampled, Spectrum, SpectrumError};
