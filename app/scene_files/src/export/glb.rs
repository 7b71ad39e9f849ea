//! Container of a binary glTF file: a header, the JSON, and the binary chunk.

use std::path::{Path, PathBuf};

use super::error::ExportError;

/// Writes header and chunks, each padded to whole words, under a temporary name first.
pub fn write(path: &Path, mut text: Vec<u8>, mut blob: Vec<u8>) -> Result<(), ExportError> {
    text.resize(text.len().next_multiple_of(4), b' ');
    blob.resize(blob.len().next_multiple_of(4), 0);
    let bytes = (12 + 8 + text.len() + 8 + blob.len()) as u64;
    let Ok(length) = u32::try_from(bytes) else {
        return Err(ExportError::TooLarge { path: path.into(), bytes });
    };
    // The casts lose nothing: both values are less than `length`.
    let word = |value: usize| (value as u32).to_le_bytes();
    let header = [&b"glTF"[..], &2_u32.to_le_bytes(), &length.to_le_bytes(), &word(text.len()), b"JSON"].concat();
    let middle = [&word(blob.len()), &b"BIN\0"[..]].concat();
    let mut partial = path.as_os_str().to_owned();
    partial.push(".part");
    let partial = PathBuf::from(partial);
    let result = std::fs::File::create(&partial).and_then(|mut file| {
        for part in [&header, &text, &middle, &blob] {
            std::io::Write::write_all(&mut file, part)?;
        }
        file.sync_all()?;
        std::fs::rename(&partial, path)
    });
    result.map_err(|error| {
        // A failure to remove the partial file is ignored; the first error is the one to report.
        let _ = std::fs::remove_file(&partial);
        ExportError::Write { path: path.into(), error }
    })
}
