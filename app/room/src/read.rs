//! Reading of the files that a display names. Error texts are worded to follow the file's name.

use std::path::Path;

/// Largest file that is read, bytes.
const MAX_FILE: u64 = 1 << 30;

/// Bytes of a file.
pub(crate) fn bytes(path: &Path) -> Result<Vec<u8>, String> {
    regular_file::read(path, MAX_FILE).map_err(|error| format!("cannot be read: {error}"))
}

/// Text of a file.
pub(crate) fn text(path: &Path) -> Result<String, String> {
    String::from_utf8(bytes(path)?).map_err(|_| "cannot be read: it is not UTF-8 text".into())
}
