//! Displays by name: built in, or read from a file of any format.

use crate::built_in;
use crate::check::check_imported;
use crate::display::Display;
use crate::display_file::DisplayFile;
use crate::error::DisplayError;
use crate::file::parse::parse;
use crate::format::DisplayFormat;
use crate::import::{mpcdi, pvx};
use std::path::Path;

impl Display {
    /// Reads a display file: `.toml`, or a file of another program: `.pvx`, `.mpcdi`, `.mpcdi.xml`.
    ///
    /// # Errors
    /// [`DisplayError`] with file, line, key and reason.
    pub fn load(path: &Path) -> Result<Self, DisplayError> {
        let file = DisplayFile::read(path)?;
        let (name, stem, folder) = (path.display().to_string(), file.stem(), file.folder());
        let imported = match file.format {
            DisplayFormat::Toml => {
                let mut display = parse(file.text()?, &name, folder)?;
                if display.name.is_empty() {
                    display.name = stem;
                }
                return Ok(display);
            }
            DisplayFormat::Pvx => pvx::parse(&file.bytes),
            DisplayFormat::Mpcdi => mpcdi::parse(file.bytes, folder),
        };
        let mut display = imported.map_err(|reason| DisplayError::Import { path: path.to_owned(), reason })?;
        display.name = stem;
        check_imported(&name, &display)?;
        Ok(display)
    }

    /// Built-in display, by one of [`built_in::NAMES`].
    pub fn built_in(name: &str) -> Option<Self> {
        let mut display = parse(built_in::text(name)?, name, Path::new("")).ok()?;
        display.name = name.to_owned();
        Some(display)
    }

    /// Built-in display called `name`, or else the display in the file at that path.
    ///
    /// # Errors
    /// [`DisplayError`]. [`DisplayError::NoSuch`] lists the built-in displays if there is no such file either.
    pub fn named_or_file(name: &str) -> Result<Self, DisplayError> {
        if let Some(display) = Self::built_in(name) {
            return Ok(display);
        }
        let path = Path::new(name);
        if path.exists() || path.extension().is_some() {
            return Self::load(path);
        }
        Err(DisplayError::NoSuch { name: name.to_owned() })
    }
}

/// True for a display file, judged by its ending.
pub fn is_display(path: &Path) -> bool {
    DisplayFormat::of(path).is_some()
}
