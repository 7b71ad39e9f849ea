//! Outermost records of a recording's file, read from the front, with the place of each.
//!
//! The bytes go through the linear reader of the `mcap` crate, which checks magic number, lengths and the checksum
//! over the data. It asks for no byte beyond the record that it is reading, and is given none. So the bytes given so
//! far say where the next record begins.

use regular_file::FileFault;
use std::fmt;
use std::fs::File;
use std::io::{self, BufReader, Read, Seek, SeekFrom, Take};
use std::path::{Path, PathBuf};

use mcap::records::op;
use mcap::sans_io::{LinearReadEvent, LinearReader, LinearReaderOptions};
use mcap::{MAGIC, McapError};

use super::error::RecordingError;

/// Length of the longest record that is read, bytes. Records of this program are far shorter, other programs may write
/// large chunks and attach films; a length beyond this is damage.
const LONGEST_RECORD: usize = 1 << 30;
/// Most bytes read at once. The buffer grows with what the file holds, not with the length that a record claims.
const MOST_AT_ONCE: usize = 64 << 10;

/// An outermost record of the file.
#[derive(Debug)]
pub(super) struct OuterRecord {
    /// Place in the file, bytes from its beginning.
    pub(super) offset: u64,
    /// Kind of the record, one of `mcap::records::op` or another.
    pub(super) opcode: u8,
    /// Content of the record.
    pub(super) body: Vec<u8>,
}

/// A file whose records are read one after the other.
pub(super) struct OuterRecords {
    path: PathBuf,
    /// The file up to the length that it had when it was opened; later bytes are not read.
    file: BufReader<Take<File>>,
    reader: LinearReader,
    /// Number of bytes given to the reader.
    given: u64,
}

impl fmt::Debug for OuterRecords {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter
            .debug_struct("OuterRecords")
            .field("path", &self.path)
            .field("given", &self.given)
            .finish_non_exhaustive()
    }
}

impl OuterRecords {
    /// Opens a file.
    ///
    /// # Errors
    /// If the path is not that of a readable regular file that holds something.
    pub(super) fn open(path: &Path) -> Result<Self, RecordingError> {
        let cannot_open = |cause| RecordingError::io(path, "open", cause);
        let owned = path.to_owned();
        let file = match regular_file::open(path) {
            Ok(file) => file,
            Err(FileFault::System(cause)) => return Err(cannot_open(cause)),
            Err(_) if path.is_dir() => return Err(RecordingError::Directory { path: owned }),
            Err(_) => return Err(RecordingError::NotMcap { path: owned }),
        };
        let length = file.metadata().map_err(cannot_open)?.len();
        if length == 0 {
            return Err(RecordingError::Empty { path: owned });
        }
        let options = LinearReaderOptions::default()
            .with_emit_chunks(true)
            .with_validate_data_section_crc(true)
            .with_record_length_limit(LONGEST_RECORD);
        let reader = LinearReader::new_with_options(options);
        Ok(Self { path: owned, file: BufReader::new(file.take(length)), reader, given: 0 })
    }

    /// The error that the record at `offset` is wrong.
    pub(super) fn damaged(&self, offset: u64, what: impl Into<String>) -> RecordingError {
        RecordingError::Damaged { path: self.path.clone(), offset, what: what.into() }
    }

    /// The error that another recording begins at `offset`.
    pub(super) fn another(&self, offset: u64) -> RecordingError {
        RecordingError::Another { path: self.path.clone(), offset }
    }

    /// Place at which another MCAP file begins behind this one, if the data has been read to its end.
    ///
    /// The index and the end of this file are passed over by their lengths alone.
    pub(super) fn another_behind(&self) -> Option<u64> {
        let mut file = BufReader::new(regular_file::open(&self.path).ok()?);
        let mut place = file.seek(SeekFrom::Start(self.given)).ok()?;
        loop {
            let mut head = [0; 1 + 8];
            file.read_exact(&mut head).ok()?;
            let [opcode, length @ ..] = head;
            let length = i64::try_from(u64::from_le_bytes(length)).ok()?;
            file.seek_relative(length).ok()?;
            place = place.checked_add(head.len() as u64)?.checked_add(length.unsigned_abs())?;
            if opcode == op::FOOTER {
                break;
            }
        }
        let mut magic = [0; MAGIC.len()];
        file.read_exact(&mut magic).ok()?;
        file.read_exact(&mut magic).ok()?;
        (magic == MAGIC).then_some(place + MAGIC.len() as u64)
    }

    /// The error that the file is of another program.
    pub(super) fn foreign(&self, profile: String) -> RecordingError {
        RecordingError::Foreign { path: self.path.clone(), profile }
    }

    /// The error that the file is of another version of this program.
    pub(super) fn version(&self, found: String) -> RecordingError {
        RecordingError::Version { path: self.path.clone(), found }
    }

    /// Place up to which the file has been read, bytes.
    pub(super) fn place(&self) -> u64 {
        self.given
    }

    /// Reads the next record.
    ///
    /// # Errors
    /// If the file ends before the record does, the record cannot be right, or the data does not match its checksum.
    pub(super) fn next(&mut self) -> Result<OuterRecord, RecordingError> {
        let offset = self.given.max(MAGIC.len() as u64);
        loop {
            let wanted = match self.reader.next_event() {
                Some(Ok(LinearReadEvent::ReadRequest(wanted))) => wanted,
                Some(Ok(LinearReadEvent::Record { opcode: opcode @ 0, data })) => {
                    let what = format!("a record of kind {opcode} and {} bytes", data.len());
                    return Err(self.damaged(offset, what));
                }
                Some(Ok(LinearReadEvent::Record { opcode, data })) => {
                    return Ok(OuterRecord { offset, opcode, body: data.to_vec() });
                }
                Some(Err(error)) => return Err(self.error(offset, error)),
                None => return Err(self.error(offset, McapError::UnexpectedEof)),
            };
            let room = self.reader.insert(wanted.min(MOST_AT_ONCE));
            match self.file.read(room) {
                Ok(length) => {
                    self.reader.notify_read(length);
                    self.given += length as u64;
                }
                Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
                Err(cause) => return Err(RecordingError::io(&self.path, "read", cause)),
            }
        }
    }

    /// The sentence for an error of the reader at the record at `offset`.
    fn error(&self, offset: u64, error: McapError) -> RecordingError {
        let path = self.path.clone();
        match error {
            McapError::BadMagic => RecordingError::NotMcap { path },
            McapError::UnexpectedEof if self.given < MAGIC.len() as u64 => RecordingError::NotMcap { path },
            McapError::UnexpectedEof => RecordingError::CutOff { path, offset },
            McapError::BadDataCrc { .. } => self.damaged(offset, "the data does not match its checksum"),
            McapError::RecordTooLarge { opcode, len } => {
                self.damaged(offset, format!("a record of kind {opcode} and {len} bytes"))
            }
            _ => self.damaged(offset, "a record that cannot be read"),
        }
    }
}
