//! Corners of a room's channels while they are moved: the keys, the file, and the messages in the first window.

use egui::{Align2, Area, Frame, Grid, Id, RichText, Ui};
use hardware::WINDOW;
use room::{Display, file};
use walls::calibration::{Calibration, CornerKey};
use winit::keyboard::KeyCode;
use words::{Language, Phrase};

/// Corners that are being moved.
pub struct Calibrating {
    /// Places of the corners, kept as long as the ride lasts.
    pub calibration: Calibration,
    /// True while grids are shown and keys move corners.
    pub active: bool,
    /// Name of the display on the command line: a file or a built-in display.
    name: Option<String>,
    /// Message about the last key, if there is one.
    said: String,
}

impl Calibrating {
    /// Creates the calibration of a display. `name` is the display's name on the command line, if one was given.
    pub fn new(name: Option<String>, display: &Display) -> Self {
        Self { calibration: Calibration::new(display), active: false, name, said: String::new() }
    }

    /// Performs a key's action. Returns the channels whose grids it changes.
    pub fn press(&mut self, code: KeyCode, shift: bool, language: Language) -> Vec<usize> {
        let Some(key) = key(code) else { return Vec::new() };
        let before = self.calibration.chosen();
        let moved = self.calibration.press(key, shift);
        let after = self.calibration.chosen();
        self.said.clear();
        match moved {
            Ok(Some(channel)) => vec![channel],
            Ok(None) if before.0 != after.0 => vec![before.0, after.0],
            Ok(None) if before != after => vec![after.0],
            Ok(None) => Vec::new(),
            Err(error) => {
                self.said = cabin::corner_refused(&error, language);
                Vec::new()
            }
        }
    }

    /// Writes the corners that have moved into the display's file.
    pub fn save(&mut self, language: Language) {
        let changed = self.calibration.changed();
        // A display without a name is the built-in window.
        let name = self.name.as_deref().unwrap_or(WINDOW);
        self.said = if changed.is_empty() {
            language.text(Phrase::NothingToSave).to_owned()
        } else {
            match file::save(name, &changed) {
                Ok(path) => {
                    self.calibration.saved();
                    language.fill(Phrase::SavedIn, &[&path.display()])
                }
                Err(error) => language.fill(Phrase::NotSaved, &[&error]),
            }
        };
    }
}

/// Calibration key of a key of the keyboard.
fn key(code: KeyCode) -> Option<CornerKey> {
    Some(match code {
        KeyCode::Tab => CornerKey::Tab,
        KeyCode::ArrowRight => CornerKey::Right,
        KeyCode::ArrowLeft => CornerKey::Left,
        KeyCode::ArrowUp => CornerKey::Up,
        KeyCode::ArrowDown => CornerKey::Down,
        KeyCode::Backspace => CornerKey::Back,
        _ => return None,
    })
}

/// Keys and their meanings while corners are being moved.
const KEYS: [(&str, Phrase); 5] = [
    ("Tab", Phrase::CornerNext),
    ("← → ↑ ↓", Phrase::CornerMove),
    ("Backspace", Phrase::CornerBack),
    ("S", Phrase::CornerSave),
    ("F4", Phrase::CornerLeave),
];

/// Width and height above which a window has room for the list of keys without hiding a corner, points.
const ROOM_FOR_KEYS: (f32, f32) = (500.0, 400.0);

/// Shows the chosen corner and the keys, below the middle, so that neither a corner nor the middle is hidden.
pub fn show(ui: &Ui, calibrating: &Calibrating, language: Language) {
    let window = ui.ctx().content_rect().size();
    let below = 0.25 * window.y;
    let has_room = window.x > ROOM_FOR_KEYS.0 && window.y > ROOM_FOR_KEYS.1;
    Area::new(Id::unique("calibration")).anchor(Align2::CENTER_CENTER, [0.0, below]).interactable(false).show(
        ui.ctx(),
        |ui| {
            Frame::window(ui.style()).show(ui, |ui| {
                ui.set_max_width(470.0_f32.min(window.x - 40.0));
                ui.label(RichText::new(cabin::corner_place(&calibrating.calibration, language)).heading().strong());
                if !calibrating.said.is_empty() {
                    ui.label(RichText::new(&calibrating.said).strong());
                }
                if !has_room {
                    return;
                }
                ui.separator();
                Grid::new("calibration keys").num_columns(2).spacing([16.0, 4.0]).show(ui, |ui| {
                    for (keys, meaning) in KEYS {
                        ui.label(RichText::new(interface::cap(keys, language)).monospace().strong());
                        ui.label(language.text(meaning));
                        ui.end_row();
                    }
                });
            });
        },
    );
}
