//! Set-up file that a calibration writes.

use crate::commands::calibrating_error::CalibratingError;
use input::BicycleConfig;
use std::io::ErrorKind;
use std::path::Path;
use toml_edit::{DocumentMut, Item, Table, value};

/// Text of the file as it is, to keep what others wrote in it; an empty one if there is none.
///
/// # Errors
/// A file that is no set-up.
pub fn document(file: &Path) -> Result<DocumentMut, CalibratingError> {
    let refused = |reason: String| CalibratingError::File { file: file.display().to_string(), reason };
    let text = match std::fs::read_to_string(file) {
        Ok(text) => text,
        Err(error) if error.kind() == ErrorKind::NotFound => String::new(),
        Err(error) => return Err(refused(error.to_string())),
    };
    let document: DocumentMut = text
        .parse()
        .map_err(|error: toml_edit::TomlError| refused(error.message().lines().collect::<Vec<_>>().join(" ")))?;
    match document.get("bicycle") {
        Some(item) if !item.is_table_like() => Err(refused("its bicycle is no table".to_owned())),
        _ => Ok(document),
    }
}

/// Puts the settings into the table `[bicycle]`.
pub fn write(document: &mut DocumentMut, port: &str, baud: Option<u32>, config: &BicycleConfig) {
    let table = document.entry("bicycle").or_insert_with(|| {
        let mut table = Table::new();
        table
            .decor_mut()
            .set_prefix("# Written by `rapidity devices --calibrate`; docs/DEVICES.md explains every key.\n");
        Item::Table(table)
    });
    table["port"] = value(port);
    match baud {
        Some(baud) => table["baud"] = value(i64::from(baud)),
        None => drop(table.as_table_like_mut().and_then(|table| table.remove("baud"))),
    }
    // The text of every setting, as the reader of the file knows them.
    let settings = toml::Table::try_from(config).unwrap_or_default();
    for (key, setting) in settings {
        match setting {
            toml::Value::Float(number) => table[key.as_str()] = value(number),
            toml::Value::String(text) => table[key.as_str()] = value(text),
            toml::Value::Boolean(holds) => table[key.as_str()] = value(holds),
            _ => {}
        }
    }
}
