//! Controls of the menu. None can be made without a phrase that says what it is for, shown while the pointer rests on
//! it.

use egui::emath::format_with_decimals_in_range;
use egui::{Button, Response, Slider, Ui};
use words::{Language, Phrase};

/// Widest tooltip, points.
const TOOLTIP_WIDTH: f32 = 320.0;

/// Menu that controls are added to, in one language.
pub struct Controls<'a> {
    ui: &'a mut Ui,
    language: Language,
}

impl<'a> Controls<'a> {
    /// Controls in `ui`.
    pub fn new(ui: &'a mut Ui, language: Language) -> Self {
        Self { ui, language }
    }

    /// Button. True if it was pressed.
    pub fn button(&mut self, label: Phrase, purpose: Phrase) -> bool {
        let response = self.ui.add(Button::new(self.language.text(label)));
        self.explained(response, purpose).clicked()
    }

    /// Button whose label is a name. True if it was pressed.
    pub fn named_button(&mut self, label: &str, purpose: Phrase) -> bool {
        let response = self.ui.add(Button::new(label));
        self.explained(response, purpose).clicked()
    }

    /// One of several choices, or a switch, which is `chosen` at present. True if it was pressed.
    pub fn choice(&mut self, chosen: bool, label: Phrase, purpose: Phrase) -> bool {
        self.named_choice(chosen, self.language.text(label), purpose)
    }

    /// One of several choices whose label is a name. True if it was pressed.
    pub fn named_choice(&mut self, chosen: bool, label: &str, purpose: Phrase) -> bool {
        let label = self.language.decimals(label);
        let response = self.ui.add(Button::selectable(chosen, label).frame_when_inactive(true));
        self.explained(response, purpose).clicked()
    }

    /// Slider, with its number as it is written in this language. True if it was moved.
    pub fn slider(&mut self, slider: Slider<'_>, purpose: Phrase) -> bool {
        let language = self.language;
        let written = move |number: f64, decimals| language.decimals(&format_with_decimals_in_range(number, decimals));
        let slider = slider.custom_formatter(written).custom_parser(move |text| language.number(text));
        let response = self.ui.add(slider);
        self.explained(response, purpose).changed()
    }

    /// Response with its purpose as a tooltip.
    fn explained(&self, response: Response, purpose: Phrase) -> Response {
        response.on_hover_ui(|ui| {
            ui.set_max_width(TOOLTIP_WIDTH);
            ui.label(self.language.text(purpose));
        })
    }
}
