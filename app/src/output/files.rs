//! Output files: checks before long work, and names that overwrite nothing.

use image::RgbaImage;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// File that cannot be written.
#[derive(Debug, Error)]
#[error("{}: could not be written: {reason}; choose another place", path.display())]
pub struct WriteError {
    /// File to be written.
    pub path: PathBuf,
    /// Reason, in the system's words.
    pub reason: String,
}

impl WriteError {
    /// Error for a file, with its reason.
    pub fn new(path: &Path, reason: impl ToString) -> Self {
        Self { path: path.to_owned(), reason: reason.to_string() }
    }
}

/// Checks before long work that its result can be written to `path`.
///
/// # Errors
/// [`WriteError`] if a folder of that name is in the way, or if the folder that the file belongs in is missing.
pub fn writable(path: &Path) -> Result<(), WriteError> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    if path.is_dir() {
        return Err(WriteError::new(path, "it is a folder"));
    }
    if !folder.is_dir() {
        return Err(WriteError::new(path, format!("there is no folder {}", folder.display())));
    }
    Ok(())
}

/// Writes a picture as PNG.
///
/// # Errors
/// [`WriteError`] with the path and the reason.
pub fn save(picture: &RgbaImage, path: &Path) -> Result<(), WriteError> {
    picture.save_with_format(path, image::ImageFormat::Png).map_err(|error| WriteError::new(path, error))
}

/// First of `stem-001.extension`, `stem-002.extension`, … that does not exist yet.
pub fn unused(stem: &str, extension: &str) -> PathBuf {
    (1_u32..)
        .map(|number| PathBuf::from(format!("{stem}-{number:03}.{extension}")))
        .find(|path| !path.exists())
        .expect("there are more numbers than files")
}
