//! Parsing of single records.
//!
//! The parser of the `mcap` crate reserves as much memory as a text claims to be long, up to four gigabytes, before
//! it looks how much is there. So the lengths of texts are checked first.

use mcap::records::{Record, op};

/// A record of this kind and content; `None` if it cannot be parsed, or is of a kind that no reader here asks for.
pub(super) fn parsed(opcode: u8, body: &[u8]) -> Option<Record<'_>> {
    texts_fit(opcode, body)?;
    mcap::parse_record(opcode, body).ok()
}

/// Checks that no text of the record claims to be longer than the record; `None` if one does, or if the kind is
/// unknown.
fn texts_fit(opcode: u8, body: &[u8]) -> Option<()> {
    // Bytes before the texts, number of texts, and whether a map of texts follows: MCAP specification, version 0.
    let (fixed, texts, has_map) = match opcode {
        op::HEADER => (0, 2, false),
        op::CHANNEL => (2 + 2, 2, true),
        op::CHUNK => (8 + 8 + 8 + 4, 1, false),
        op::METADATA => (0, 1, true),
        op::MESSAGE => return Some(()),
        _ => return None,
    };
    let mut rest = body.get(fixed..)?;
    for _ in 0..texts {
        (_, rest) = split_text(rest)?;
    }
    if has_map {
        (rest, _) = split_text(rest)?;
        while !rest.is_empty() {
            (_, rest) = split_text(rest)?;
        }
    }
    Some(())
}

/// Bytes behind a 32-bit length, as many as it says, and the rest.
fn split_text(bytes: &[u8]) -> Option<(&[u8], &[u8])> {
    let (length, rest) = bytes.split_first_chunk()?;
    rest.split_at_checked(usize::try_from(u32::from_le_bytes(*length)).ok()?)
}

#[cfg(test)]
mod tests {
    //! An impossible length must be refused before memory is reserved for it.
    use super::*;

    fn text(text: &str) -> Vec<u8> {
        [&(text.len() as u32).to_le_bytes()[..], text.as_bytes()].concat()
    }

    fn map(content: &[u8]) -> Vec<u8> {
        [&(content.len() as u32).to_le_bytes()[..], content].concat()
    }

    #[test]
    fn sound_records_are_parsed_and_long_texts_refused() {
        let entries = map(&[text("key"), text("value")].concat());
        let records = [
            (op::HEADER, [text("rapidity"), text("library")].concat(), vec![0, 12]),
            (op::METADATA, [text("name"), entries.clone()].concat(), vec![0, 8, 12, 19]),
            (op::CHANNEL, [vec![1, 0, 1, 0], text("/a"), text("json"), entries].concat(), vec![4, 10, 18, 22, 29]),
            (op::CHUNK, [vec![0; 28], text("zstd"), vec![0; 8]].concat(), vec![28]),
        ];
        for (opcode, body, lengths) in records {
            assert_eq!(parsed(opcode, &body).unwrap().opcode(), opcode);
            for at in lengths {
                for claimed in [u32::MAX, body.len() as u32] {
                    let mut hostile = body.clone();
                    hostile[at..at + 4].copy_from_slice(&claimed.to_le_bytes());
                    assert!(texts_fit(opcode, &hostile).is_none(), "{claimed} at {at} of a record {opcode}");
                }
            }
            assert!(parsed(op::SCHEMA, &body).is_none());
            (0..body.len()).for_each(|length| assert!(parsed(opcode, &body[..length]).is_none()));
        }
    }
}
