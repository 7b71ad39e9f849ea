//! Displays by name: built in, or read from a file of any format.

use crate::built_in;
use crate::check::check_imported;
use crate::display::Display;
use crate::error::DisplayError;
use crate::file::parse::parse;
use crate::format::DisplayFormat;
use crate::import::{mpcdi, pvx};
use crate::read;
use std::path::Path;

impl Display {
    /// Reads a display file: `.toml`, or a file of another program: `.pvx`, `.mpcdi`, `.mpcdi.xml`.
    ///
    /// # Errors
    /// [`DisplayError`] with file, line, key and reason.
    pub fn load(path: &Path) -> Result<Self, DisplayError> {
        let folder = path.parent().unwrap_or(Path::new(""));
        let cannot = |reason| DisplayError::Read { path: path.to_owned(), reason };
        let stem = path.file_stem().unwrap_or_default().to_string_lossy();
        let imported = match DisplayFormat::of(path).unwrap_or(DisplayFormat::Toml) {
            DisplayFormat::Toml => {
                let text = read::text(path).map_err(cannot)?;
                let mut display = parse(&text, &path.display().to_string(), folder)?;
                if display.name.is_empty() {
                    display.name = stem.into_owned();
                }
                return Ok(display);
            }
            DisplayFormat::Pvx => pvx::parse(&read::bytes(path).map_err(cannot)?),
            DisplayFormat::Mpcdi => mpcdi::parse(read::bytes(path).map_err(cannot)?, folder),
        };
        let mut display = imported.map_err(|reason| DisplayError::Import { path: path.to_owned(), reason })?;
        display.name = stem.trim_end_matches(".mpcdi").to_owned();
        check_imported(&path.display().to_string(), &display)?;
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
