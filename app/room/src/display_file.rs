//! File of a display. Loading and saving both begin here, and nothing else reads one.

use crate::error::DisplayError;
use crate::format::DisplayFormat;
use crate::read;
use regular_file::Budget;
use std::path::Path;

/// File of a display, read whole.
pub(crate) struct DisplayFile<'a> {
    /// Path of the file, as the user gave it.
    pub path: &'a Path,
    /// Format by the file's ending; `None` for another ending, which is taken for a file of this program.
    pub format: Option<DisplayFormat>,
    /// Contents of the file.
    pub bytes: Vec<u8>,
}

impl<'a> DisplayFile<'a> {
    /// Reads a file.
    ///
    /// # Errors
    /// [`DisplayError::Read`].
    pub fn read(path: &'a Path, budget: &Budget) -> Result<Self, DisplayError> {
        let bytes = read::bytes(path, budget).map_err(|reason| DisplayError::Read { path: path.to_owned(), reason })?;
        Ok(Self { path, format: DisplayFormat::of(path), bytes })
    }

    /// Text of the file.
    ///
    /// # Errors
    /// [`DisplayError::Read`] if it is not UTF-8.
    pub fn text(&self) -> Result<&str, DisplayError> {
        let reason = "cannot be read: it is not UTF-8 text";
        std::str::from_utf8(&self.bytes)
            .map_err(|_| DisplayError::Read { path: self.path.to_owned(), reason: reason.into() })
    }

    /// Folder of the files that this file names.
    pub fn folder(&self) -> &'a Path {
        self.path.parent().unwrap_or(Path::new(""))
    }

    /// Name of the file without its ending.
    pub fn stem(&self) -> String {
        let stem = self.path.file_stem().unwrap_or_default().to_string_lossy();
        stem.trim_end_matches(".mpcdi").to_owned()
    }
}
