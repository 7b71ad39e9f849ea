//! Page of the menu on where to ride: scenes, tours, places.

use crate::controls::Controls;
use crate::menu_ride::MenuRide;
use crate::menu_rows::row;
use egui::Ui;
use input::Action;
use words::{Language, Phrase};

/// Scenes of the program by their names on the command line, each with its own name and what there is to see.
const SCENES: [(&str, Phrase, Phrase); 6] = [
    ("town", Phrase::SceneTown, Phrase::SceneTownPurpose),
    ("dice", Phrase::SceneDice, Phrase::SceneDicePurpose),
    ("train", Phrase::SceneTrain, Phrase::SceneTrainPurpose),
    ("laboratory", Phrase::SceneLaboratory, Phrase::SceneLaboratoryPurpose),
    ("lattice", Phrase::SceneLattice, Phrase::SceneLatticePurpose),
    ("spectra", Phrase::SceneSpectra, Phrase::SceneSpectraPurpose),
];

/// Page on where to ride. A ride that is shown again keeps its scene.
pub fn world(ui: &mut Ui, language: Language, state: &MenuRide, actions: &mut Vec<Action>) {
    if !state.is_recorded {
        row(ui, language, Phrase::SceneChoice, |ui| {
            for (name, label, purpose) in SCENES {
                if Controls::new(ui, language).choice(state.scene == name, label, purpose) {
                    actions.push(Action::Scene(name.to_owned()));
                }
            }
        });
        row(ui, language, Phrase::TourChoice, |ui| {
            for (title, name) in &state.tours {
                if Controls::new(ui, language).named_button(title, Phrase::TourPurpose) {
                    actions.push(Action::Tour((*name).to_owned()));
                }
            }
        });
    }
    if !state.places.is_empty() {
        row(ui, language, Phrase::Places, |ui| {
            for (name, place) in &state.places {
                if Controls::new(ui, language).named_button(name, Phrase::PlacePurpose) {
                    actions.push(Action::Jump(*place));
                }
            }
        });
    }
}
