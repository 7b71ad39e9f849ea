//! Reader of recordings, also of those that are damaged or still being written, and of copies by other programs.
//!
//! The file is read from front to back, a chunk at a time. A chunk is checked against its checksum before anything in
//! it is believed, the numbering of the messages may have no gap, and the data as a whole has a checksum at its end;
//! a checksum of zero means that there is none. At the first error the reader says what is wrong and where, and stops;
//! every entry before is good. Lengths and checksums are checked by the linear reader of the `mcap` crate
//! (`outer_records.rs`, `chunk.rs`); the order of the messages and their content in `content.rs`.

use std::path::Path;

use mcap::records::{Metadata, Record, op};

use super::chunk::records_of_chunk;
use super::content::Content;
use super::error::RecordingError;
use super::header::{FIRST_VERSION, KEY_CHECKSUM, KEY_HEADER, KEY_VERSION, METADATA, PROFILE, RideHeader, VERSION};
use super::outer_records::{OuterRecord, OuterRecords};
use super::parse::parsed;
use super::record::RecordingEntry;

/// Length of the record that ends the data, bytes: its checksum.
const DATA_END_LENGTH: usize = 4;

/// Recording that is being read: its header, and an iterator over its entries in the order in which they were made.
///
/// The last item is an error if the file does not end as it should; all items before it may be used.
#[derive(Debug)]
pub struct Recording {
    records: OuterRecords,
    header: RideHeader,
    /// Text of the header, to tell another ride in the same file.
    header_text: String,
    content: Content,
    /// Outcome to be reported after the entries, once no more is read.
    end: Option<Result<(), RecordingError>>,
}

impl Recording {
    /// Opens a recording and reads its header, wherever it stands in the file.
    ///
    /// # Errors
    /// A file that cannot be opened, is no recording of this program or of another format, or is damaged within or
    /// before the header.
    pub fn open(path: &Path) -> Result<Self, RecordingError> {
        let mut records = OuterRecords::open(path)?;
        let named = has_profile(&mut records)?;
        let (record, metadata, is_first) = find_header(&mut records).map_err(|error| {
            // A copy without the name is known by the description alone.
            if named { error } else { records.foreign(String::new()) }
        })?;
        let (version, header_text) = check_header(&records, &record, metadata)?;
        let header = serde_json::from_str(&header_text)
            .map_err(|error| records.damaged(record.offset, format!("`{KEY_HEADER}`: {error}")))?;
        if !is_first {
            // Copies may have the description behind the messages.
            records = OuterRecords::open(path)?;
            records.next()?;
        }
        let content = if version == FIRST_VERSION { Content::of_first_format() } else { Content::new() };
        Ok(Self { records, header, header_text, content, end: None })
    }

    /// Everything that the ride depends on besides its samples.
    pub fn header(&self) -> &RideHeader {
        &self.header
    }

    /// Reads the next outermost record; false at the proper end of the data.
    fn advance(&mut self) -> Result<bool, RecordingError> {
        let record = self.records.next()?;
        let outcome = match record.opcode {
            op::CHUNK => records_of_chunk(&record.body, |opcode, body| self.content.take(opcode, body)).map(|()| true),
            op::DATA_END if record.body.len() == DATA_END_LENGTH => self.content.finish().map(|()| false),
            op::DATA_END => Err("the data does not match its checksum".to_owned()),
            op::FOOTER => Err("the end of the data is missing".to_owned()),
            op::METADATA => match header_of(&record) {
                Some(other) if other.metadata.get(KEY_HEADER).is_some_and(|text| *text != self.header_text) => {
                    return Err(self.records.another(record.offset));
                }
                _ => Ok(true),
            },
            // Indexes, attachments and records of other programs are passed over.
            opcode => self.content.take(opcode, &record.body).map(|()| true),
        };
        outcome.map_err(|what| self.records.damaged(record.offset, what))
    }

    /// Place at which another recording begins behind this one, bytes, if there is one. Asked for after all entries.
    pub fn another(&self) -> Option<u64> {
        self.records.another_behind()
    }

    /// Puts in order what was read before an error, and chooses the error to be told.
    fn broken(&mut self, error: RecordingError) -> RecordingError {
        match (self.content.finish(), error) {
            (Err(what), RecordingError::CutOff { offset, .. }) => self.records.damaged(offset, what),
            (_, error) => error,
        }
    }
}

/// Checks that the file is MCAP and not of another program. True if it is of this one by its name; copies may have lost
/// the name.
fn has_profile(records: &mut OuterRecords) -> Result<bool, RecordingError> {
    let record = records.next()?;
    match parsed(record.opcode, &record.body) {
        Some(Record::Header(header)) if header.profile == PROFILE => Ok(true),
        Some(Record::Header(header)) if header.profile.is_empty() => Ok(false),
        Some(Record::Header(header)) => Err(records.foreign(header.profile)),
        _ => Err(records.damaged(record.offset, "the MCAP header cannot be read")),
    }
}

/// Metadata record that describes a ride, if `record` is one.
fn header_of(record: &OuterRecord) -> Option<Metadata> {
    match parsed(record.opcode, &record.body) {
        Some(Record::Metadata(metadata)) if metadata.name == METADATA => Some(metadata),
        _ => None,
    }
}

/// Finds the metadata record that describes the ride; true if it is the first record.
fn find_header(records: &mut OuterRecords) -> Result<(OuterRecord, Metadata, bool), RecordingError> {
    let mut first = None;
    loop {
        let record = records.next()?;
        let place = *first.get_or_insert(record.offset);
        if let Some(metadata) = header_of(&record) {
            let is_first = record.offset == place;
            return Ok((record, metadata, is_first));
        }
        if matches!(record.opcode, op::DATA_END | op::FOOTER) {
            return Err(records.damaged(place, "the description of the ride is missing"));
        }
    }
}

/// Version and text of the header.
fn check_header(
    records: &OuterRecords,
    record: &OuterRecord,
    metadata: Metadata,
) -> Result<(String, String), RecordingError> {
    let damaged = |what: String| records.damaged(record.offset, what);
    let mut values = metadata.metadata;
    let version = match values.remove(KEY_VERSION) {
        Some(version) if [VERSION, FIRST_VERSION].contains(&version.as_str()) => version,
        found => return Err(records.version(found.unwrap_or_default())),
    };
    let text = values.remove(KEY_HEADER).ok_or_else(|| damaged(format!("`{KEY_HEADER}` is missing")))?;
    if values.get(KEY_CHECKSUM) != Some(&format!("{:08x}", crc32fast::hash(text.as_bytes()))) {
        return Err(damaged(format!("`{KEY_HEADER}` does not match its checksum")));
    }
    Ok((version, text))
}

impl Iterator for Recording {
    type Item = Result<RecordingEntry, RecordingError>;

    fn next(&mut self) -> Option<Self::Item> {
        loop {
            match self.content.next() {
                Ok(Some(entry)) => return Some(Ok(entry)),
                Ok(None) => {}
                Err(what) => {
                    let place = self.records.place();
                    self.end = Some(Ok(()));
                    return Some(Err(self.records.damaged(place, what)));
                }
            }
            // The error is reported once.
            if let Some(end) = &mut self.end {
                return std::mem::replace(end, Ok(())).err().map(Err);
            }
            self.end = match self.advance() {
                Ok(true) => None,
                Ok(false) => Some(Ok(())),
                Err(error) => Some(Err(self.broken(error))),
            };
        }
    }
}
