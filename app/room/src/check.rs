//! Checks of the whole display: two channels on the same pixels, eyes behind their screens.

use crate::channel::Channel;
use crate::display::Display;
use crate::error::{DisplayError, FilePlace};
use crate::frustum::EyeBehind;
use crate::viewer::EyeSide;
use crate::window::Combine;
use glam::{DMat3, DVec2};

/// Refuses channels that overlap and eyes behind screens. `at` gives the place of a channel's key in the file.
pub(crate) fn check(display: &Display, at: &dyn Fn(usize, &str) -> Box<FilePlace>) -> Result<(), DisplayError> {
    for (index, channel) in display.channels.iter().enumerate() {
        for other in &display.channels[..index] {
            let combined = display.windows[channel.window].combine != Combine::None;
            if channel.window == other.window && overlap(channel, other) && !(combined && pair(channel, other)) {
                return Err(DisplayError::Overlap { at: at(index, "viewport"), other: other.name.clone() });
            }
        }
        if let Some(reason) = behind(display, channel) {
            let screen = display.screens[channel.screen].name.clone();
            return Err(DisplayError::Behind { at: at(index, ""), screen, eye: channel.eye.name(), reason });
        }
    }
    Ok(())
}

/// Checks an imported display as a written one is checked.
///
/// # Errors
/// [`DisplayError`].
pub(crate) fn check_imported(name: &str, display: &Display) -> Result<(), DisplayError> {
    check(display, &|index, _| {
        Box::new(FilePlace {
            file: name.to_owned(),
            line: None,
            key: format!("channel {:?}", display.channels[index].name),
        })
    })
}

fn overlap(a: &Channel, b: &Channel) -> bool {
    let apart = |i: usize| {
        let (a_to, b_to) = (a.viewport[i] + a.viewport[i + 2], b.viewport[i] + b.viewport[i + 2]);
        a_to <= b.viewport[i] || b_to <= a.viewport[i]
    };
    !(apart(0) || apart(1))
}

/// True for a left and a right channel on the same pixels.
fn pair(a: &Channel, b: &Channel) -> bool {
    a.viewport == b.viewport
        && matches!((a.eye, b.eye), (EyeSide::Left, EyeSide::Right) | (EyeSide::Right, EyeSide::Left))
}

/// Eye of the untracked head, if it sees the middle of the channel's part of the screen from behind.
fn behind(display: &Display, channel: &Channel) -> Option<EyeBehind> {
    let surface = &display.screens[channel.screen].surface;
    let eye_m = display.viewer.eye_m(channel.eye, display.viewer.head_m, DMat3::IDENTITY);
    let uv = channel.part.uv(DVec2::splat(0.5));
    // A projector's channel is judged at the middle of the area that it lights.
    let uv = match channel.projector {
        Some(_) => surface.uv(channel.point(display, DVec2::splat(0.5))?)?,
        None => uv,
    };
    let distance_m = (eye_m - surface.point(uv)?).dot(surface.normal(uv)?);
    (distance_m <= 0.0).then_some(EyeBehind { eye_m, distance_m })
}

/// Notices for the user about a display without errors.
pub(crate) fn notices(display: &Display) -> Vec<String> {
    let mut notices = Vec::new();
    for (index, window) in display.windows.iter().enumerate() {
        let name = &window.name;
        if window.combine.is_anaglyph() {
            notices.push(format!(
                "window {name:?}: an anaglyph tells the eyes apart by colour, so it cannot show the Doppler shift's colours too; \
                 switch the Doppler effect off, or choose another stereo"
            ));
        }
        if !display.channels.iter().any(|channel| channel.window == index) {
            notices.push(format!("window {name:?}: no channel draws in it, so it stays black"));
        }
    }
    for (index, channel) in display.channels.iter().enumerate() {
        let combine = display.windows[channel.window].combine;
        if combine != Combine::None && channel.eye != EyeSide::Centre && display.partner(index).is_none() {
            notices.push(format!(
                "channel {:?}: its window combines eyes by {}, but no channel has the same viewport for the other eye",
                channel.name,
                combine.name()
            ));
        }
    }
    notices
}
