//! Files as a whole. Nothing but regular files is opened: a display that names a pipe would never come to an end.

use std::path::Path;

/// The largest file that is read, bytes.
const MAX_FILE: u64 = 1 << 30;

/// A file's bytes. What is wrong is said in words that follow its name.
pub(super) fn bytes(path: &Path) -> Result<Vec<u8>, String> {
    let cannot = |error: std::io::Error| format!("cannot be read: {error}");
    let metadata = std::fs::metadata(path).map_err(cannot)?;
    if !metadata.is_file() {
        return Err("cannot be read: it is no file".into());
    }
    if metadata.len() > MAX_FILE {
        return Err(format!("cannot be read: it is larger than {MAX_FILE} bytes"));
    }
    std::fs::read(path).map_err(cannot)
}

/// A file's text.
pub(super) fn text(path: &Path) -> Result<String, String> {
    String::from_utf8(bytes(path)?).map_err(|_| "cannot be read: it is not UTF-8 text".into())
}
