//! Moving corners in the windows of a room: the keyboard's keys, the file, and what is said of it in the first window.

use super::{Open, Scenery};
use crate::room::{Display, file};
use crate::walls::calibration::{Calibration, Key};
use egui::{Align2, Area, Frame, Grid, Id, RichText, Ui};
use input::{Sample, Source};
use winit::keyboard::KeyCode;

/// Corners that are being moved.
pub struct Calibrating {
    /// Where they are, as long as the ride lasts.
    calibration: Calibration,
    /// Grids are shown, and keys move corners.
    pub active: bool,
    /// What the display was named: a file, or one that comes with the program.
    name: Option<String>,
    /// What came of the last key, where that has to be said.
    said: String,
}

impl Calibrating {
    /// Of a display that was named so, if it was.
    fn new(name: Option<String>, display: &Display) -> Self {
        Self { calibration: Calibration::new(display), active: false, name, said: String::new() }
    }

    /// Does what a key does; returns the channels whose grids change by it.
    fn press(&mut self, code: KeyCode, shift: bool) -> Vec<usize> {
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
    fn save(&mut self) {
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

impl Open {
    /// Whether corners are being moved.
    pub fn calibrates(&self) -> bool {
        self.calibrating.as_ref().is_some_and(|calibrating| calibrating.active)
    }

    /// Begins moving the corners of a room's channels, or goes on with it.
    pub fn calibrate(&mut self) {
        let Scenery::Room(walls) = &mut self.scenery else {
            self.ride.live.tell("corners are moved in the windows of a room: ride --display, without --preview");
            return;
        };
        let begun = || Calibrating::new(self.display_name.clone(), &walls.display);
        let calibrating = self.calibrating.get_or_insert_with(begun);
        calibrating.active = true;
        walls.show_grids(&self.gpu, &calibrating.calibration);
        // The vehicle hears of no key until this is over.
        self.ride.live.say(|at| Sample::closed(at, Source::Keyboard));
    }

    /// What a key that is pressed does meanwhile.
    pub fn calibration_key(&mut self, code: KeyCode, repeated: bool) {
        let (Scenery::Room(walls), Some(calibrating)) = (&mut self.scenery, &mut self.calibrating) else { return };
        match code {
            KeyCode::F4 | KeyCode::Escape if !repeated => {
                walls.show_light(&self.gpu);
                calibrating.active = false;
            }
            KeyCode::F11 if !repeated => self.fill_monitors(),
            KeyCode::KeyS if !repeated => calibrating.save(),
            _ => {
                for channel in calibrating.press(code, self.shift) {
                    walls.show_grid(&self.gpu, &calibrating.calibration, channel);
                }
            }
        }
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

/// Width and height of a window, points, in which the list of keys would hide no corner.
const ROOM_FOR_KEYS: (f32, f32) = (500.0, 400.0);

/// Says which corner is chosen and what the keys do, below the middle, where neither a corner nor the middle is hidden.
pub fn show(ui: &Ui, calibrating: &Calibrating) {
    let window = ui.ctx().content_rect().size();
    let below = 0.25 * window.y;
    let has_room = window.x > ROOM_FOR_KEYS.0 && window.y > ROOM_FOR_KEYS.1;
    Area::new(Id::unique("calibration")).anchor(Align2::CENTER_CENTER, [0.0, below]).interactable(false).show(
        ui.ctx(),
        |ui| {
            Frame::window(ui.style()).show(ui, |ui| {
                ui.set_max_width(470.0_f32.min(window.x - 40.0));
                ui.label(RichText::new(calibrating.calibration.sentence()).heading().strong());
                if !calibrating.said.is_empty() {
                    ui.label(RichText::new(&calibrating.said).strong());
                }
                if !has_room {
                    return;
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
