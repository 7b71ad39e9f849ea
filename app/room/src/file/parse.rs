//! Text of a display file in, a checked display out.

use super::schema::DisplayTables;
use super::text::DisplayText;
use super::{channels, projectors, screens, viewer, windows};
use crate::check;
use crate::display::Display;
use crate::error::{DisplayError, FilePlace};
use crate::maps::MapShelf;
use regular_file::Budget;
use std::path::Path;

/// Understands a display file's text.
///
/// # Arguments
/// * `name` — name of the file, for errors.
/// * `folder` — folder of the files that the text names.
///
/// # Errors
/// [`DisplayError`].
pub fn parse(text: &str, name: &str, folder: &Path) -> Result<Display, DisplayError> {
    parse_within(text, name, folder, &Budget::default())
}

/// Understands a display file's text as [`parse`] does. `budget` is the memory that the files may take which the text
/// names.
///
/// # Errors
/// [`DisplayError`].
pub fn parse_within(text: &str, name: &str, folder: &Path, budget: &Budget) -> Result<Display, DisplayError> {
    let text = DisplayText { name, text };
    let file: DisplayTables = toml::from_str(text.text).map_err(|error| text.syntax(&error))?;
    let viewer = viewer::resolve(&text, file.viewer.as_ref())?;
    let screens = screens::resolve(&text, &file.screen, folder, budget)?;
    let windows = windows::resolve(&text, &file.window)?;
    let projectors = projectors::resolve(&text, &file.projector, folder, budget)?;
    let channels = channels::ChannelResolver {
        text: &text,
        screens: &screens,
        projectors: &projectors,
        windows: &windows,
        folder,
        maps: MapShelf::new(budget),
    }
    .resolve(&file.channel)?;
    let mut display = Display {
        name: file.name.clone().unwrap_or_default(),
        viewer,
        screens,
        projectors,
        windows,
        channels,
        set_up: file.set_up(),
        notices: Vec::new(),
    };
    if display.channels.is_empty() {
        let at = Box::new(FilePlace { file: text.name.into(), line: None, key: String::new() });
        return Err(DisplayError::Value { at, reason: "it has no [[channel]], so nothing would be seen".into() });
    }
    display.notices = check::notices(&display);
    check::check(&display, &|index, key| {
        text.at(file.channel[index].span().start, &format!("channel {:?}", display.channels[index].name), key)
    })?;
    Ok(display)
}
