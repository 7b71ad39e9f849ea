//! Reading of the files that a display names. Error texts are worded to follow the file's name.

use regular_file::Budget;
use std::path::Path;

/// Largest file that is read, bytes.
const MAX_FILE: u64 = 1 << 30;

/// Bytes of a file. The budget pays for them before they are read.
pub(crate) fn bytes(path: &Path, budget: &Budget) -> Result<Vec<u8>, String> {
    let length = std::fs::metadata(path).map_or(0, |metadata| metadata.len());
    if length <= MAX_FILE {
        budget.take(length).map_err(|error| format!("cannot be read: {error}"))?;
    }
    regular_file::read(path, MAX_FILE).map_err(|error| format!("cannot be read: {error}"))
}

/// Text of a file.
pub(crate) fn text(path: &Path, budget: &Budget) -> Result<String, String> {
    String::from_utf8(bytes(path, budget)?).map_err(|_| "cannot be read: it is not UTF-8 text".into())
}
