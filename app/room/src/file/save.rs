//! Saving of nudged corners in the display file they came from. Everything else in the file stays as it is, to the
//! letter.

use super::parse::parse_within;
use crate::built_in;
use crate::display_file::DisplayFile;
use crate::error::DisplayError;
use crate::format::DisplayFormat;

use glam::DVec2;
use regular_file::Budget;
use std::path::{Path, PathBuf};
use thiserror::Error;
use toml_edit::{Array, DocumentMut, Formatted, InlineTable, Item, TableLike, Value};

/// The keys of `corners`, in the order of [`CornerWarp::places`](crate::CornerWarp::places).
const KEYS: [&str; 4] = ["upper_left", "upper_right", "lower_right", "lower_left"];

/// Reason why corners are not saved.
#[derive(Debug, Error)]
pub enum SaveError {
    /// A display built into the program, which has no file.
    #[error(
        "{name} is built in, so there is no file to save in: copy its file, app/displays/{name}.toml, and name the copy with --display"
    )]
    BuiltIn {
        /// Name of the display.
        name: String,
    },
    /// A file of another program, which is only read.
    #[error("{}: files of other programs are only read; describe the display in a .toml file, where corners can be saved", path.display())]
    Imported {
        /// Path of the file.
        path: PathBuf,
    },
    /// A file that is no longer valid TOML.
    #[error("the file cannot be understood any more: {0}")]
    Syntax(#[from] toml_edit::TomlError),
    /// A channel that is no longer in the file.
    #[error("the file has no channel {name:?} any more; start the ride again")]
    NoChannel {
        /// Name of the channel.
        name: String,
    },
    /// A channel whose `corners` key is not a table.
    #[error("channel {name:?}: its corners are no table {{ upper_left = [x, y], … }}; mend the file")]
    NoTable {
        /// Name of the channel.
        name: String,
    },
    /// A file that cannot be read, or whose text would no longer be a valid display once saved.
    #[error("nothing was saved: {0}")]
    Display(#[from] Box<DisplayError>),
    /// A file that the operating system does not write.
    #[error("{} cannot be written: {error}; check the folder, its permissions and the space left", path.display())]
    Write {
        /// Path of the file.
        path: PathBuf,
        /// Error of the operating system.
        error: std::io::Error,
    },
}

/// Name of a channel and its corners in pixels from its viewport's upper left; `None` for the viewport's own corners.
pub type NudgedCorners<'a> = (&'a str, Option<[DVec2; 4]>);

/// Text of a display file with other corners, in the order upper left, upper right, lower right, lower left.
/// Comments, the order of the keys and all other keys stay as they are, and so do corners that have not moved.
///
/// # Errors
/// [`SaveError`]: the text is no TOML, or it has no such channel.
pub fn saved(text: &str, corners: &[NudgedCorners<'_>]) -> Result<String, SaveError> {
    let mut document: DocumentMut = text.parse()?;
    for (name, places) in corners {
        let channel = channel(&mut document, name).ok_or_else(|| SaveError::NoChannel { name: (*name).to_owned() })?;
        let Some(places) = places else {
            channel.remove("corners");
            continue;
        };
        let table = channel.entry("corners").or_insert_with(|| Item::Value(InlineTable::new().into()));
        let table = table.as_table_like_mut().ok_or_else(|| SaveError::NoTable { name: (*name).to_owned() })?;
        for (key, place) in KEYS.into_iter().zip(places) {
            put(table, key, *place);
        }
    }
    Ok(document.to_string())
}

/// Saves corners in the file of the display called `name`; see [`saved`]. The file is replaced whole, or not changed
/// at all.
///
/// # Errors
/// [`SaveError`].
pub fn save(name: &str, corners: &[NudgedCorners<'_>]) -> Result<PathBuf, SaveError> {
    if built_in::text(name).is_some() {
        return Err(SaveError::BuiltIn { name: name.to_owned() });
    }
    if DisplayFormat::of(Path::new(name)).is_some_and(|format| format != DisplayFormat::Toml) {
        return Err(SaveError::Imported { path: name.into() });
    }
    // The display is open already, so its files may take as much memory again.
    let budget = Budget::new(u64::MAX);
    let file = DisplayFile::read(Path::new(name), &budget).map_err(Box::new)?;
    let text = saved(file.text().map_err(Box::new)?, corners)?;
    parse_within(&text, name, file.folder(), &budget).map_err(Box::new)?;

    // A link's target is written, not the link.
    let cannot = |error| SaveError::Write { path: name.into(), error };
    let path = std::fs::canonicalize(name).map_err(cannot)?;
    let mut partial = path.clone().into_os_string();
    partial.push(".part");
    let partial = PathBuf::from(partial);
    let written = std::fs::metadata(&path).and_then(|before| {
        let mut file = std::fs::File::create(&partial)?;
        std::io::Write::write_all(&mut file, text.as_bytes())?;
        file.set_permissions(before.permissions())?;
        file.sync_all()?;
        std::fs::rename(&partial, &path)
    });
    if let Err(error) = written {
        // The first error has been reported already. A failure to remove the partial file would add nothing.
        let _ = std::fs::remove_file(&partial);
        return Err(cannot(error));
    }
    Ok(path)
}

/// Table of a channel, written `[[channel]]` or `channel = [{ … }]`.
fn channel<'a>(document: &'a mut DocumentMut, name: &str) -> Option<&'a mut dyn TableLike> {
    let named = |table: &dyn TableLike| table.get("name").and_then(Item::as_str) == Some(name);
    match document.get_mut("channel")? {
        Item::ArrayOfTables(tables) => {
            tables.iter_mut().map(|table| -> &mut dyn TableLike { table }).find(|table| named(&**table))
        }
        Item::Value(Value::Array(tables)) => tables
            .iter_mut()
            .filter_map(|table| table.as_inline_table_mut().map(|table| -> &mut dyn TableLike { table }))
            .find(|table| named(&**table)),
        _ => None,
    }
}

/// Writes a corner, unless it is there already.
fn put(corners: &mut dyn TableLike, key: &str, place: DVec2) {
    let before = corners.get(key).and_then(Item::as_value);
    if before.and_then(coordinates) == Some(place) {
        return;
    }
    let written = |coordinate: f64| Value::Float(Formatted::new(coordinate));
    let mut value = Value::Array(Array::from_iter([written(place.x), written(place.y)]));
    // The text around the old value stays, such as a comment behind it in a table of its own.
    if let Some(before) = before {
        *value.decor_mut() = before.decor().clone();
    }
    corners.insert(key, Item::Value(value));
}

fn coordinates(value: &Value) -> Option<DVec2> {
    let number = |value: &Value| value.as_float().or_else(|| value.as_integer().map(|whole| whole as f64));
    let array = value.as_array()?;
    Some(DVec2::new(number(array.get(0)?)?, number(array.get(1)?)?))
}

#[cfg(test)]
mod tests;
