//! Moving corners in the windows of a room: the keyboard's keys, the file, and what is said of it in the first window.

use crate::room::{Display, file};
use crate::walls::calibration::{Calibration, Key};
use egui::{Align2, Area, Frame, Grid, Id, RichText, Ui};
use winit::keyboard::KeyCode;

/// Corners that are being moved.
pub struct Calibrating {
    /// Where they are.
    pub calibration: Calibration,
    /// What the display was named: a file, or one that comes with the program.
    name: Option<String>,
    /// What came of the last key, where that has to be said.
    said: String,
}

impl Calibrating {
    /// Of a display that was named so, if it was.
    pub fn new(name: Option<String>, display: &Display) -> Self {
        Self { calibration: Calibration::new(display), name, said: String::new() }
    }

    /// Does what a key does; returns the channels whose grids change by it.
    pub fn press(&mut self, code: KeyCode, shift: bool) -> Vec<usize> {
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
                self.said = error.to_string();
                Vec::new()
            }
        }
    }

    /// Writes what has moved into the display's file.
    pub fn save(&mut self) {
        let changed = self.calibration.changed();
        // A display that nobody has named is the built-in window.
        let name = self.name.as_deref().unwrap_or(crate::ride::WINDOW);
        self.said = if changed.is_empty() {
            "nothing has moved since the file was read".to_owned()
        } else {
            match file::save(name, &changed) {
                Ok(path) => {
                    self.calibration.saved();
                    format!("saved in {}", path.display())
                }
                Err(error) => error.to_string(),
            }
        };
    }
}

/// What a key of the keyboard does.
fn key(code: KeyCode) -> Option<Key> {
    Some(match code {
        KeyCode::Tab => Key::Tab,
        KeyCode::ArrowRight => Key::Right,
        KeyCode::ArrowLeft => Key::Left,
        KeyCode::ArrowUp => Key::Up,
        KeyCode::ArrowDown => Key::Down,
        KeyCode::Backspace => Key::Back,
        _ => return None,
    })
}

/// What the keys do meanwhile.
const KEYS: [(&str, &str); 5] = [
    ("Tab", "next corner, next channel; with Shift back"),
    ("← → ↑ ↓", "move it by a pixel, with Shift by ten"),
    ("Backspace", "back to where the file has it; with Shift to the viewport's corner"),
    ("S", "save"),
    ("F4", "leave"),
];

/// Says which corner is chosen and what the keys do, in the middle, where no corner is.
pub fn show(ui: &Ui, calibrating: &Calibrating) {
    Area::new(Id::unique("calibration")).anchor(Align2::CENTER_CENTER, [0.0, 0.0]).interactable(false).show(
        ui.ctx(),
        |ui| {
            Frame::window(ui.style()).show(ui, |ui| {
                ui.set_max_width(420.0);
                ui.label(RichText::new(calibrating.calibration.sentence()).heading());
                if !calibrating.said.is_empty() {
                    ui.label(RichText::new(&calibrating.said).strong());
                }
                ui.separator();
                Grid::new("calibration keys").num_columns(2).spacing([16.0, 4.0]).show(ui, |ui| {
                    for (keys, meaning) in KEYS {
                        ui.label(RichText::new(keys).monospace().strong());
                        ui.label(meaning);
                        ui.end_row();
                    }
                });
            });
        },
    );
}
