//! Reasons why a trainer cannot be used.

use std::io::{self, ErrorKind};

use thiserror::Error;

use crate::trainer::wire::{DirectConnectError, RequestRefusal};

/// English words for a number that is not Bluetooth's, and for no number.
const ENGLISH: [&str; 2] = ["another's", "nothing at all"];

/// Reason why a trainer cannot be used.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum TrainerError {
    /// A trainer that says nothing.
    #[error("it says nothing; is it a trainer with Direct Connect?")]
    Silent,
    /// A connection that it has closed.
    #[error("it has closed the connection; is another program connected to it?")]
    Closed,
    /// A damaged stream.
    #[error("{0}")]
    Wire(#[from] DirectConnectError),
    /// Services without that of a fitness machine, by their short numbers.
    #[error("it has no fitness machine service (1826), but {}; name a trainer with FTMS", short_numbers(.0, ENGLISH))]
    NoFitnessMachine(Vec<Option<u16>>),
    /// Characteristics without a bicycle's data, by their short numbers.
    #[error(
        "its fitness machine sends no indoor bike data (2ad2), but {}; name a bicycle's trainer",
        short_numbers(.0, ENGLISH)
    )]
    NoBikeData(Vec<Option<u16>>),
    /// Request that it does not fulfil, and the reason.
    #[error("it does not {0}: {1}")]
    Refused(TrainerRequest, RequestRefusal),
    /// A reason as the operating system words it.
    #[error("{0}")]
    System(String),
}

/// Request to a trainer, whose answer is waited for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
pub enum TrainerRequest {
    /// List of its services.
    #[error("list its services")]
    Services,
    /// List of the fitness machine's characteristics.
    #[error("list what its fitness machine has")]
    Characteristics,
    /// Notifications of the bicycle's data.
    #[error("send its bike data")]
    BikeData,
}

impl From<io::Error> for TrainerError {
    fn from(error: io::Error) -> Self {
        match error.kind() {
            ErrorKind::UnexpectedEof | ErrorKind::ConnectionReset | ErrorKind::BrokenPipe => Self::Closed,
            _ => Self::System(error.to_string()),
        }
    }
}

/// Text of short numbers, of which the first few are named; `other`: word for one that is not Bluetooth's, `none`:
/// words for no number.
pub fn short_numbers(numbers: &[Option<u16>], [other, none]: [&str; 2]) -> String {
    const MOST: usize = 8;
    let names = numbers.iter().take(MOST).map(|number| number.map_or(other.to_owned(), |n| format!("{n:04x}")));
    let names: Vec<String> = names.collect();
    if names.is_empty() { none.to_owned() } else { names.join(", ") }
}
