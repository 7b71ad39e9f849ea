//! Reasons why a trainer cannot be used.

use std::io::{self, ErrorKind};

use thiserror::Error;

use crate::trainer::wire::DirectConnectError;

/// Reason why a trainer cannot be used.
#[derive(Debug, Error)]
pub(super) enum TrainerError {
    #[error("it says nothing; is it a trainer with Direct Connect?")]
    Silent,
    #[error("it has closed the connection; is another program connected to it?")]
    Closed,
    #[error("{0}")]
    Wire(#[from] DirectConnectError),
    #[error("it has no fitness machine service (1826), but {0}; name a trainer with FTMS")]
    NoFitnessMachine(String),
    #[error("its fitness machine sends no indoor bike data (2ad2), but {0}; name a bicycle's trainer")]
    NoBikeData(String),
    #[error("it does not {0}: {1}")]
    Refused(&'static str, &'static str),
    #[error("{0}")]
    System(io::Error),
}

impl From<io::Error> for TrainerError {
    fn from(error: io::Error) -> Self {
        match error.kind() {
            ErrorKind::UnexpectedEof | ErrorKind::ConnectionReset | ErrorKind::BrokenPipe => Self::Closed,
            _ => Self::System(error),
        }
    }
}

impl From<TrainerError> for io::Error {
    fn from(error: TrainerError) -> Self {
        match error {
            TrainerError::System(error) => error,
            error => Self::new(ErrorKind::InvalidData, error.to_string()),
        }
    }
}
