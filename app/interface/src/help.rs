//! Help: how to go, how to stop and how to get help, then every key.

use egui::{Align2, Grid, RichText, ScrollArea, Ui, Window};
use words::{Language, Phrase};

/// What a first-time rider must know.
const FIRST: [(Phrase, Phrase); 3] =
    [(Phrase::ToGo, Phrase::ToGoHow), (Phrase::ToStop, Phrase::ToStopHow), (Phrase::ForHelp, Phrase::ForHelpHow)];

/// Height that the display's readings and the window's frame need, points.
const SURROUNDINGS: f32 = 210.0;

/// Width of a screen on which the keys stand in two columns, and of a column, points.
const WIDE: f32 = 1150.0;
const COLUMN: f32 = 540.0;

/// Keys and their meanings; the same list as in the README.
const KEYS: [(&str, Phrase); 31] = [
    ("W S  ↑ ↓", Phrase::KeyPedal),
    ("A D  ← →", Phrase::KeySteer),
    ("R F", Phrase::KeyLift),
    ("Q E", Phrase::KeyRoll),
    ("Shift", Phrase::KeySprint),
    ("Space", Phrase::KeyBrake),
    ("J L I K", Phrase::KeyLook),
    ("O", Phrase::KeyAhead),
    ("M", Phrase::KeyBack),
    ("1 2 3", Phrase::KeyVehicles),
    ("P", Phrase::KeyPause),
    (".", Phrase::KeyStep),
    ("− =", Phrase::KeyClock),
    ("Backspace", Phrase::KeyRestart),
    ("X", Phrase::KeyView),
    ("Y  F5  F9", Phrase::KeyOutside),
    ("Z  F6", Phrase::KeyDiagram),
    ("Tab", Phrase::KeyMap),
    ("G B N", Phrase::KeyEffects),
    ("T", Phrase::KeyTone),
    ("[ ]", Phrase::KeyBrightness),
    ("C  F8", Phrase::KeyPhoto),
    ("V", Phrase::KeyRecord),
    ("F1 H", Phrase::KeyHelp),
    ("F2", Phrase::KeyReadings),
    ("F3", Phrase::KeyMenu),
    ("F4", Phrase::KeyCalibrate),
    ("U", Phrase::KeyStraight),
    ("F7", Phrase::KeyHead),
    ("F11", Phrase::KeyFullScreen),
    ("Esc", Phrase::KeyLeave),
];

/// Name of a key as it is written on a keyboard of this language.
pub fn cap(key: &'static str, language: Language) -> &'static str {
    match key {
        "Shift" => language.text(Phrase::ShiftKey),
        "Space" => language.text(Phrase::SpaceKey),
        "Backspace" => language.text(Phrase::BackspaceKey),
        key => key,
    }
}

/// Keys that do nothing in a kiosk.
const NOT_IN_KIOSK: [&str; 6] = ["C  F8", "V", "F3", "F4", "F11", "Esc"];

/// Shows the help, and returns false once it is closed. In a kiosk the keys that do nothing there are left out.
pub fn show(ui: &Ui, language: Language, kiosk: bool) -> bool {
    let mut open = true;
    let screen = ui.ctx().content_rect();
    let window = Window::new(language.text(Phrase::Help))
        .open(&mut open)
        .anchor(Align2::CENTER_CENTER, [0.0, -24.0])
        .resizable(false)
        .collapsible(false);
    window.show(ui.ctx(), |ui| {
        // All keys at a glance where there is room, else one below the other.
        let rows: Vec<_> = KEYS.into_iter().filter(|(keys, _)| !kiosk || !NOT_IN_KIOSK.contains(keys)).collect();
        let columns = if screen.width() >= WIDE { 2 } else { 1 };
        let bright = ui.visuals().strong_text_color();
        ui.set_max_width((screen.width() - 80.0).min(COLUMN * columns as f32));
        Grid::new("first").num_columns(2).spacing([24.0, 7.0]).show(ui, |ui| {
            for (what, how) in FIRST {
                ui.label(RichText::new(language.text(what)).size(17.0).strong());
                ui.label(RichText::new(language.text(how)).size(17.0).color(bright));
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
                        ui.label(RichText::new(cap(keys, language)).monospace().strong());
                        ui.label(language.text(*meaning));
                    }
                    ui.end_row();
                }
            });
        });
    });
    open
}

#[cfg(test)]
mod tests {
    //! Law: what a visitor must know first stands first, and no key of the kiosk's list is unknown to the help.

    use super::*;

    #[test]
    fn going_stopping_and_help_come_first() {
        assert_eq!(FIRST.map(|(what, _)| what), [Phrase::ToGo, Phrase::ToStop, Phrase::ForHelp]);
        for key in NOT_IN_KIOSK {
            assert!(KEYS.iter().any(|(keys, _)| *keys == key), "{key} is no row of the help");
        }
    }
}
