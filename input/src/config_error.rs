//! Error of a setting that cannot be used, and the checks that find it.

use thiserror::Error;

/// Setting that cannot be used.
#[derive(Clone, Debug, PartialEq, Error)]
#[error("{key} is {value}: expected {expected}")]
pub struct ConfigError {
    /// Full name of the setting.
    pub key: &'static str,
    /// Value of the setting.
    pub value: String,
    /// Description of the values that can be used.
    pub expected: &'static str,
}

/// Checks that the value is positive and of a size that leaves room for arithmetic.
pub(crate) fn positive(key: &'static str, value: f64) -> Result<(), ConfigError> {
    if (1e-6..=1e6).contains(&value) {
        Ok(())
    } else {
        Err(ConfigError { key, value: value.to_string(), expected: "a positive number from 1e-6 to 1e6" })
    }
}

/// Checks that the value is finite and not zero.
pub(crate) fn not_zero(key: &'static str, value: f64) -> Result<(), ConfigError> {
    if value.is_finite() && value != 0.0 {
        Ok(())
    } else {
        Err(ConfigError { key, value: value.to_string(), expected: "a finite number other than zero" })
    }
}
