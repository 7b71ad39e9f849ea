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

/// Samples that came one after the other, a column for each of their parts, because columns can be compressed better
/// than rows: what a tracker sends a thousand times a second differs in few places.
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
    /// Number of bytes of each sample.
    length: Vec<u64>,
    /// First bytes of all samples, then their second bytes, and so on; a sample takes part as long as it has bytes.
    bytes: ByteBuf,
}

impl SampleMessage {
    /// Message of samples, of which the first has a number.
    pub(super) fn to_cbor(number: u64, samples: &[Sample]) -> Vec<u8> {
        let mut message = Self { number, at: samples.first().map_or(0, |sample| sample.at), ..Self::default() };
        let mut before = None;
        let mut rows = Vec::new();
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
            message.length.push(bytes.len() as u64);
            rows.push(bytes);
        }
        message.bytes = ByteBuf::from(columns(&rows));
        let mut text = Vec::new();
        ciborium::into_writer(&message, &mut text).expect("memory takes all that is written into it");
        text
    }

    /// Samples of a message, with their numbers.
    ///
    /// # Errors
    /// A sentence, if the message is not one of samples.
    pub(super) fn from_cbor(message: &[u8]) -> Result<impl Iterator<Item = (u64, Sample)>, String> {
        let Self { number, mut at, later, source, kind, length, bytes } =
            ciborium::from_reader(message).map_err(|error| format!("samples that cannot be read: {error}"))?;
        let count = source.len();
        let incomplete = || "samples of which parts are missing".to_owned();
        if [kind.len(), length.len(), later.len() + usize::from(count > 0)] != [count; 3] {
            return Err(incomplete());
        }
        let rows = rows(&length, &bytes).ok_or_else(incomplete)?;
        let times = std::iter::once(at).chain(later.into_iter().map(move |later| {
            at = at.wrapping_add_signed(later);
            at
        }));
        let samples = times.zip(source).zip(kind).zip(rows);
        let samples = samples.map(|(((at, source), kind), bytes)| {
            let signal = kind.signal(bytes.into_boxed_slice());
            Sample { at, source, signal }
        });
        Ok((number..).zip(samples))
    }
}

/// First bytes of all rows, then their second bytes, and so on.
fn columns(rows: &[&[u8]]) -> Vec<u8> {
    let mut columns = Vec::with_capacity(rows.iter().map(|row| row.len()).sum());
    let mut longer: Vec<&[u8]> = rows.to_vec();
    loop {
        longer.retain_mut(|row| {
            let Some((first, rest)) = row.split_first() else { return false };
            columns.push(*first);
            *row = rest;
            true
        });
        if longer.is_empty() {
            return columns;
        }
    }
}

/// Rows of these lengths, whose bytes are ordered as by [`columns`]; `None` if there are more bytes, or fewer.
fn rows(length: &[u64], columns: &[u8]) -> Option<Vec<Vec<u8>>> {
    let sum = length.iter().try_fold(0_u64, |sum, length| sum.checked_add(*length))?;
    if sum != columns.len() as u64 {
        return None;
    }
    let length = length.iter().map(|length| usize::try_from(*length).ok()).collect::<Option<Vec<_>>>()?;
    let mut rows: Vec<Vec<u8>> = length.iter().map(|length| Vec::with_capacity(*length)).collect();
    let mut longer: Vec<usize> = (0..rows.len()).collect();
    let mut columns = columns.iter();
    while columns.len() > 0 {
        longer.retain(|row| rows[*row].len() < length[*row]);
        for (row, byte) in longer.iter().zip(columns.by_ref()) {
            rows[*row].push(*byte);
        }
    }
    Some(rows)
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
    fn bytes_are_ordered_by_their_place() {
        let all: [&[u8]; 4] = [b"ab", b"", b"cdef", b"g"];
        assert_eq!(columns(&all), b"acgbdef");
        assert_eq!(rows(&[2, 0, 4, 1], b"acgbdef").unwrap(), all);
        assert_eq!(rows(&[], b"").unwrap(), Vec::<Vec<u8>>::new());
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
        // Lengths that are not those of the bytes.
        for length in [vec![2], vec![4], vec![u64::MAX], vec![u64::MAX, 4]] {
            assert_eq!(rows(&length, &[1, 2, 3]), None);
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
