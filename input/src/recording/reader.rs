//! Reader of recordings, also of those that are damaged or still being written.
//!
//! The file is read once from front to back, a chunk at a time. A chunk is checked against its checksum before
//! anything in it is believed, messages must follow each other without a gap, and the data as a whole has a checksum
//! at its end. At the first error the reader says what is wrong and where, and stops; every entry before is good.
//! Lengths and checksums are checked by the linear reader of the `mcap` crate (`outer_records.rs`, `chunk.rs`); the
//! order of the messages and their content are checked here.

use std::collections::{BTreeMap, VecDeque};
use std::path::Path;

use mcap::records::{MessageHeader, Record, op};
use serde::de::DeserializeOwned;

use super::chunk::records_of_chunk;
use super::error::RecordingError;
use super::header::{KEY_CHECKSUM, KEY_HEADER, KEY_VERSION, METADATA, PROFILE, RideHeader, VERSION};
use super::outer_records::OuterRecords;
use super::parse::parsed;
use super::record::{RecordingEntry, RecordingTopic, SampleRecord};

/// Length of the record that ends the data, bytes: its checksum.
const DATA_END_LENGTH: usize = 4;

/// Recording that is being read: its header, and an iterator over its entries in the order in which they were made.
///
/// The last item is an error if the file does not end as it should; all items before it may be used.
#[derive(Debug)]
pub struct Recording {
    records: OuterRecords,
    header: RideHeader,
    messages: Messages,
    /// Outcome to be reported after the entries, once no more is read.
    end: Option<Result<(), RecordingError>>,
}

impl Recording {
    /// Opens a recording and reads its header.
    ///
    /// # Errors
    /// A file that cannot be opened, is no recording of this program or of another format, or is damaged within the
    /// header.
    pub fn open(path: &Path) -> Result<Self, RecordingError> {
        let mut records = OuterRecords::open(path)?;
        check_profile(&mut records)?;
        let header = read_header(&mut records)?;
        Ok(Self { records, header, messages: Messages::default(), end: None })
    }

    /// Everything that the ride depends on besides its samples.
    pub fn header(&self) -> &RideHeader {
        &self.header
    }

    /// Reads the next outermost record; false at the proper end of the data.
    fn advance(&mut self) -> Result<bool, RecordingError> {
        let record = self.records.next()?;
        let outcome = match record.opcode {
            op::CHUNK => records_of_chunk(&record.body, |opcode, body| self.messages.take(opcode, body)),
            op::DATA_END if record.body.len() == DATA_END_LENGTH => return Ok(false),
            op::DATA_END => Err("the data does not match its checksum".to_owned()),
            op::FOOTER => Err("the end of the data is missing".to_owned()),
            // Indexes, attachments and records of other programs are passed over.
            opcode => self.messages.take(opcode, &record.body),
        };
        outcome.map(|()| true).map_err(|what| self.records.damaged(record.offset, what))
    }
}

/// Checks that the file is MCAP and of this program.
fn check_profile(records: &mut OuterRecords) -> Result<(), RecordingError> {
    let record = records.next()?;
    match parsed(record.opcode, &record.body) {
        Some(Record::Header(header)) if header.profile == PROFILE => Ok(()),
        Some(Record::Header(header)) => Err(records.foreign(header.profile)),
        _ => Err(records.damaged(record.offset, "the MCAP header cannot be read")),
    }
}

/// Reads the metadata record that describes the ride.
fn read_header(records: &mut OuterRecords) -> Result<RideHeader, RecordingError> {
    let record = records.next()?;
    let damaged = |what: String| records.damaged(record.offset, what);
    let values = match parsed(record.opcode, &record.body) {
        Some(Record::Metadata(metadata)) if metadata.name == METADATA => metadata.metadata,
        _ => return Err(damaged("the description of the ride is missing".to_owned())),
    };
    let value = |key: &str| values.get(key).map(String::as_str);
    match value(KEY_VERSION) {
        Some(VERSION) => {}
        found => return Err(records.version(found.unwrap_or_default().to_owned())),
    }
    let text = value(KEY_HEADER).ok_or_else(|| damaged(format!("`{KEY_HEADER}` is missing")))?;
    if value(KEY_CHECKSUM) != Some(&format!("{:08x}", crc32fast::hash(text.as_bytes()))) {
        return Err(damaged(format!("`{KEY_HEADER}` does not match its checksum")));
    }
    serde_json::from_str(text).map_err(|error| damaged(format!("`{KEY_HEADER}`: {error}")))
}

/// Messages that have been read and not yet returned, and the channels known so far.
#[derive(Debug, Default)]
struct Messages {
    /// Topic of each channel; `None` for one that a later program has added.
    channels: BTreeMap<u16, Option<RecordingTopic>>,
    /// Number that the next message must have.
    sequence: u32,
    entries: VecDeque<RecordingEntry>,
}

impl Messages {
    /// Takes a channel or a message; other records are passed over.
    fn take(&mut self, opcode: u8, body: &[u8]) -> Result<(), String> {
        match opcode {
            op::CHANNEL => match parsed(opcode, body) {
                Some(Record::Channel(channel)) => {
                    let topic = RecordingTopic::ALL.into_iter().find(|topic| topic.name() == channel.topic);
                    self.channels.insert(channel.id, topic);
                    Ok(())
                }
                _ => Err("a channel is shorter than it says".to_owned()),
            },
            op::MESSAGE => match parsed(opcode, body) {
                Some(Record::Message { header, data }) => self.message(header, &data),
                _ => Err("a message is shorter than its header".to_owned()),
            },
            _ => Ok(()),
        }
    }

    fn message(&mut self, header: MessageHeader, text: &[u8]) -> Result<(), String> {
        let MessageHeader { sequence, channel_id, .. } = header;
        let expected = self.sequence;
        if sequence != expected {
            return Err(format!("message {sequence} follows where {expected} should: some are missing"));
        }
        self.sequence = self.sequence.wrapping_add(1);

        let topic = self.channels.get(&channel_id).ok_or_else(|| format!("message {sequence} is of no channel"))?;
        self.entries.push_back(match topic {
            Some(RecordingTopic::Samples) => {
                let record: SampleRecord = parse(sequence, text)?;
                RecordingEntry::Sample(record.try_into().map_err(|what| format!("message {sequence}: {what}"))?)
            }
            Some(RecordingTopic::Controls) => RecordingEntry::Controls(parse(sequence, text)?),
            Some(RecordingTopic::Frames) => RecordingEntry::Frame(parse(sequence, text)?),
            None => return Ok(()),
        });
        Ok(())
    }
}

fn parse<T: DeserializeOwned>(sequence: u32, text: &[u8]) -> Result<T, String> {
    serde_json::from_slice(text).map_err(|error| format!("message {sequence}: {error}"))
}

impl Iterator for Recording {
    type Item = Result<RecordingEntry, RecordingError>;

    fn next(&mut self) -> Option<Self::Item> {
        loop {
            if let Some(entry) = self.messages.entries.pop_front() {
                return Some(Ok(entry));
            }
            // The error is reported once.
            if let Some(end) = &mut self.end {
                return std::mem::replace(end, Ok(())).err().map(Err);
            }
            match self.advance() {
                Ok(true) => {}
                Ok(false) => self.end = Some(Ok(())),
                Err(error) => self.end = Some(Err(error)),
            }
        }
    }
}
