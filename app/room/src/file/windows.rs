//! `[[window]]` tables: monitor, size, and how the eyes share pixels.

use super::text::DisplayText;
use super::{names, schema};
use crate::error::DisplayError;
use crate::window::{Combine, Monitor, WindowPlace};
use toml::{Spanned, Value};

/// Largest side of a window, pixels. No graphics device draws a larger one.
const MAX_PIXELS: u32 = 1 << 16;

/// Windows of all `[[window]]` tables, in the file's order.
pub(super) fn resolve(
    text: &DisplayText<'_>,
    tables: &[Spanned<schema::WindowTable>],
) -> Result<Vec<WindowPlace>, DisplayError> {
    names::check(text, "window", tables, |window| &window.name)?;
    tables.iter().map(|table| window(text, table)).collect()
}

fn window(text: &DisplayText<'_>, table: &Spanned<schema::WindowTable>) -> Result<WindowPlace, DisplayError> {
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
