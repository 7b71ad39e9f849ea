//! Rows of the menu on comfort in a headset or a room.

use crate::controls::Controls;
use crate::menu_ride::MenuRide;
use crate::menu_rows::row;
use clap::ValueEnum;
use egui::Ui;
use input::head::Stance;
use input::{Action, Setting, Switch};
use presentation::{Presentation, Vignette, vignette};
use render::display::development;
use words::Phrase;

/// Steps of turns, degrees.
const STEPS_DEG: [f64; 4] = [15.0, 30.0, 45.0, 90.0];

/// Stances, with their purposes.
const STANCES: [(Stance, Phrase, Phrase); 2] = [
    (Stance::Seated, Phrase::Seated, Phrase::SeatedPurpose),
    (Stance::Standing, Phrase::Standing, Phrase::StandingPurpose),
];

/// Rows on comfort: those of a headset, and the vehicle's lines in rooms as well.
pub fn comfort(ui: &mut Ui, presentation: &Presentation, state: &MenuRide, actions: &mut Vec<Action>) {
    let language = presentation.language;
    if state.has_lines {
        row(ui, language, Phrase::Cockpit, |ui| {
            if Controls::new(ui, language).choice(presentation.cockpit, Phrase::CockpitShown, Phrase::CockpitPurpose) {
                actions.push(Action::Toggle(Switch::Cockpit));
            }
        });
    }
    let Some(of_rider) = state.comfort else { return };
    row(ui, language, Phrase::VignetteChoice, |ui| {
        for value in Vignette::value_variants() {
            let chosen = presentation.vignette == *value;
            if Controls::new(ui, language).choice(chosen, vignette(*value), Phrase::VignettePurpose) {
                actions.push(Action::Set(Setting::Vignette, development::name(value)));
            }
        }
    });
    row(ui, language, Phrase::SnapTurn, |ui| {
        let none = of_rider.snap_turn_deg == 0.0;
        if Controls::new(ui, language).choice(none, Phrase::SnapTurnOff, Phrase::SnapTurnPurpose) {
            actions.push(Action::SnapTurn(0.0));
        }
        for degrees in STEPS_DEG {
            let chosen = of_rider.snap_turn_deg == degrees;
            if Controls::new(ui, language).named_choice(chosen, &format!("{degrees}°"), Phrase::SnapTurnPurpose) {
                actions.push(Action::SnapTurn(degrees));
            }
        }
    });
    row(ui, language, Phrase::StanceChoice, |ui| {
        for (stance, name, purpose) in STANCES {
            if Controls::new(ui, language).choice(of_rider.stance == stance, name, purpose) {
                actions.push(Action::Stance(stance));
            }
        }
    });
}
