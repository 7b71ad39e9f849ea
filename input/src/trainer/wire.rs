//! Messages of Direct Connect: a header of six bytes, then data.
//!
//! The header: version, kind, sequence number, response code, and the length of the data as 16 bits, the high byte
//! first. Services and characteristics are named by UUIDs of 16 bytes; Bluetooth's own are short numbers in a common
//! base.

use thiserror::Error;

/// Usual TCP port of a trainer.
pub const PORT: u16 = 36866;
/// Version of the protocol.
pub const VERSION: u8 = 1;
/// Length of a header, bytes.
pub const HEADER_LENGTH: usize = 6;
/// Length of a UUID, bytes.
pub const UUID_LENGTH: usize = 16;
/// Most data of a message that is believed, bytes: a trainer's longest is a list of some dozen UUIDs.
pub const LONGEST_DATA: usize = 4096;

/// Fitness Machine Service.
pub const FITNESS_MACHINE: u16 = 0x1826;
/// Indoor Bike Data, a characteristic of that service.
pub const INDOOR_BIKE_DATA: u16 = 0x2ad2;
/// Fitness Machine Control Point, a characteristic of that service.
pub const CONTROL_POINT: u16 = 0x2ad9;
/// Cycling Power Measurement.
pub const POWER_MEASUREMENT: u16 = 0x2a63;
/// Cycling Speed and Cadence Measurement.
pub const SPEED_MEASUREMENT: u16 = 0x2a5b;

/// Kind of a message: list of services.
pub const SERVICES: u8 = 1;
/// Kind of a message: list of a service's characteristics.
pub const CHARACTERISTICS: u8 = 2;
/// Kind of a message: write to a characteristic.
pub const WRITE: u8 = 4;
/// Kind of a message: notifications on or off.
pub const ENABLE: u8 = 5;
/// Kind of a message: notification.
pub const NOTIFICATION: u8 = 6;

/// Property of a characteristic: it can be written.
pub const CAN_WRITE: u8 = 2;
/// Property of a characteristic: it can notify.
pub const CAN_NOTIFY: u8 = 4;

/// Base of Bluetooth's own UUIDs, in which bytes 2 and 3 are the short number.
const BASE: [u8; UUID_LENGTH] = [0, 0, 0, 0, 0, 0, 0x10, 0, 0x80, 0, 0, 0x80, 0x5f, 0x9b, 0x34, 0xfb];

/// Bytes that are no message of a trainer.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum DirectConnectError {
    /// A first byte that is not the version.
    #[error("it does not speak Direct Connect, version 1 (it sent {0:?}): name a trainer's address and port")]
    Version(String),
    /// A kind of message that does not exist.
    #[error("the stream is damaged: message of kind {0}, expected 1 to 6")]
    Kind(u8),
    /// A length that no message has.
    #[error("the stream is damaged: message of {0} bytes, expected {LONGEST_DATA} at most")]
    Length(usize),
}

/// Message of either side.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DirectConnectMessage<'a> {
    /// Kind of the message, 1 to 6.
    pub kind: u8,
    /// Number of the request; of an answer, that of its request.
    pub sequence: u8,
    /// Response code, 0 for success and in requests.
    pub response: u8,
    /// Data: as a rule a UUID, and what belongs to it.
    pub data: &'a [u8],
}

impl<'a> DirectConnectMessage<'a> {
    /// Bytes of the message.
    pub fn to_bytes(self) -> Vec<u8> {
        let length = u16::try_from(self.data.len()).expect("data are short").to_be_bytes();
        let header = [VERSION, self.kind, self.sequence, self.response, length[0], length[1]];
        [&header, self.data].concat()
    }

    /// Short number of the UUID with which the data begin, if it is one of Bluetooth's; and the value behind it.
    pub fn characteristic(self) -> Option<(u16, &'a [u8])> {
        let (uuid, value) = self.data.split_first_chunk()?;
        Some((short(uuid)?, value))
    }
}

/// UUID of a short number.
pub fn uuid(short: u16) -> [u8; UUID_LENGTH] {
    let mut uuid = BASE;
    [uuid[2], uuid[3]] = short.to_be_bytes();
    uuid
}

/// Short number of a UUID; `None` for one that is not Bluetooth's own.
pub fn short(uuid: &[u8; UUID_LENGTH]) -> Option<u16> {
    let short = u16::from_be_bytes([uuid[2], uuid[3]]);
    (self::uuid(short) == *uuid).then_some(short)
}

/// Reason why a request was refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
pub enum RequestRefusal {
    /// An unknown kind of message.
    #[error("it does not know this kind of message")]
    Kind,
    /// A service that is not there.
    #[error("it has no such service")]
    Service,
    /// A characteristic that is not there.
    #[error("it has no such characteristic")]
    Characteristic,
    /// An operation that the characteristic does not have.
    #[error("the characteristic does not allow it")]
    Operation,
    /// A value that is refused.
    #[error("it refuses the value")]
    Value,
    /// An error without a reason.
    #[error("it reports an error without a reason")]
    Unnamed,
}

impl RequestRefusal {
    /// Reason behind a response code that is not 0.
    pub fn of(response: u8) -> Self {
        match response {
            1 => Self::Kind,
            3 => Self::Service,
            4 => Self::Characteristic,
            5 => Self::Operation,
            6 => Self::Value,
            _ => Self::Unnamed,
        }
    }
}

/// Cutter of one connection's stream into its messages. It holds one unfinished message at most.
#[derive(Debug, Default)]
pub struct DirectConnectPieces {
    partial: Vec<u8>,
    lost: bool,
}

impl DirectConnectPieces {
    /// Takes the next bytes and calls `each` for every message that ends in them, with its bytes. Nonsense is reported
    /// once; what follows is passed over, because nothing marks the next message.
    pub fn push(
        &mut self,
        bytes: &[u8],
        mut each: impl FnMut(Result<(DirectConnectMessage<'_>, &[u8]), DirectConnectError>),
    ) {
        if self.lost {
            return;
        }
        let mut stream = std::mem::take(&mut self.partial);
        stream.extend_from_slice(bytes);
        let mut rest = &stream[..];
        loop {
            match next(rest) {
                Ok(Some((message, length))) => {
                    each(Ok((message, &rest[..length])));
                    rest = &rest[length..];
                }
                Ok(None) => break,
                Err(error) => {
                    self.lost = true;
                    each(Err(error));
                    return;
                }
            }
        }
        let used = stream.len() - rest.len();
        stream.drain(..used);
        self.partial = stream;
    }
}

/// First message and its length, bytes; `None` if there is not enough yet.
fn next(bytes: &[u8]) -> Result<Option<(DirectConnectMessage<'_>, usize)>, DirectConnectError> {
    // Each byte of the header is checked as soon as it is there: no length is waited for that cannot be right.
    if bytes.first().is_some_and(|version| *version != VERSION) {
        let text = String::from_utf8_lossy(&bytes[..bytes.len().min(16)]).into_owned();
        return Err(DirectConnectError::Version(text));
    }
    if let Some(&kind) = bytes.get(1).filter(|kind| !(SERVICES..=NOTIFICATION).contains(kind)) {
        return Err(DirectConnectError::Kind(kind));
    }
    let Some(&[_, kind, sequence, response, high, low]) = bytes.first_chunk::<HEADER_LENGTH>() else {
        return Ok(None);
    };
    let length = usize::from(u16::from_be_bytes([high, low]));
    if length > LONGEST_DATA {
        return Err(DirectConnectError::Length(length));
    }
    let whole = HEADER_LENGTH + length;
    let message = |data| (DirectConnectMessage { kind, sequence, response, data }, whole);
    Ok(bytes.get(HEADER_LENGTH..whole).map(message))
}

#[cfg(test)]
mod tests {
    //! Law: a message survives its bytes however they are cut; lengths that lie cost neither memory nor a long wait.
    use super::*;

    /// Notification that a simulator of a trainer sent: 0x2ad2, its flags and the value.
    const HEARD: &str = "0106000000190000 2ad2 00001000800000805f9b34fb 4402100ea40096008c";

    fn unhex(text: &str) -> Vec<u8> {
        let digits: Vec<u8> = text.bytes().filter(|byte| *byte != b' ').collect();
        let pair = |pair: &[u8]| u8::from_str_radix(std::str::from_utf8(pair).unwrap(), 16).unwrap();
        digits.chunks(2).map(pair).collect()
    }

    /// Kind of a message, its data and its bytes.
    type CutMessage = (u8, Vec<u8>, Vec<u8>);

    fn cut(chunks: &[&[u8]]) -> Vec<Result<CutMessage, DirectConnectError>> {
        let (mut pieces, mut cut) = (DirectConnectPieces::default(), Vec::new());
        for chunk in chunks {
            pieces.push(chunk, |piece| {
                cut.push(piece.map(|(message, raw)| (message.kind, message.data.to_vec(), raw.to_vec())));
            });
        }
        cut
    }

    #[test]
    fn a_notification_is_read_and_written() {
        let raw = unhex(HEARD);
        let mut pieces = DirectConnectPieces::default();
        let mut count = 0;
        pieces.push(&raw, |piece| {
            let (message, found) = piece.unwrap();
            assert_eq!((message.kind, message.response, found), (NOTIFICATION, 0, &raw[..]));
            assert_eq!(message.characteristic(), Some((INDOOR_BIKE_DATA, &raw[22..])));
            assert_eq!(message.to_bytes(), raw);
            count += 1;
        });
        assert_eq!(count, 1);
    }

    #[test]
    fn messages_do_not_depend_on_the_cut() {
        let ask = DirectConnectMessage { kind: SERVICES, sequence: 3, response: 0, data: &[] }.to_bytes();
        let stream = [unhex(HEARD), ask, unhex(HEARD)].concat();
        let whole = cut(&[&stream]);
        assert_eq!(whole.len(), 3);
        for at in 0..=stream.len() {
            assert_eq!(cut(&[&stream[..at], &stream[at..]]), whole, "cut at {at}");
        }
        assert_eq!(cut(&stream.chunks(1).collect::<Vec<_>>()), whole);
    }

    #[test]
    fn nonsense_is_told_once_and_costs_no_memory() {
        for (bytes, told) in [
            (
                &b"HTTP/1.1 400 Bad Request"[..],
                "does not speak Direct Connect, version 1 (it sent \"HTTP/1.1 400 Bad\")",
            ),
            (&[1, 7], "message of kind 7"),
            (&[1, 0], "message of kind 0"),
            (&[1, 6, 0, 0, 0xff, 0xff], "message of 65535 bytes"),
        ] {
            let mut pieces = DirectConnectPieces::default();
            let mut errors = Vec::new();
            for _ in 0..1000 {
                pieces.push(bytes, |piece| errors.extend(piece.err()));
            }
            assert!(errors.len() == 1 && errors[0].to_string().contains(told), "{errors:?}");
            assert_eq!(pieces.partial.capacity(), 0);
        }
    }

    #[test]
    fn uuids_of_bluetooth_have_short_numbers_and_others_have_none() {
        assert_eq!(uuid(0x1826).to_vec(), unhex("0000182600001000800000805f9b34fb"));
        assert_eq!(short(&uuid(CONTROL_POINT)), Some(CONTROL_POINT));
        let wahoo = unhex("a026e005 0a7d4ab397faf1500f9feb8b").try_into().unwrap();
        assert_eq!(short(&wahoo), None);
    }
}
