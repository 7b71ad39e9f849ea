//! `[[channel]]`: names become indices.

use super::schema::{self, File};
use super::text::Text;
use crate::room::error::{At, nearest};
use crate::room::{Channel, DisplayError, Eye, Part, Screen, WindowPlace};
use glam::{DVec2, DVec4};
use toml::Spanned;

/// All channels.
pub(super) fn resolve(
    text: &Text<'_>,
    file: &File,
    screens: &[Screen],
    windows: &[WindowPlace],
) -> Result<Vec<Channel>, DisplayError> {
    super::names(text, "channel", &file.channel, |channel| &channel.name)?;
    let screens: Vec<&str> = screens.iter().map(|screen| screen.name.as_str()).collect();
    file.channel.iter().map(|table| channel(text, table, &screens, windows)).collect()
}

fn channel(
    text: &Text<'_>,
    table: &Spanned<schema::Channel>,
    screens: &[&str],
    windows: &[WindowPlace],
) -> Result<Channel, DisplayError> {
    let given = table.get_ref();
    let at = |key: &str| text.at(table.span().start, &format!("channel {:?}", given.name), key);
    if let Some(reason) = not_a_file_name(&given.name) {
        return Err(DisplayError::NotAName { at: at("name"), name: given.name.clone(), reason });
    }
    let screen = find(|| at("screen"), "screen", &given.screen, screens)?;
    let names: Vec<&str> = windows.iter().map(|window| window.name.as_str()).collect();
    let window = find(|| at("window"), "window", &given.window, &names)?;
    let eyes = [Eye::Left, Eye::Right, Eye::Centre];
    let eye = given.eye.as_deref().unwrap_or("centre");
    let eye = eyes[find(|| at("eye"), "eye", eye, &eyes.map(Eye::name))?];
    let [width, height] = windows[window].size;
    let viewport = given.viewport.unwrap_or([0, 0, width, height]);
    if viewport[2] == 0 || viewport[3] == 0 {
        return Err(DisplayError::Value {
            at: at("viewport"),
            reason: "its width and height must be at least one pixel".into(),
        });
    }
    let inside = |from: u32, length: u32, whole: u32| u64::from(from) + u64::from(length) <= u64::from(whole);
    if !(inside(viewport[0], viewport[2], width) && inside(viewport[1], viewport[3], height)) {
        let window = &windows[window];
        return Err(DisplayError::ViewportOutside {
            at: at("viewport"),
            viewport,
            window: window.name.clone(),
            size: window.size,
        });
    }
    let part = match given.part.map(DVec4::from) {
        None => Part::default(),
        Some(part) => {
            let (from, to) = (DVec2::new(part.x, part.y), DVec2::new(part.z, part.w));
            if !(part.cmpge(DVec4::ZERO).all() && part.cmple(DVec4::ONE).all() && to.cmpgt(from).all()) {
                let reason = format!(
                    "{part} is no part of a screen; write left, bottom, right, top, each from 0 to 1, left < right, bottom < top"
                );
                return Err(DisplayError::Value { at: at("part"), reason });
            }
            Part { from, to }
        }
    };
    Ok(Channel { name: given.name.clone(), screen, eye, window, viewport, part })
}

/// The index of a name.
pub(super) fn find(at: impl Fn() -> At, kind: &'static str, name: &str, known: &[&str]) -> Result<usize, DisplayError> {
    known.iter().position(|candidate| *candidate == name).ok_or_else(|| DisplayError::Unknown {
        at: at(),
        kind,
        name: name.to_owned(),
        nearest: nearest(name, known.iter().copied()).map(str::to_owned),
        known: known.iter().map(|&name| name.to_owned()).collect(),
    })
}

/// Why a channel's picture cannot be called that.
fn not_a_file_name(name: &str) -> Option<&'static str> {
    if name.contains(['/', '\\']) {
        Some("a channel's picture is a file of that name, so it must have no / and no \\")
    } else if name.starts_with('.') {
        Some("a channel's picture is a file of that name, so it must not begin with a dot")
    } else if name.contains(|letter: char| letter.is_control() || "<>:\"|?*".contains(letter)) {
        Some(
            "a channel's picture is a file of that name, so it must have none of < > : \" | ? * and no control characters",
        )
    } else if name.len() > 200 {
        Some("a channel's picture is a file of that name, so it must be shorter than 200 bytes")
    } else {
        None
    }
}

/// What the user should know about a good display.
pub(super) fn notices(windows: &[WindowPlace], channels: &[Channel]) -> Vec<String> {
    let mut notices = Vec::new();
    for (index, window) in windows.iter().enumerate() {
        let name = &window.name;
        if window.combine.is_anaglyph() {
            notices.push(format!(
                "window {name:?}: an anaglyph tells the eyes apart by colour, so it cannot show the Doppler shift's colours too; \
                 switch the Doppler effect off, or choose another stereo"
            ));
        }
        if !channels.iter().any(|channel| channel.window == index) {
            notices.push(format!("window {name:?}: no channel draws in it, so it stays black"));
        }
    }
    notices
}
