//! Container: the JSON of a file, and its binary chunk if it is a `.glb`.
//!
//! A `.glb` is a header (magic, version, length) and chunks (length, kind, bytes). A `.gltf` is the JSON alone. Chunks
//! of other kinds are passed over, a binary chunk that is cut short is taken as far as it goes, and zeros after the
//! JSON, which some exporters write instead of spaces, are left out.

use std::ops::Range;

/// Parts of a file: its JSON, its binary chunk, and a notice about a container that is cut short.
pub struct Chunks {
    /// Range of the JSON in the file.
    pub json: Range<usize>,
    /// Range of the binary chunk in the file.
    pub blob: Option<Range<usize>>,
    /// Number of bytes that the file announces beyond its end.
    pub missing: usize,
}

/// Parts of a file of any of the two kinds.
///
/// # Errors
/// Fault of the container, in words.
pub fn chunks(bytes: &[u8]) -> Result<Chunks, String> {
    if bytes.starts_with(b"glTF") {
        return glb_chunks(bytes);
    }
    let json = text(bytes, 0..bytes.len());
    if bytes[json.clone()].iter().find(|byte| !byte.is_ascii_whitespace()) != Some(&b'{') {
        return Err("it is neither a .glb nor JSON".into());
    }
    Ok(Chunks { json, blob: None, missing: 0 })
}

fn glb_chunks(bytes: &[u8]) -> Result<Chunks, String> {
    let number = |offset: usize| Some(u32::from_le_bytes(bytes.get(offset..offset.checked_add(4)?)?.try_into().ok()?));
    let version = number(4).ok_or("its header is cut short")?;
    if version != 2 {
        return Err(format!("its container has version {version}, not 2"));
    }
    let length = number(8).ok_or("its header is cut short")? as usize;
    let missing = length.saturating_sub(bytes.len());
    let (mut json, mut blob) = (None, None);
    let mut at = 12;
    while let (Some(size), Some(kind)) = (number(at), bytes.get(at + 4..at + 8)) {
        let start = at + 8;
        let end = start.saturating_add(size as usize);
        match kind {
            b"JSON" if json.is_none() => {
                bytes.get(start..end).ok_or("its JSON is cut short")?;
                json = Some(text(bytes, start..end));
            }
            b"BIN\0" if blob.is_none() => blob = Some(start..end.min(bytes.len())),
            _ => {}
        }
        if json.is_none() {
            return Err("its first chunk is not JSON".into());
        }
        at = end;
    }
    let json = json.ok_or("its first chunk is cut short")?;
    if bytes[json.clone()].iter().find(|byte| !byte.is_ascii_whitespace()) != Some(&b'{') {
        return Err("its JSON is no object".into());
    }
    Ok(Chunks { json, blob, missing })
}

/// Range of a text without a mark of its encoding before it and zeros behind.
fn text(bytes: &[u8], within: Range<usize>) -> Range<usize> {
    let start = within.start + if bytes[within.clone()].starts_with(b"\xef\xbb\xbf") { 3 } else { 0 };
    let last = bytes[start..within.end].iter().rposition(|&byte| byte != 0);
    start..last.map_or(start, |last| start + last + 1)
}

/// Part of a slice, by numbers from a file; `None` if it does not exist.
pub fn range(bytes: &[u8], offset: u64, length: u64) -> Option<&[u8]> {
    let start = usize::try_from(offset).ok()?;
    let end = usize::try_from(offset.checked_add(length)?).ok()?;
    bytes.get(start..end)
}

#[cfg(test)]
mod tests {
    //! Law: the JSON of a container is its text alone, whatever stands around it.
    #![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

    use super::*;

    #[test]
    fn a_mark_of_the_encoding_and_padding_are_no_json() {
        let texts: [&[u8]; 4] = [b"{ }", b"\xef\xbb\xbf{ }", b"{ }\0\0", b"\xef\xbb\xbf{ }\0"];
        for text in texts {
            let length = text.len() as u32;
            let head =
                [&b"glTF"[..], &2_u32.to_le_bytes(), &(20 + length).to_le_bytes(), &length.to_le_bytes()].concat();
            let glb = [&head[..], b"JSON", text].concat();
            for bytes in [text, &glb] {
                assert_eq!(&bytes[chunks(bytes).unwrap().json], b"{ }");
            }
        }
    }
}
