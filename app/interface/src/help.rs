//! Help: how to go, how to stop and how to get help, then every key.

use egui::{Align2, Frame, Grid, RichText, ScrollArea, Ui, Vec2, Window};
use words::{Language, Phrase};

/// What a first-time rider must know.
const FIRST: [(Phrase, Phrase); 3] =
    [(Phrase::ToGo, Phrase::ToGoHow), (Phrase::ToStop, Phrase::ToStopHow), (Phrase::ForHelp, Phrase::ForHelpHow)];

/// Height that the display's readings and the window's frame need, points.
const SURROUNDINGS: f32 = 210.0;

/// Width of a screen on which the keys stand in two columns, and of a column, points.
const WIDE: f32 = 1150.0;
const COLUMN: f32 = 540.0;

/// Margins of a sheet's frame, left and right or above and below, points.
const SHEET_MARGIN: f32 = 14.0;

/// Keys and their meanings; the same list as in the README.
const KEYS: [(&str, Phrase); 32] = [
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
    ("Enter", Phrase::KeyChoose),
    ("F4", Phrase::KeyCalibrate),
    ("U", Phrase::KeyStraight),
    ("F7", Phrase::KeyHead),
    ("F11", Phrase::KeyFullScreen),
    ("Esc", Phrase::KeyLeave),
];

/// Name of a key as it is written on the keyboards of this language. Keys are known by their place.
pub fn cap(key: &'static str, language: Language) -> &'static str {
    match (key, language) {
        ("Shift", _) => language.text(Phrase::ShiftKey),
        ("Space", _) => language.text(Phrase::SpaceKey),
        ("Backspace", _) => language.text(Phrase::BackspaceKey),
        ("Enter", _) => language.text(Phrase::EnterKey),
        ("Y  F5  F9", Language::German) => "Z  F5  F9",
        ("Z  F6", Language::German) => "Y  F6",
        ("− =", Language::German) => "ß ´",
        ("[ ]", Language::German) => "Ü +",
        (key, _) => key,
    }
}

/// Keys that do nothing in a kiosk.
const NOT_IN_KIOSK: [&str; 6] = ["C  F8", "V", "F3", "F4", "F11", "Esc"];

/// Rows of keys and their meanings.
fn rows(kiosk: bool) -> Vec<(&'static str, Phrase)> {
    KEYS.into_iter().filter(|(keys, _)| !kiosk || !NOT_IN_KIOSK.contains(keys)).collect()
}

/// What must be known first.
fn first(ui: &mut Ui, language: Language) {
    let bright = ui.visuals().strong_text_color();
    Grid::new("first").num_columns(2).spacing([24.0, 7.0]).show(ui, |ui| {
        for (what, how) in FIRST {
            ui.label(RichText::new(language.text(what)).size(17.0).strong());
            ui.label(RichText::new(language.text(how)).size(17.0).color(bright));
            ui.end_row();
        }
    });
    ui.separator();
}

/// Grid of keys in so many columns.
fn keys(ui: &mut Ui, language: Language, rows: &[(&'static str, Phrase)], columns: usize) {
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
}

/// Shows the help on a sheet of its own, which it fills.
pub fn sheet(ui: &mut Ui, language: Language, kiosk: bool) {
    let whole = ui.max_rect();
    Frame::window(ui.style()).show(ui, |ui| {
        ui.set_min_size(whole.size() - Vec2::splat(SHEET_MARGIN));
        first(ui, language);
        keys(ui, language, &rows(kiosk), 1);
    });
}

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
        let columns = if screen.width() >= WIDE { 2 } else { 1 };
        ui.set_max_width((screen.width() - 80.0).min(COLUMN * columns as f32));
        first(ui, language);
        let height = (screen.height() - SURROUNDINGS).max(60.0);
        ScrollArea::vertical().max_height(height).min_scrolled_height(height).show(ui, |ui| {
            keys(ui, language, &rows(kiosk), columns);
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
