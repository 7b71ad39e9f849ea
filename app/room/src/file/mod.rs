//! Display files: TOML in, a checked [`Display`] out. docs/DISPLAYS.md lists every key.
//!
//! Module `schema` has the tables as written, `screens`, `projectors` and `channels` resolve them, and `check` makes
//! the checks that need the whole display. [`save()`] writes nudged corners back into the file.

mod channels;
mod check;
mod projectors;
mod save;
mod schema;
mod screens;
mod text;

pub use save::{NudgedCorners, SaveError, save, saved};

use super::{At, Combine, Display, DisplayError, Monitor, Viewer, WindowPlace, read};
use glam::DVec3;
use schema::File;
use std::path::Path;
use text::Text;
use toml::{Spanned, Value};

/// Largest side of a window, pixels. No graphics device draws a larger one.
const MAX_PIXELS: u32 = 1 << 16;

/// Reads a display file.
///
/// # Errors
/// [`DisplayError`].
pub fn load(path: &Path) -> Result<Display, DisplayError> {
    let text = read::text(path).map_err(|reason| DisplayError::Read { path: path.to_owned(), reason })?;
    let mut display = parse(&text, &path.display().to_string(), path.parent().unwrap_or(Path::new("")))?;
    if display.name.is_empty() {
        display.name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    }
    Ok(display)
}

/// Understands a display file's text.
///
/// # Arguments
/// * `name` — name of the file, for errors.
/// * `folder` — folder of the files that the text names.
///
/// # Errors
/// [`DisplayError`].
pub fn parse(text: &str, name: &str, folder: &Path) -> Result<Display, DisplayError> {
    let text = Text { name, text };
    let file: File = toml::from_str(text.text).map_err(|error| text.syntax(&error))?;
    let viewer = viewer(&text, file.viewer.as_ref())?;
    let screens = screens::resolve(&text, &file.screen, folder)?;
    let windows = windows(&text, &file.window)?;
    let projectors = projectors::resolve(&text, &file.projector, folder)?;
    let channels =
        channels::Resolver { text: &text, screens: &screens, projectors: &projectors, windows: &windows, folder }
            .resolve(&file.channel)?;
    let mut display = Display {
        name: file.name.clone().unwrap_or_default(),
        viewer,
        screens,
        projectors,
        windows,
        channels,
        tracker: file.tracker.clone(),
        notices: Vec::new(),
    };
    if display.channels.is_empty() {
        let at = Box::new(At { file: text.name.into(), line: None, key: String::new() });
        return Err(DisplayError::Value { at, reason: "it has no [[channel]], so nothing would be seen".into() });
    }
    display.notices = check::notices(&display);
    check::check(&display, &|index, key| {
        text.at(file.channel[index].span().start, &format!("channel {:?}", display.channels[index].name), key)
    })?;
    Ok(display)
}

/// Checks an imported display as a written one is checked.
///
/// # Errors
/// [`DisplayError`].
pub(super) fn check_imported(name: &str, display: &Display) -> Result<(), DisplayError> {
    check::check(display, &|index, _| {
        Box::new(At { file: name.to_owned(), line: None, key: format!("channel {:?}", display.channels[index].name) })
    })
}

/// Checks that names are unique and not empty.
fn names<'a, T: 'a>(
    text: &Text<'_>,
    kind: &'static str,
    tables: &'a [Spanned<T>],
    name: impl Fn(&'a T) -> &'a str,
) -> Result<(), DisplayError> {
    let mut seen = std::collections::HashSet::new();
    for table in tables {
        let name = name(table.get_ref());
        let at = || text.at(table.span().start, &format!("{kind} {name:?}"), "name");
        if name.trim().is_empty() {
            return Err(DisplayError::NotAName { at: at(), name: name.into(), reason: "it is empty" });
        }
        if !seen.insert(name) {
            return Err(DisplayError::Duplicate { at: at(), kind, name: name.into() });
        }
    }
    Ok(())
}

fn viewer(text: &Text<'_>, table: Option<&Spanned<schema::Viewer>>) -> Result<Viewer, DisplayError> {
    let mut viewer = Viewer::default();
    let Some(table) = table else { return Ok(viewer) };
    let refuse = |key: &str, reason: &str| {
        Err(DisplayError::Value { at: text.at(table.span().start, "viewer", key), reason: reason.into() })
    };
    let given = table.get_ref();
    if let Some(separation) = given.eye_separation {
        if !(0.0..=1.0).contains(&separation) {
            return refuse(
                "eye_separation",
                &format!("{separation} m is no distance between eyes; people have 0.05 to 0.08"),
            );
        }
        viewer.eye_separation_m = separation;
    }
    if let Some(scale) = given.eye_scale {
        if !(scale.is_finite() && scale >= 0.0) {
            return refuse("eye_scale", &format!("{scale} is no scale; 1 is true, 0 takes the depth away"));
        }
        viewer.eye_scale = scale;
    }
    if let Some(head) = given.head.map(DVec3::from) {
        if !head.is_finite() {
            return refuse("head", "a coordinate is not a finite number");
        }
        viewer.head_m = head;
    }
    Ok(viewer)
}

fn windows(text: &Text<'_>, tables: &[Spanned<schema::Window>]) -> Result<Vec<WindowPlace>, DisplayError> {
    names(text, "window", tables, |window| &window.name)?;
    tables.iter().map(|table| window(text, table)).collect()
}

fn window(text: &Text<'_>, table: &Spanned<schema::Window>) -> Result<WindowPlace, DisplayError> {
    let given = table.get_ref();
    let at = |key: &str| text.at(table.span().start, &format!("window {:?}", given.name), key);
    let refuse = |key: &str, reason: String| Err(DisplayError::Value { at: at(key), reason });
    if given.size.iter().any(|side| !(1..=MAX_PIXELS).contains(side)) {
        let [width, height] = given.size;
        return refuse("size", format!("{width} × {height} pixels are no window; each side must be 1 to {MAX_PIXELS}"));
    }
    let monitor = match &given.monitor {
        None => None,
        Some(Value::String(name)) => Some(Monitor::Name(name.clone())),
        Some(Value::Integer(index)) if *index >= 0 => Some(Monitor::Index(*index as usize)),
        Some(other) => {
            return refuse("monitor", format!("{other} is no monitor; write its name in quotes, or its number from 0"));
        }
    };
    let combine = match &given.combine {
        None => Combine::None,
        Some(name) => match Combine::ALL.into_iter().find(|combine| combine.name() == name) {
            Some(combine) => combine,
            None => {
                let known = Combine::ALL.map(|combine| combine.name().to_owned()).to_vec();
                return Err(DisplayError::Unknown { at: at("combine"), kind: "combine", name: name.clone(), known });
            }
        },
    };
    Ok(WindowPlace {
        name: given.name.clone(),
        monitor,
        position: given.position,
        size: given.size,
        fullscreen: given.fullscreen,
        combine,
        swap_eyes: given.swap_eyes,
    })
}
