//! Address of a trainer as one text: `tcp://HOST[:PORT]`.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::wire::PORT;
use crate::head::url::{TrackerUrlError, host_and_port};

/// Address of a trainer.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct TrainerUrl {
    /// Name or address of the trainer.
    pub host: String,
    /// Port of the trainer.
    pub port: u16,
}

/// Reason why a text is no trainer's address.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum TrainerUrlError {
    /// A text of unknown form.
    #[error("{0:?} is no trainer: expected tcp://HOST or tcp://HOST:PORT, as in tcp://192.168.0.20")]
    Unknown(String),
    /// A port that is no number from 1 to 65535.
    #[error(transparent)]
    Port(#[from] TrackerUrlError),
}

impl FromStr for TrainerUrl {
    type Err = TrainerUrlError;

    fn from_str(text: &str) -> Result<Self, TrainerUrlError> {
        let url = text.trim();
        let unknown = || TrainerUrlError::Unknown(url.to_owned());
        let place = url.strip_prefix("tcp://").ok_or_else(unknown)?;
        let place = place.strip_suffix('/').unwrap_or(place);
        let (host, port) = host_and_port(url, place, PORT)?;
        if host.is_empty() || host.contains(['/', '@']) {
            return Err(unknown());
        }
        Ok(Self { host: host.to_owned(), port })
    }
}

impl TryFrom<String> for TrainerUrl {
    type Error = TrainerUrlError;

    fn try_from(text: String) -> Result<Self, TrainerUrlError> {
        text.parse()
    }
}

impl From<TrainerUrl> for String {
    fn from(url: TrainerUrl) -> Self {
        url.to_string()
    }
}

impl fmt::Display for TrainerUrl {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { host, port } = self;
        // An IPv6 address, which may name its interface, as in fe80::1%eth0.
        if host.contains(':') {
            write!(formatter, "tcp://[{host}]:{port}")
        } else {
            write!(formatter, "tcp://{host}:{port}")
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn addresses_are_read_and_written() {
        for (text, whole) in [
            ("tcp://kickr.local", "tcp://kickr.local:36866"),
            ("tcp://192.168.0.20:36867/", "tcp://192.168.0.20:36867"),
            (" tcp://[fe80::1] ", "tcp://[fe80::1]:36866"),
            ("tcp://[::1]:4000", "tcp://[::1]:4000"),
            ("tcp://[fe80::1%eth0]", "tcp://[fe80::1%eth0]:36866"),
        ] {
            let url: TrainerUrl = text.parse().unwrap();
            assert_eq!(url.to_string(), whole);
            assert_eq!(whole.parse(), Ok(url));
        }
    }

    #[test]
    fn a_wrong_address_is_told_in_a_sentence() {
        for (text, expected) in [
            ("", "\"\" is no trainer: expected tcp://HOST"),
            ("kickr", "is no trainer"),
            ("ble://kickr", "is no trainer"),
            ("tcp://", "is no trainer"),
            ("tcp://:36866", "is no trainer"),
            ("tcp://kickr/FTMS", "is no trainer"),
            ("tcp://kickr:0", "\"0\" in \"tcp://kickr:0\" is no port"),
            ("tcp://kickr:ftms", "is no port: expected a number from 1 to 65535"),
        ] {
            let error = text.parse::<TrainerUrl>().unwrap_err().to_string();
            assert!(error.contains(expected), "{text}: {error}");
        }
    }
}
