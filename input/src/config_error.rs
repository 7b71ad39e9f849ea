//! A setting that cannot be used, and the checks that find it.

use thiserror::Error;

/// A setting that cannot be used.
#[derive(Clone, Debug, PartialEq, Error)]
#[error("{key} is {value}: expected {expected}")]
pub struct ConfigError {
    /// The setting's full name.
    pub key: &'static str,
    /// What it is set to.
    pub value: String,
    /// What would do.
    pub expected: &'static str,
}

/// Fails unless the value is positive and of a size that leaves room for arithmetic.
pub(crate) fn positive(key: &'static str, value: f64) -> Result<(), ConfigError> {
    if (1e-6..=1e6).contains(&value) {
        Ok(())
    } else {
        Err(ConfigError { key, value: value.to_string(), expected: "a positive number from 1e-6 to 1e6" })
    }
}

/// Fails unless the value is finite and not zero.
pub(crate) fn not_zero(key: &'static str, value: f64) -> Result<(), ConfigError> {
    if value.is_finite() && value != 0.0 {
        Ok(())
    } else {
        Err(ConfigError { key, value: value.to_string(), expected: "a finite number other than zero" })
    }
}
