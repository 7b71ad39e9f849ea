//! Rows of the menu's pages.

use egui::{Align, Layout, Ui, Vec2};
use words::{Language, Phrase};

/// Distance between two rows, points.
const ROWS: f32 = 4.0;
/// Width of the names at the left, points.
const NAMES_WIDTH: f32 = 140.0;

/// Row of controls with its name at the left.
pub fn row(ui: &mut Ui, language: Language, name: Phrase, contents: impl FnOnce(&mut Ui)) {
    ui.horizontal_top(|ui| {
        let size = Vec2::new(NAMES_WIDTH, ui.spacing().interact_size.y);
        ui.allocate_ui_with_layout(size, Layout::left_to_right(Align::Center), |ui| {
            ui.set_min_width(NAMES_WIDTH);
            ui.label(language.text(name));
        });
        ui.horizontal_wrapped(contents);
    });
    ui.add_space(ROWS);
}
