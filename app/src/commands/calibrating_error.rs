//! Reasons why a calibration ends without a file.

use input::ConfigError;
use input::bicycle::CalibrationError;
use std::time::Duration;
use thiserror::Error;

/// Longest wait for the first good line of the box.
pub const FIRST_LINE: Duration = Duration::from_secs(10);

/// Reason why a calibration ends without a file.
#[derive(Debug, Error)]
pub enum CalibratingError {
    /// No port named.
    #[error(
        "which bicycle? Name its port with --bicycle, such as --bicycle /dev/ttyUSB0; `rapidity devices` lists them"
    )]
    NoPort,
    /// A box that sends nothing that can be read.
    #[error("{port}: no good line within {} s: {why}", FIRST_LINE.as_secs())]
    Silent {
        /// Port of the bicycle.
        port: String,
        /// State of the port, or the fault of the last line.
        why: String,
    },
    /// A box without sensors.
    #[error("{port}: each line is one number, a speed: there is nothing to calibrate; set bare_number in [bicycle]")]
    Bare {
        /// Port of the bicycle.
        port: String,
    },
    /// An end of the answers, or an interruption.
    #[error("the calibration was ended before its last step; nothing was written")]
    Ended,
    /// Readings that give no settings.
    #[error("{0} Nothing was written")]
    Readings(#[from] CalibrationError),
    /// Readings that give a setting which cannot be used.
    #[error("the readings make no sense: {0}. Nothing was written")]
    Setting(#[from] ConfigError),
    /// A file with text that is no set-up.
    #[error("{file}: it is no set-up file: {reason}; name another file")]
    File {
        /// File to be written.
        file: String,
        /// Reason, as the reader of the text words it.
        reason: String,
    },
}
