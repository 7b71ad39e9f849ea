//! The stream of a file's outermost records, read from the front, with the place of each.

use std::fs::File;
use std::io::{self, BufReader, Read};
use std::path::{Path, PathBuf};

use super::error::RecordingError;
use super::header::{Header, KEY_CHECKSUM, KEY_HEADER, KEY_VERSION, METADATA, PROFILE, VERSION};
use super::wire::{Fields, MAGIC, RECORD_HEADER, opcode, record_header};

/// No record of ours comes near; a length beyond this is damage.
const LONGEST_RECORD: u64 = 64 << 20;

/// A record of the file.
#[derive(Debug)]
pub(super) struct Record {
    /// Where it begins.
    pub(super) offset: u64,
    pub(super) opcode: u8,
    pub(super) body: Vec<u8>,
    /// Checksum of the file up to its beginning.
    pub(super) checksum_before: u32,
}

/// A file of which the records up to `offset` have been read.
#[derive(Debug)]
pub(super) struct Records {
    path: PathBuf,
    file: BufReader<File>,
    /// Of the file when it was opened; what is written later is not read.
    length: u64,
    offset: u64,
    checksum: crc32fast::Hasher,
}

impl Records {
    /// Opens a file and checks that it is MCAP and ours.
    pub(super) fn open(path: &Path) -> Result<(Self, Header), RecordingError> {
        let cannot_open = |cause| RecordingError::io(path, "open", cause);
        // Ask before opening: a pipe would wait for a writer.
        let metadata = path.metadata().map_err(cannot_open)?;
        let owned = path.to_owned();
        if metadata.is_dir() {
            return Err(RecordingError::Directory { path: owned });
        }
        if !metadata.is_file() {
            return Err(RecordingError::NotMcap { path: owned });
        }
        let file = File::open(path).map_err(cannot_open)?;
        let length = file.metadata().map_err(cannot_open)?.len();
        if length == 0 {
            return Err(RecordingError::Empty { path: owned });
        }
        let checksum = crc32fast::Hasher::new();
        let mut records = Self { path: owned, file: BufReader::new(file), length, offset: 0, checksum };
        records.magic()?;
        records.profile()?;
        let header = records.header()?;
        Ok((records, header))
    }

    /// That the file is wrong at `offset`.
    pub(super) fn damaged(&self, offset: u64, what: impl Into<String>) -> RecordingError {
        RecordingError::Damaged { path: self.path.clone(), offset, what: what.into() }
    }

    /// The next record.
    ///
    /// # Errors
    /// If the file ends before the record does, or its length cannot be right.
    pub(super) fn next(&mut self) -> Result<Record, RecordingError> {
        let (offset, checksum_before) = (self.offset, self.checksum.clone().finalize());
        let cut_off = RecordingError::CutOff { path: self.path.clone(), offset };
        let left = self.length - self.offset;
        let mut header = [0; RECORD_HEADER];
        let Some(left) = left.checked_sub(header.len() as u64) else {
            return Err(cut_off);
        };
        self.read(&mut header)?;
        let (opcode, length) = record_header(header);
        if opcode == 0 || length > LONGEST_RECORD {
            return Err(self.damaged(offset, format!("a record of kind {opcode} and {length} bytes")));
        }
        if length > left {
            return Err(cut_off);
        }
        let mut body = vec![0; usize::try_from(length).expect("64 MiB fit into memory's addresses")];
        self.read(&mut body)?;
        Ok(Record { offset, opcode, body, checksum_before })
    }

    fn read(&mut self, bytes: &mut [u8]) -> Result<(), RecordingError> {
        self.file.read_exact(bytes).map_err(|cause| match cause.kind() {
            // It was longer when it was opened.
            io::ErrorKind::UnexpectedEof => RecordingError::CutOff { path: self.path.clone(), offset: self.offset },
            _ => RecordingError::io(&self.path, "read", cause),
        })?;
        self.checksum.update(bytes);
        self.offset += bytes.len() as u64;
        Ok(())
    }

    fn magic(&mut self) -> Result<(), RecordingError> {
        let mut magic = [0; MAGIC.len()];
        if self.length >= magic.len() as u64 {
            self.read(&mut magic)?;
        }
        if magic == *MAGIC { Ok(()) } else { Err(RecordingError::NotMcap { path: self.path.clone() }) }
    }

    fn profile(&mut self) -> Result<(), RecordingError> {
        let record = self.next()?;
        let profile = if record.opcode == opcode::HEADER { Fields(&record.body).text() } else { None };
        match profile {
            Some(PROFILE) => Ok(()),
            Some(profile) => Err(RecordingError::Foreign { path: self.path.clone(), profile: profile.to_owned() }),
            None => Err(self.damaged(record.offset, "the MCAP header cannot be read")),
        }
    }

    fn header(&mut self) -> Result<Header, RecordingError> {
        let record = self.next()?;
        let damaged = |what: String| self.damaged(record.offset, what);
        if record.opcode != opcode::METADATA || Fields(&record.body).text() != Some(METADATA) {
            return Err(damaged("the description of the ride is missing".to_owned()));
        }
        let value = |key: &str| {
            let mut fields = Fields(&record.body);
            fields.text()?;
            fields.map_value(key)
        };
        match value(KEY_VERSION) {
            Some(VERSION) => {}
            found => {
                let found = found.unwrap_or_default().to_owned();
                return Err(RecordingError::Version { path: self.path.clone(), found });
            }
        }
        let text = value(KEY_HEADER).ok_or_else(|| damaged(format!("`{KEY_HEADER}` is missing")))?;
        if value(KEY_CHECKSUM) != Some(&format!("{:08x}", crc32fast::hash(text.as_bytes()))) {
            return Err(damaged(format!("`{KEY_HEADER}` does not match its checksum")));
        }
        serde_json::from_str(text).map_err(|error| damaged(format!("`{KEY_HEADER}`: {error}")))
    }
}
