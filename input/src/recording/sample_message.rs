//! Samples, as they are written: in CBOR, whose bytes are bytes; and as the first format had them, in JSON.

use serde::{Deserialize, Serialize};
use serde_bytes::ByteBuf;

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

/// Samples that came one after the other, a column for each of their parts: many of a tracker's share a message, and
/// columns are compressed to a third of what rows are.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SampleMessage {
    /// Number of the first sample in the ride, from 0.
    number: u64,
    /// Time of the first sample.
    at: Nanos,
    /// Time from each of the samples to the next, nanoseconds; negative if it is dated earlier.
    later: Vec<i64>,
    source: Vec<SampleSource>,
    kind: Vec<SignalKind>,
    bytes: Vec<ByteBuf>,
}

impl SampleMessage {
    /// Message of samples, of which the first has a number.
    pub(super) fn to_cbor(number: u64, samples: &[Sample]) -> Vec<u8> {
        let mut message = Self { number, at: samples.first().map_or(0, |sample| sample.at), ..Self::default() };
        let mut before = None;
        for sample in samples {
            // Times beyond half the range pass through the sign bit, and back.
            message.later.extend(before.replace(sample.at).map(|before| sample.at.wrapping_sub(before).cast_signed()));
            let (kind, bytes): (_, &[u8]) = match &sample.signal {
                Signal::Opened => (SignalKind::Opened, &[]),
                Signal::Bytes(bytes) => (SignalKind::Bytes, bytes),
                Signal::Closed => (SignalKind::Closed, &[]),
            };
            message.source.push(sample.source);
            message.kind.push(kind);
            message.bytes.push(ByteBuf::from(bytes));
        }
        let mut text = Vec::new();
        ciborium::into_writer(&message, &mut text).expect("memory takes all that is written into it");
        text
    }

    /// Samples of a message, with their numbers.
    ///
    /// # Errors
    /// A sentence, if the message is not one of samples.
    pub(super) fn from_cbor(message: &[u8]) -> Result<impl Iterator<Item = (u64, Sample)>, String> {
        let Self { number, mut at, later, source, kind, bytes } =
            ciborium::from_reader(message).map_err(|error| format!("samples that cannot be read: {error}"))?;
        let count = source.len();
        if [kind.len(), bytes.len(), later.len() + usize::from(count > 0)] != [count; 3] {
            return Err("samples of which parts are missing".to_owned());
        }
        let times = std::iter::once(at).chain(later.into_iter().map(move |later| {
            at = at.wrapping_add_signed(later);
            at
        }));
        let rows = times.zip(source).zip(kind).zip(bytes);
        let samples = rows.map(|(((at, source), kind), bytes)| {
            let signal = kind.signal(bytes.into_vec().into_boxed_slice());
            Sample { at, source, signal }
        });
        Ok((number..).zip(samples))
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

    fn read(message: &[u8]) -> Result<Vec<(u64, Sample)>, String> {
        SampleMessage::from_cbor(message).map(Iterator::collect)
    }

    #[test]
    fn samples_survive_their_message() {
        let samples = [
            Sample::opened(1, SampleSource::Bicycle),
            Sample::bytes(u64::MAX, SampleSource::SpaceMouse, [0, 0xff, 0x7f]),
            Sample::bytes(3, SampleSource::Settings, []),
            Sample::closed(4, SampleSource::Keyboard),
        ];
        for count in 0..=samples.len() {
            let message = SampleMessage::to_cbor(7, &samples[..count]);
            assert_eq!(read(&message), Ok((7..).zip(samples[..count].iter().cloned()).collect()));
        }
    }

    #[test]
    fn bytes_take_the_room_of_bytes() {
        let long = Sample::bytes(3, SampleSource::Vrpn, vec![0xab; 1000]);
        assert!(SampleMessage::to_cbor(7, &[long]).len() < 1100);
    }

    #[test]
    fn a_message_whose_columns_differ_in_length_is_refused() {
        let message = SampleMessage { source: vec![SampleSource::Vrpn], ..SampleMessage::default() };
        let mut text = Vec::new();
        ciborium::into_writer(&message, &mut text).unwrap();
        assert!(read(&text).unwrap_err().contains("parts are missing"));
    }

    #[test]
    fn the_first_format_is_read_still() {
        let text = r#"{"at":7,"source":"vrpn","kind":"bytes","bytes":"00ff7f"}"#;
        let record: FirstFormatSample = serde_json::from_str(text).unwrap();
        assert_eq!(Sample::try_from(record), Ok(Sample::bytes(7, SampleSource::Vrpn, [0, 0xff, 0x7f])));
    }

    #[test]
    fn a_damaged_message_ends_in_a_sentence() {
        let message = SampleMessage::to_cbor(1, &[Sample::bytes(3, SampleSource::Vrpn, [1, 2, 3])]);
        for length in 0..message.len() {
            assert!(read(&message[..length]).is_err(), "{length}");
        }
        // A length of gigabytes.
        let place = message.len() - 4;
        let hostile = [&message[..place], &[0x5a, 0xff, 0xff, 0xff, 0xff, 1, 2, 3]].concat();
        assert!(read(&hostile).is_err());
    }

    #[test]
    fn texts_that_are_no_bytes_are_refused() {
        for text in ["0", "0g", "é0", " 00", "+1"] {
            assert!(unhex(text).is_err(), "{text}");
        }
    }
}
