//! Help: how to go, how to stop and how to get help, then every key.

use egui::{Align2, Grid, RichText, ScrollArea, Ui, Window};

/// What a first-time rider must know.
const FIRST: [(&str, &str); 3] = [
    ("To go", "hold W or the upward arrow, or pedal; A and D, or the arrows left and right, steer"),
    ("To stop", "hold the space bar; Backspace takes you back to the start"),
    ("For help", "F1 shows and hides this page"),
];

/// Height that the display's readings and the window's frame need, points.
const SURROUNDINGS: f32 = 210.0;

/// Width of a screen on which the keys stand in two columns, and of a column, points.
const WIDE: f32 = 1150.0;
const COLUMN: f32 = 540.0;

/// Keys and their meanings; the same list as in the README.
const KEYS: [(&str, &str); 27] = [
    ("W S  ↑ ↓", "pedal, push back; thrust forward, back; the arrows lower and raise the nose when flying"),
    ("A D  ← →", "steer; thrust sideways; the arrows turn the nose"),
    ("R F", "thrust up, down when flying"),
    ("Q E", "roll"),
    ("Shift", "sprint"),
    ("Space", "brake"),
    ("J L I K", "look left, right, up, down, as a drag of the mouse does; rooms and tracked heads look by themselves"),
    ("O", "look ahead again, as the middle button does"),
    ("U", "sit straight: with a tracked head, its present place and direction become the middle ones"),
    ("M", "look back, as long as it is held"),
    ("1 2 3", "bicycle, drive, fly"),
    ("P", "pause"),
    (".", "one step while paused"),
    ("− =", "your clock slower, faster"),
    ("G", "places as seen, as measured, in instant light"),
    ("B N", "Doppler shift, searchlight effect: on, off"),
    ("T", "next tone curve"),
    ("[ ]", "darker, brighter"),
    ("C", "photo"),
    ("V", "record the whole ride, from its beginning"),
    ("Backspace", "back to the start"),
    ("F1 H", "this help"),
    ("F2", "show or hide the readings"),
    ("F3", "settings"),
    ("F4", "move the corners of a room's pictures"),
    ("F11", "full screen"),
    ("Esc", "leave"),
];

/// Keys that do nothing in a kiosk.
const NOT_IN_KIOSK: [&str; 6] = ["C", "V", "F3", "F4", "F11", "Esc"];

/// Shows the help. In a kiosk the keys that do nothing there are left out.
pub fn show(ui: &Ui, open: &mut bool, kiosk: bool) {
    let screen = ui.ctx().content_rect();
    let window =
        Window::new("Help").open(open).anchor(Align2::CENTER_CENTER, [0.0, -24.0]).resizable(false).collapsible(false);
    window.show(ui.ctx(), |ui| {
        // All keys at a glance where there is room, else one below the other.
        let rows: Vec<_> = KEYS.into_iter().filter(|(keys, _)| !kiosk || !NOT_IN_KIOSK.contains(keys)).collect();
        let columns = if screen.width() >= WIDE { 2 } else { 1 };
        let bright = ui.visuals().strong_text_color();
        ui.set_max_width((screen.width() - 80.0).min(COLUMN * columns as f32));
        Grid::new("first").num_columns(2).spacing([24.0, 7.0]).show(ui, |ui| {
            for (what, how) in FIRST {
                ui.label(RichText::new(what).size(17.0).strong());
                ui.label(RichText::new(how).size(17.0).color(bright));
                ui.end_row();
            }
        });
        ui.separator();
        let height = (screen.height() - SURROUNDINGS).max(60.0);
        ScrollArea::vertical().max_height(height).min_scrolled_height(height).show(ui, |ui| {
            Grid::new("keys").num_columns(2 * columns).spacing([20.0, 5.0]).show(ui, |ui| {
                let high = rows.len().div_ceil(columns);
                for number in 0..high {
                    for (keys, meaning) in rows.iter().skip(number).step_by(high) {
                        ui.label(RichText::new(*keys).monospace().strong());
                        ui.label(*meaning);
                    }
                    ui.end_row();
                }
            });
        });
    });
}

#[cfg(test)]
mod tests {
    //! Law: what a visitor must know first stands first, and no key of the kiosk's list is unknown to the help.

    use super::*;

    #[test]
    fn going_stopping_and_help_come_first() {
        assert_eq!(FIRST.map(|(what, _)| what), ["To go", "To stop", "For help"]);
        for key in NOT_IN_KIOSK {
            assert!(KEYS.iter().any(|(keys, _)| *keys == key), "{key} is no row of the help");
        }
    }
}
