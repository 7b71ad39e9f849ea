//! Reading of whole files. Only regular files are opened, because reading a pipe named in a display would never end.

use std::path::Path;

/// Largest file that is read, bytes.
const MAX_FILE: u64 = 1 << 30;

/// Bytes of a file. Error texts are worded to follow the file's name.
pub(crate) fn bytes(path: &Path) -> Result<Vec<u8>, String> {
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

/// Text of a file. Error texts are worded to follow the file's name.
pub(crate) fn text(path: &Path) -> Result<String, String> {
    String::from_utf8(bytes(path)?).map_err(|_| "cannot be read: it is not UTF-8 text".into())
}
