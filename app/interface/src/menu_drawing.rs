//! Rows of the menu on the way of drawing: the method, and its trade of accuracy for speed.

use crate::controls::Controls;
use crate::menu_ride::MenuRide;
use crate::menu_rows::row;
use egui::Ui;
use input::{Action, Setting};
use view::{Dial, RendererName};
use words::{Language, Phrase};

/// Methods of drawing that a ride can have, with their purposes.
const METHODS: [(RendererName, Phrase); 3] = [
    (RendererName::Auto, Phrase::AutoPurpose),
    (RendererName::Polygon, Phrase::PolygonPurpose),
    (RendererName::Image, Phrase::ImagePurpose),
];

/// Tolerances of the polygon renderer, pixels, from fine to fast.
const TOLERANCES: [f64; 3] = [0.5, 1.5, 4.0];
/// Texels of the image renderer's map for each pixel, from fine to fast.
const MAP_SCALES: [f64; 4] = [3.0, 1.5, 0.9, 0.5];

/// Rows on the way of drawing.
pub fn drawing(ui: &mut Ui, language: Language, state: &MenuRide, actions: &mut Vec<Action>) {
    let mut set = |dial: Dial| actions.push(Action::Set(Setting::Renderer, dial.to_string()));
    row(ui, language, Phrase::Method, |ui| {
        for (renderer, purpose) in METHODS {
            let chosen = state.dial.renderer == renderer;
            if Controls::new(ui, language).named_choice(chosen, renderer.name(), purpose) {
                set(Dial { renderer, ..Dial::default() });
            }
        }
    });
    match state.drawn_by {
        RendererName::Polygon => row(ui, language, Phrase::Tolerance, |ui| {
            for pixels in TOLERANCES {
                let chosen = state.dial.tolerance == Some(pixels);
                let label = format!("{pixels} px");
                if Controls::new(ui, language).named_choice(chosen, &label, Phrase::TolerancePurpose) {
                    set(Dial { renderer: state.dial.renderer, ..Dial::tolerance(pixels) });
                }
            }
        }),
        RendererName::Image => row(ui, language, Phrase::MapScale, |ui| {
            for texels in MAP_SCALES {
                let chosen = state.dial.map_scale == Some(texels);
                let label = texels.to_string();
                if Controls::new(ui, language).named_choice(chosen, &label, Phrase::MapScalePurpose) {
                    set(Dial { renderer: state.dial.renderer, ..Dial::map(texels) });
                }
            }
        }),
        RendererName::Auto | RendererName::Raytrace => {}
    }
}
