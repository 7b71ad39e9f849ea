//! Reading a recording, also one that is damaged or still being written.
//!
//! The file is read once from front to back, a chunk at a time. A chunk is checked against its
//! checksum before anything in it is believed, messages must follow each other without a gap, and
//! the data as a whole has a checksum at its end. At the first thing that is wrong the reader says
//! what and where, and stops; everything it gave before is good.

use std::collections::{BTreeMap, VecDeque};
use std::path::Path;

use serde::de::DeserializeOwned;

use super::error::RecordingError;
use super::header::Header;
use super::record::{Entry, SampleRecord, Topic};
use super::records::{Record, Records};
use super::wire::{Fields, opcode};

/// A recording that is being read: its header, and an iterator over its entries in the order in
/// which they were made.
///
/// The last item is an error if the file does not end as it should; all before it may be used.
#[derive(Debug)]
pub struct Recording {
    records: Records,
    header: Header,
    channels: BTreeMap<u16, Option<Topic>>,
    sequence: u32,
    entries: VecDeque<Entry>,
    /// What to say after the entries; nothing is read any more.
    end: Option<Result<(), RecordingError>>,
}

impl Recording {
    /// Opens a recording and reads its header.
    ///
    /// # Errors
    /// If it cannot be opened, is no recording of this program or of another format, or is damaged
    /// within the header.
    pub fn open(path: &Path) -> Result<Self, RecordingError> {
        let (records, header) = Records::open(path)?;
        Ok(Self { records, header, channels: BTreeMap::new(), sequence: 0, entries: VecDeque::new(), end: None })
    }

    /// What the ride depends on besides its samples.
    pub fn header(&self) -> &Header {
        &self.header
    }

    /// Reads the next outermost record. `Ok(false)` says that the data has ended as it should.
    fn advance(&mut self) -> Result<bool, RecordingError> {
        let record = self.records.next()?;
        match record.opcode {
            opcode::CHUNK => self.chunk(&record)?,
            opcode::SCHEMA | opcode::CHANNEL | opcode::MESSAGE => {
                self.inner(record.opcode, &record.body).map_err(|what| self.records.damaged(record.offset, what))?;
            }
            opcode::DATA_END => {
                let mut fields = Fields(&record.body);
                let checksum = fields.u32();
                return if checksum == Some(record.checksum_before) && fields.0.is_empty() {
                    Ok(false)
                } else {
                    Err(self.records.damaged(record.offset, "the data does not match its checksum"))
                };
            }
            opcode::FOOTER => {
                return Err(self.records.damaged(record.offset, "the end of the data is missing"));
            }
            // Indexes, attachments and what others may add.
            _ => {}
        }
        Ok(true)
    }

    /// Reads all that a chunk holds, once its checksum is right.
    fn chunk(&mut self, record: &Record) -> Result<(), RecordingError> {
        let damaged = |what: String| self.records.damaged(record.offset, what);
        let mut fields = Fields(&record.body);
        let parts = (|| {
            let (_start, _end, _length) = (fields.u64()?, fields.u64()?, fields.u64()?);
            Some((fields.u32()?, fields.text()?, fields.long_bytes()?))
        })();
        let Some((checksum, compression, content)) = parts else {
            return Err(damaged("the chunk is shorter than it says".to_owned()));
        };
        if !compression.is_empty() {
            return Err(damaged(format!("compressed with {compression:?}; recordings are not compressed")));
        }
        if checksum != crc32fast::hash(content) {
            return Err(damaged("the chunk does not match its checksum".to_owned()));
        }
        let mut records = Fields(content);
        while !records.0.is_empty() {
            let outcome = match records.record() {
                Some((opcode, body)) => self.inner(opcode, body),
                None => Err("a record is longer than its chunk".to_owned()),
            };
            outcome.map_err(|what| self.records.damaged(record.offset, what))?;
        }
        Ok(())
    }

    /// Takes a channel or a message.
    fn inner(&mut self, kind: u8, body: &[u8]) -> Result<(), String> {
        match kind {
            opcode::CHANNEL => self.channel(body),
            opcode::MESSAGE => self.message(body),
            _ => Ok(()),
        }
    }

    fn channel(&mut self, body: &[u8]) -> Result<(), String> {
        let mut fields = Fields(body);
        let parts = (|| {
            let (id, _schema) = (fields.u16()?, fields.u16()?);
            Some((id, fields.text()?))
        })();
        let (id, name) = parts.ok_or("a channel is shorter than it says")?;
        self.channels.insert(id, Topic::ALL.into_iter().find(|topic| topic.name() == name));
        Ok(())
    }

    fn message(&mut self, body: &[u8]) -> Result<(), String> {
        let mut fields = Fields(body);
        let parts = (|| {
            let (channel, sequence) = (fields.u16()?, fields.u32()?);
            let (_logged, _published) = (fields.u64()?, fields.u64()?);
            Some((channel, sequence))
        })();
        let (channel, sequence) = parts.ok_or("a message is shorter than its header")?;
        let expected = self.sequence;
        if sequence != expected {
            return Err(format!("message {sequence} follows where {expected} should: some are missing"));
        }
        self.sequence = self.sequence.wrapping_add(1);

        let text = fields.0;
        let topic = self.channels.get(&channel).ok_or_else(|| format!("message {sequence} is of no channel"))?;
        self.entries.push_back(match topic {
            Some(Topic::Samples) => {
                let record: SampleRecord = parse(sequence, text)?;
                Entry::Sample(record.try_into().map_err(|what| format!("message {sequence}: {what}"))?)
            }
            Some(Topic::Controls) => Entry::Controls(parse(sequence, text)?),
            Some(Topic::Frames) => Entry::Frame(parse(sequence, text)?),
            // A channel that a later program has added.
            None => return Ok(()),
        });
        Ok(())
    }
}

fn parse<T: DeserializeOwned>(sequence: u32, text: &[u8]) -> Result<T, String> {
    serde_json::from_slice(text).map_err(|error| format!("message {sequence}: {error}"))
}

impl Iterator for Recording {
    type Item = Result<Entry, RecordingError>;

    fn next(&mut self) -> Option<Self::Item> {
        loop {
            if let Some(entry) = self.entries.pop_front() {
                return Some(Ok(entry));
            }
            // The end is told once.
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
