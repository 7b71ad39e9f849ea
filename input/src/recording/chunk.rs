//! Records inside a chunk.
//!
//! The linear reader of the `mcap` crate can walk into chunks by itself, but it believes the lengths of the records
//! inside: a record that is longer than its chunk would be read on beyond the chunk's end. So each chunk is given to
//! a reader of its own, without anything behind its content. The reader checks the content against the chunk's
//! checksum before it yields any record.
//!
//! Chunks may be compressed with zstd or lz4.

use std::io::Read;

use mcap::McapError;
use mcap::records::{Record, op};
use mcap::sans_io::{LinearReadEvent, LinearReader, LinearReaderOptions};

use super::parse::parsed;

/// Largest content of a chunk, and longest record in it, bytes: a few compressed bytes may claim to be many.
const LARGEST_CONTENT: usize = 512 << 20;

/// Length of a chunk's fields before its content, without the name of the compression, bytes: start, end,
/// uncompressed length, checksum, length of the name, length of the content.
const FIELDS: usize = 8 + 8 + 8 + 4 + 4 + 8;

/// Calls `each` with opcode and body of every record of a chunk.
///
/// # Errors
/// A sentence that says what is wrong with the chunk, or the first error of `each`.
pub(super) fn records_of_chunk(
    body: &[u8],
    mut each: impl FnMut(u8, &[u8]) -> Result<(), String>,
) -> Result<(), String> {
    let content_end = match parsed(op::CHUNK, body) {
        Some(Record::Chunk { header, data }) => FIELDS + header.compression.len() + data.len(),
        _ => return Err("the chunk is shorter than it says".to_owned()),
    };
    let body = &body[..content_end];
    let record_header = [&[op::CHUNK][..], &(body.len() as u64).to_le_bytes()].concat();
    let mut left = record_header.len() + body.len();
    let mut bytes = record_header.chain(body);

    let options = LinearReaderOptions::default()
        .with_skip_start_magic(true)
        .with_skip_end_magic(true)
        .with_prevalidate_chunk_crcs(true)
        .with_record_length_limit(LARGEST_CONTENT);
    let mut reader = LinearReader::new_with_options(options);
    let mut content = 0;
    while let Some(event) = reader.next_event() {
        match event.map_err(sentence)? {
            LinearReadEvent::ReadRequest(wanted) => {
                // At the end one byte is asked for, and none is there.
                let length = bytes.read(reader.insert(wanted.min(left).max(1))).map_err(|error| error.to_string())?;
                reader.notify_read(length);
                left -= length;
            }
            LinearReadEvent::Record { opcode, data } => {
                content += data.len();
                if content > LARGEST_CONTENT {
                    return Err(format!("the chunk holds more than {} MB", LARGEST_CONTENT >> 20));
                }
                each(opcode, data)?;
            }
        }
    }
    Ok(())
}

/// Sentence that says what is wrong with a chunk.
fn sentence(error: McapError) -> String {
    match error {
        McapError::BadChunkCrc { .. } => "the chunk does not match its checksum".to_owned(),
        McapError::UnexpectedEof | McapError::UnexpectedEoc => "a record is longer than its chunk".to_owned(),
        McapError::UnsupportedCompression(name) => {
            format!("the chunk is compressed with {name:?}, which this program does not read")
        }
        McapError::ChunkTooLarge(length) | McapError::RecordTooLarge { len: length, .. } => {
            format!("the chunk holds a record of {length} bytes")
        }
        error => format!("the chunk cannot be read: {error}"),
    }
}

#[cfg(test)]
mod tests {
    //! A hostile chunk must end in a sentence: one with false lengths must neither be read beyond its end nor stop
    //! the program.
    use super::*;

    /// Body of a chunk: its checksum, the length that it claims for its content, its content, and bytes behind it.
    fn chunk(compression: &str, checksum: u32, claimed: u64, content: &[u8], behind: &[u8]) -> Vec<u8> {
        let mut body = [0_u64, 0, content.len() as u64].map(u64::to_le_bytes).concat();
        body.extend(checksum.to_le_bytes());
        body.extend((compression.len() as u32).to_le_bytes());
        body.extend(compression.as_bytes());
        body.extend(claimed.to_le_bytes());
        [&body, content, behind].concat()
    }

    fn record(opcode: u8, claimed: u64, body: &[u8]) -> Vec<u8> {
        [&[opcode][..], &claimed.to_le_bytes(), body].concat()
    }

    fn read(body: &[u8]) -> Result<Vec<(u8, Vec<u8>)>, String> {
        let mut found = Vec::new();
        records_of_chunk(body, |opcode, body| {
            found.push((opcode, body.to_vec()));
            Ok(())
        })?;
        Ok(found)
    }

    fn plain(content: &[u8]) -> Vec<u8> {
        chunk("", crc32fast::hash(content), content.len() as u64, content, &[])
    }

    #[test]
    fn records_come_in_their_order() {
        let content = [record(5, 3, b"one"), record(0x80, 0, b""), record(5, 3, b"two")].concat();
        let expected = vec![(5, b"one".to_vec()), (0x80, vec![]), (5, b"two".to_vec())];
        assert_eq!(read(&plain(&content)), Ok(expected.clone()));
        // A checksum of zero means that there is none.
        assert_eq!(read(&chunk("", 0, content.len() as u64, &content, &[])), Ok(expected));
        assert_eq!(read(&plain(&[])), Ok(vec![]));
    }

    #[test]
    fn a_record_longer_than_its_chunk_is_not_read_beyond_it() {
        for claimed in [4, 1000, u64::from(u32::MAX), u64::MAX] {
            let content = [record(5, 3, b"one"), record(5, claimed, b"two")].concat();
            assert!(read(&plain(&content)).unwrap_err().contains("record"), "{claimed}");
            let behind = chunk("", crc32fast::hash(&content), content.len() as u64, &content, &[7; 5000]);
            assert!(read(&behind).unwrap_err().contains("record"), "{claimed}");
        }
        // Half of a record's header.
        assert_eq!(read(&plain(&[5, 0, 0])), Err("a record is longer than its chunk".to_owned()));
    }

    #[test]
    fn what_stands_behind_the_content_is_passed_over() {
        let content = record(5, 3, b"one");
        let padded = chunk("", crc32fast::hash(&content), content.len() as u64, &content, &[0xff; 100]);
        assert_eq!(read(&padded), Ok(vec![(5, b"one".to_vec())]));
    }

    #[test]
    fn a_chunk_that_is_wrong_is_told_in_a_sentence() {
        let content = record(5, 3, b"one");
        let length = content.len() as u64;
        let told = |body: &[u8]| read(body).unwrap_err();
        assert!(told(&chunk("", 1, length, &content, &[])).contains("does not match its checksum"));
        for claimed in [length + 1, u64::MAX] {
            assert!(told(&chunk("", 0, claimed, &content, &[])).contains("shorter than it says"));
        }
        assert!(told(&content[..5]).contains("shorter than it says"));
        assert!(told(&chunk("rot13", 0, length, &content, &[])).contains("compressed with \"rot13\""));
    }

    #[test]
    fn the_first_error_of_the_taker_ends_the_chunk() {
        let content = [record(5, 3, b"one"), record(5, 3, b"two")].concat();
        let outcome = records_of_chunk(&plain(&content), |_, body| Err(String::from_utf8_lossy(body).into_owned()));
        assert_eq!(outcome, Err("one".to_owned()));
    }
}
