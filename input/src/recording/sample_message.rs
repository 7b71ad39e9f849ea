//! Samples, as they are written: in CBOR, whose bytes are bytes; and as the first format had them, in JSON.

use serde::{Deserialize, Serialize};

use crate::clock::Nanos;
use crate::sample::{Sample, SampleSource, Signal};

/// Kind of a sample's signal, as it is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
enum SignalKind {
    Opened,
    Bytes,
    Closed,
}

impl SignalKind {
    fn signal(self, bytes: Box<[u8]>) -> Signal {
        match self {
            Self::Opened => Signal::Opened,
            Self::Bytes => Signal::Bytes(bytes),
            Self::Closed => Signal::Closed,
        }
    }
}

/// Sample with its number in the ride, from 0.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SampleMessage {
    number: u64,
    at: Nanos,
    source: SampleSource,
    kind: SignalKind,
    #[serde(with = "serde_bytes")]
    bytes: Box<[u8]>,
}

/// Sample that is about to be written.
#[derive(Clone, Copy, Debug, Serialize)]
struct WrittenSample<'a> {
    number: u64,
    at: Nanos,
    source: SampleSource,
    kind: SignalKind,
    #[serde(with = "serde_bytes")]
    bytes: &'a [u8],
}

impl SampleMessage {
    /// Message of the sample with a number.
    pub(super) fn to_cbor(number: u64, sample: &Sample) -> Vec<u8> {
        let (kind, bytes): (_, &[u8]) = match &sample.signal {
            Signal::Opened => (SignalKind::Opened, &[]),
            Signal::Bytes(bytes) => (SignalKind::Bytes, bytes),
            Signal::Closed => (SignalKind::Closed, &[]),
        };
        let mut message = Vec::with_capacity(bytes.len() + 64);
        let written = WrittenSample { number, at: sample.at, source: sample.source, kind, bytes };
        ciborium::into_writer(&written, &mut message).expect("memory takes all that is written into it");
        message
    }

    /// Number and sample of a message.
    ///
    /// # Errors
    /// A sentence, if the message is not that of a sample.
    pub(super) fn from_cbor(message: &[u8]) -> Result<(u64, Sample), String> {
        let Self { number, at, source, kind, bytes } =
            ciborium::from_reader(message).map_err(|error| format!("a sample that cannot be read: {error}"))?;
        Ok((number, Sample { at, source, signal: kind.signal(bytes) }))
    }
}

/// Sample, as the first format had it.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct FirstFormatSample {
    at: Nanos,
    source: SampleSource,
    kind: SignalKind,
    bytes: String,
}

impl TryFrom<FirstFormatSample> for Sample {
    type Error = String;

    fn try_from(record: FirstFormatSample) -> Result<Self, String> {
        let bytes = unhex(&record.bytes)?;
        Ok(Self { at: record.at, source: record.source, signal: record.kind.signal(bytes) })
    }
}

fn unhex(text: &str) -> Result<Box<[u8]>, String> {
    let digits: Option<Vec<u8>> =
        text.chars().map(|digit| digit.to_digit(16).and_then(|digit| u8::try_from(digit).ok())).collect();
    match digits {
        Some(digits) if digits.len().is_multiple_of(2) => {
            Ok(digits.as_chunks().0.iter().map(|[high, low]| high << 4 | low).collect())
        }
        _ => Err(format!("{text:?} is not a row of hexadecimal bytes")),
    }
}

#[cfg(test)]
mod tests {
    //! A sample must survive its message, and a message that claims more than it holds must end in a sentence.
    use super::*;

    #[test]
    fn samples_survive_their_message() {
        for (number, sample) in [
            (0, Sample::opened(1, SampleSource::Bicycle)),
            (u64::MAX, Sample::bytes(u64::MAX, SampleSource::SpaceMouse, [0, 0xff, 0x7f])),
            (2, Sample::bytes(3, SampleSource::Settings, [])),
            (3, Sample::closed(4, SampleSource::Keyboard)),
        ] {
            let message = SampleMessage::to_cbor(number, &sample);
            assert_eq!(SampleMessage::from_cbor(&message), Ok((number, sample)));
        }
    }

    #[test]
    fn bytes_take_the_room_of_bytes() {
        let long = Sample::bytes(3, SampleSource::Vrpn, vec![0xab; 1000]);
        assert!(SampleMessage::to_cbor(7, &long).len() < 1100);
    }

    #[test]
    fn the_first_format_is_read_still() {
        let text = r#"{"at":7,"source":"vrpn","kind":"bytes","bytes":"00ff7f"}"#;
        let record: FirstFormatSample = serde_json::from_str(text).unwrap();
        assert_eq!(Sample::try_from(record), Ok(Sample::bytes(7, SampleSource::Vrpn, [0, 0xff, 0x7f])));
    }

    #[test]
    fn a_damaged_message_ends_in_a_sentence() {
        let message = SampleMessage::to_cbor(1, &Sample::bytes(3, SampleSource::Vrpn, [1, 2, 3]));
        for length in 0..message.len() {
            assert!(SampleMessage::from_cbor(&message[..length]).is_err(), "{length}");
        }
        // A length of gigabytes.
        let place = message.len() - 4;
        let hostile = [&message[..place], &[0x5a, 0xff, 0xff, 0xff, 0xff, 1, 2, 3]].concat();
        assert!(SampleMessage::from_cbor(&hostile).is_err());
    }

    #[test]
    fn texts_that_are_no_bytes_are_refused() {
        for text in ["0", "0g", "é0", " 00", "+1"] {
            assert!(unhex(text).is_err(), "{text}");
        }
    }
}
