//! Displays by name: built in, or read from a file of any format.

use crate::built_in;
use crate::check::check_imported;
use crate::display::Display;
use crate::display_file::DisplayFile;
use crate::error::DisplayError;
use crate::file::parse::{parse, parse_within};
use crate::format::DisplayFormat;
use crate::import::{mpcdi, ndisplay, pvx};
use regular_file::Budget;
use std::path::Path;

/// Tables of a display's file, at least one of which must be there.
const TABLES: [&str; 4] = ["screen", "window", "channel", "projector"];

/// Largest memory of a description, in bytes of its text.
const BYTES_OF_TEXT: u64 = 30;

impl Display {
    /// Reads a display file: `.toml`, or a file of another program: `.pvx`, `.mpcdi`, `.mpcdi.xml`, `.ndisplay`. It
    /// may take the memory of a default [`Budget`].
    ///
    /// # Errors
    /// [`DisplayError`] with file, line, key and reason.
    pub fn load(path: &Path) -> Result<Self, DisplayError> {
        Self::load_within(path, &Budget::default())
    }

    /// Reads a display file as [`load`](Self::load) does. The budget pays for the file and for all files that it
    /// names.
    ///
    /// # Errors
    /// [`DisplayError`] with file, line, key and reason.
    pub fn load_within(path: &Path, budget: &Budget) -> Result<Self, DisplayError> {
        let file = DisplayFile::read(path, budget)?;
        let (name, stem, folder) = (path.display().to_string(), file.stem(), file.folder());
        let import = |reason: String| DisplayError::Import { path: path.to_owned(), reason };
        if file.format != Some(DisplayFormat::Mpcdi) {
            budget.take(BYTES_OF_TEXT * file.bytes.len() as u64).map_err(|error| import(error.to_string()))?;
        }
        let imported = match file.format {
            None | Some(DisplayFormat::Toml) => {
                let no_display = DisplayError::NoDisplay { path: path.to_owned() };
                let Some(text) = display_text(&file) else { return Err(no_display) };
                let mut display = parse_within(text, &name, folder, budget)?;
                if display.name.is_empty() {
                    display.name = stem;
                }
                return Ok(display);
            }
            Some(DisplayFormat::Pvx) => pvx::parse(&file.bytes),
            Some(DisplayFormat::Mpcdi) => mpcdi::parse(file.bytes, folder, &stem, budget),
            Some(DisplayFormat::NDisplay) => ndisplay::parse(&file.bytes),
        };
        let mut display = imported.map_err(import)?;
        display.name = stem;
        check_imported(&name, &mut display)?;
        Ok(display)
    }

    /// Built-in display, by one of [`built_in::NAMES`].
    pub fn built_in(name: &str) -> Option<Self> {
        let mut display = parse(built_in::text(name)?, name, Path::new("")).ok()?;
        display.name = name.to_owned();
        Some(display)
    }

    /// Built-in display called `name`, or else the display in the file at that path, within a default [`Budget`].
    ///
    /// # Errors
    /// [`DisplayError`]. [`DisplayError::NoSuch`] lists the built-in displays if there is no such file either.
    pub fn named_or_file(name: &str) -> Result<Self, DisplayError> {
        Self::named_or_file_within(name, &Budget::default())
    }

    /// Built-in display called `name`, or else the display in the file at that path, within a budget.
    ///
    /// # Errors
    /// [`DisplayError`]. [`DisplayError::NoSuch`] lists the built-in displays if there is no such file either.
    pub fn named_or_file_within(name: &str, budget: &Budget) -> Result<Self, DisplayError> {
        if let Some(display) = Self::built_in(name) {
            return Ok(display);
        }
        let path = Path::new(name);
        if path.exists() || path.extension().is_some() {
            return Self::load_within(path, budget);
        }
        Err(DisplayError::NoSuch { name: name.to_owned() })
    }
}

/// Text of a file of this program; `None` if it is something else. A faulty display with the ending `.toml` is a
/// display: what is wrong with it is said when it is parsed.
fn display_text<'a>(file: &'a DisplayFile<'_>) -> Option<&'a str> {
    let named = file.format.is_some();
    let Ok(text) = std::str::from_utf8(&file.bytes) else { return None };
    match toml::from_str::<toml::Table>(text) {
        Ok(table) => TABLES.iter().any(|key| table.contains_key(*key)).then_some(text),
        Err(_) => named.then_some(text),
    }
}

/// True for a display file, judged by its ending in upper or lower case.
pub fn is_display(path: &Path) -> bool {
    DisplayFormat::of(path).is_some()
}
