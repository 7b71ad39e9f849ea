//! Checks of the whole display: two channels on the same pixels, eyes behind their screens. The time they take grows
//! with the number of channels, not with that of their pairs.

use crate::channel::Channel;
use crate::display::Display;
use crate::error::{DisplayError, FilePlace};
use crate::frustum::EyeBehind;
use crate::overlaps::overlap;
use crate::viewer::EyeSide;
use crate::window::Combine;
use glam::{DMat3, DVec2};
use std::collections::{HashMap, HashSet};

/// Refuses channels that overlap and eyes behind screens. `at` gives the place of a channel's key in the file.
pub(crate) fn check(display: &Display, at: &dyn Fn(usize, &str) -> Box<FilePlace>) -> Result<(), DisplayError> {
    separate(display, at)?;
    for (index, channel) in display.channels.iter().enumerate() {
        if let Some(reason) = behind(display, channel) {
            let screen = display.screens[channel.screen].name.clone();
            return Err(DisplayError::Behind { at: at(index, ""), screen, eye: channel.eye.name(), reason });
        }
    }
    Ok(())
}

/// Checks an imported display as a written one is checked. Projectors of other programs may light a thing from all
/// sides, so an eye that does not see what one of them lights is a notice there.
///
/// # Errors
/// [`DisplayError`].
pub(crate) fn check_imported(name: &str, display: &mut Display) -> Result<(), DisplayError> {
    let mut notices = Vec::new();
    let at = |display: &Display, index: usize| {
        let key = format!("channel {:?}", display.channels[index].name);
        Box::new(FilePlace { file: name.to_owned(), line: None, key })
    };
    separate(display, &|index, _| at(display, index))?;
    for (index, channel) in display.channels.iter().enumerate() {
        let Some(reason) = behind(display, channel) else { continue };
        if channel.projector.is_none() {
            let screen = display.screens[channel.screen].name.clone();
            return Err(DisplayError::Behind { at: at(display, index), screen, eye: channel.eye.name(), reason });
        }
        notices.push(format!("channel {:?}: the untracked head does not see what it lights: {reason}", channel.name));
    }
    display.notices.extend(notices);
    Ok(())
}

/// Refuses channels that overlap.
fn separate(display: &Display, at: &dyn Fn(usize, &str) -> Box<FilePlace>) -> Result<(), DisplayError> {
    let refuse = |[a, b]: [usize; 2]| {
        let (first, second) = (a.min(b), a.max(b));
        Err(DisplayError::Overlap { at: at(second, "viewport"), other: display.channels[first].name.clone() })
    };

    // Channels with the same pixels are pairs of eyes, or wrong. What is left has pixels of its own.
    let mut alone: Vec<Vec<usize>> = vec![Vec::new(); display.windows.len()];
    let mut known: HashMap<(usize, [u32; 4]), (usize, bool)> = HashMap::new();
    for (index, channel) in display.channels.iter().enumerate() {
        let combined = display.windows[channel.window].combine != Combine::None;
        match known.get_mut(&(channel.window, channel.viewport)) {
            None => {
                known.insert((channel.window, channel.viewport), (index, false));
                alone[channel.window].push(index);
            }
            Some((first, paired)) => {
                if *paired || !combined || !eyes_of_one_head(&display.channels[*first], channel) {
                    return refuse([*first, index]);
                }
                *paired = true;
            }
        }
    }
    for channels in alone {
        let viewports: Vec<[u32; 4]> = channels.iter().map(|&channel| display.channels[channel].viewport).collect();
        if let Some(found) = overlap(&viewports) {
            return refuse(found.map(|position| channels[position]));
        }
    }
    Ok(())
}

/// True for a left and a right channel.
fn eyes_of_one_head(a: &Channel, b: &Channel) -> bool {
    matches!((a.eye, b.eye), (EyeSide::Left, EyeSide::Right) | (EyeSide::Right, EyeSide::Left))
}

/// Eye of the untracked head, if it sees the middle of the channel's part of the screen from behind.
fn behind(display: &Display, channel: &Channel) -> Option<EyeBehind> {
    let screen = &display.screens[channel.screen];
    let eye_m = display.viewer.eye_m(channel.eye, display.viewer.head_m, DMat3::IDENTITY);
    let middle = DVec2::splat(0.5);
    // A projector's channel is judged at the middle of the area that it lights.
    let (point, normal) = match channel.projector(display) {
        Some(projector) => {
            let (_, point, normal) = channel.lit(screen, projector, middle)?;
            (point, normal)
        }
        None => {
            let uv = channel.part.uv(middle);
            (screen.surface.point(uv)?, screen.surface.normal(uv)?)
        }
    };
    let distance_m = (eye_m - point).dot(normal);
    (distance_m <= 0.0).then_some(EyeBehind { eye_m, distance_m })
}

/// Notices for the user about a display without errors.
pub(crate) fn notices(display: &Display) -> Vec<String> {
    let mut notices = Vec::new();
    let drawn: HashSet<usize> = display.channels.iter().map(|channel| channel.window).collect();
    for (index, window) in display.windows.iter().enumerate() {
        let name = &window.name;
        if window.combine.is_anaglyph() {
            notices.push(format!(
                "window {name:?}: an anaglyph tells the eyes apart by colour, so it cannot show the Doppler shift's colours too; \
                 switch the Doppler effect off, or choose another stereo"
            ));
        }
        if !drawn.contains(&index) {
            notices.push(format!("window {name:?}: no channel draws in it, so it stays black"));
        }
    }
    let views: HashSet<_> =
        display.channels.iter().map(|channel| (channel.window, channel.viewport, channel.eye)).collect();
    for channel in &display.channels {
        let combine = display.windows[channel.window].combine;
        let other = match channel.eye {
            EyeSide::Left => EyeSide::Right,
            EyeSide::Right => EyeSide::Left,
            EyeSide::Centre => continue,
        };
        if combine != Combine::None && !views.contains(&(channel.window, channel.viewport, other)) {
            notices.push(format!(
                "channel {:?}: its window combines eyes by {}, but no channel has the same viewport for the other eye",
                channel.name,
                combine.name()
            ));
        }
    }
    notices
}
