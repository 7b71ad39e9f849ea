//! Controls of the settings panel. None can be made without a sentence that says what it is for, shown while the
//! mouse rests on it.

use egui::{Button, Response, Slider, Ui};

/// Widest tooltip, points.
const TOOLTIP_WIDTH: f32 = 320.0;

/// Panel that controls are added to.
pub struct Controls<'a> {
    ui: &'a mut Ui,
}

impl<'a> Controls<'a> {
    /// Controls in `ui`.
    pub fn new(ui: &'a mut Ui) -> Self {
        Self { ui }
    }

    /// Button. True if it was pressed.
    pub fn button(&mut self, label: &str, purpose: &str) -> bool {
        let response = self.ui.add(Button::new(label));
        explained(response, purpose).clicked()
    }

    /// One of several choices, which is `chosen` at present. True if it was pressed.
    pub fn choice(&mut self, chosen: bool, label: &str, purpose: &str) -> bool {
        let response = self.ui.selectable_label(chosen, label);
        explained(response, purpose).clicked()
    }

    /// Switch.
    pub fn switch(&mut self, on: &mut bool, label: &str, purpose: &str) {
        let response = self.ui.toggle_value(on, label);
        explained(response, purpose);
    }

    /// Slider. True if it was moved.
    pub fn slider(&mut self, slider: Slider<'_>, purpose: &str) -> bool {
        let response = self.ui.add(slider);
        explained(response, purpose).changed()
    }
}

/// Response with its purpose as a tooltip.
fn explained(response: Response, purpose: &str) -> Response {
    response.on_hover_ui(|ui| {
        ui.set_max_width(TOOLTIP_WIDTH);
        ui.label(purpose);
    })
}
