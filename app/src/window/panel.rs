//! Settings panel and help window.

use crate::command::Latency;
use crate::frame::Look;
use clap::ValueEnum;
use egui::{Align2, Grid, RichText, Slider, Ui, Window};
use input::{Action, VehicleKind};
use render::display::{Development, Exposure, development};

/// Settings that the panel changes by itself: how the picture is drawn, which no recording depends on.
#[derive(Clone, Debug)]
pub struct Settings {
    /// True if the panel is open.
    pub open: bool,
    /// True if the help is open.
    pub help: bool,
    /// True if the head-up display is shown.
    pub readings: bool,
    /// Settings of the picture.
    pub look: Look,
}

/// State of the ride that the panel shows.
#[derive(Clone, Debug)]
pub struct PanelRide {
    /// Kind of vehicle that is ridden.
    pub vehicle: VehicleKind,
    /// Ratio of proper time to real time.
    pub time_scale: f64,
    /// Speed of light, m/s.
    pub speed_of_light: f64,
    /// Sentences on the state of the devices, one each.
    pub devices: Vec<String>,
    /// Sentence about the renderer and the amount that it draws.
    pub drawing: String,
}

/// Shows the panel. Changes of the ride are returned as actions, so that they are recorded like keys.
pub fn show(ui: &mut Ui, settings: &mut Settings, ride: &PanelRide) -> Vec<Action> {
    let mut actions = Vec::new();
    if settings.help {
        help(ui, &mut settings.help);
    }
    let mut open = settings.open;
    Window::new("Settings").open(&mut open).anchor(Align2::RIGHT_TOP, [-12.0, 40.0]).resizable(false).show(
        ui.ctx(),
        |ui| {
            Grid::new("settings").num_columns(2).spacing([16.0, 8.0]).show(ui, |ui| {
                ui.label("Vehicle");
                ui.horizontal(|ui| {
                    for (kind, name) in
                        [(VehicleKind::Bicycle, "bicycle"), (VehicleKind::Drive, "drive"), (VehicleKind::Fly, "fly")]
                    {
                        if ui.selectable_label(ride.vehicle == kind, name).clicked() {
                            actions.push(Action::Vehicle(kind));
                        }
                    }
                });
                ui.end_row();

                ui.label("Speed of light");
                let mut kilometres_per_hour = ride.speed_of_light * 3.6;
                let slider = Slider::new(&mut kilometres_per_hour, 5.0..=2000.0).logarithmic(true).suffix(" km/h");
                if ui.add(slider).changed() {
                    actions.push(Action::SpeedOfLight(kilometres_per_hour / 3.6));
                }
                ui.end_row();

                ui.label("Speed of your clock");
                let mut scale = ride.time_scale;
                if ui.add(Slider::new(&mut scale, 0.05..=4.0).logarithmic(true)).changed() {
                    actions.push(Action::TimeScale(scale));
                }
                ui.end_row();

                ui.label("Effects");
                ui.horizontal(|ui| {
                    let effects = &mut settings.look.effects;
                    ui.toggle_value(&mut effects.geometry, "geometry");
                    ui.toggle_value(&mut effects.doppler, "Doppler");
                    ui.toggle_value(&mut effects.searchlight, "searchlight");
                });
                ui.end_row();

                light(ui, &mut settings.look.development);

                ui.label("Field of view");
                let range = Slider::new(&mut settings.look.fov_deg, 20.0..=140.0).suffix("°");
                ui.add(range.clamping(egui::SliderClamping::Edits));
                ui.end_row();

                ui.label("Frames");
                ui.horizontal(|ui| {
                    ui.selectable_value(&mut settings.look.latency, Latency::Overlap, "smooth");
                    ui.selectable_value(&mut settings.look.latency, Latency::Low, "quick to answer");
                });
                ui.end_row();
            });
            ui.separator();
            ui.horizontal(|ui| {
                for (label, action) in [
                    ("Pause", Action::TogglePause),
                    ("Step", Action::Step),
                    ("To the start", Action::Restart),
                    ("Photo", Action::Photo),
                    ("Record", Action::ToggleRecording),
                ] {
                    if ui.button(label).clicked() {
                        actions.push(action);
                    }
                }
            });
            ui.separator();
            for line in ride.devices.iter().chain([&ride.drawing]) {
                ui.label(RichText::new(line).small());
            }
        },
    );
    settings.open = open;
    actions
}

/// Rows for the development of radiance into the picture.
fn light(ui: &mut Ui, development: &mut Development) {
    ui.label("Exposure");
    ui.horizontal(|ui| {
        let exposure = &mut development.exposure;
        if ui.selectable_label(matches!(exposure, Exposure::Auto(_)), "auto").clicked() {
            *exposure = Exposure::AUTO;
        }
        if ui.selectable_label(matches!(exposure, Exposure::Stops(_)), "white").clicked() {
            *exposure = Exposure::WHITE;
        }
        let mut stops = exposure.stops();
        let slider = Slider::new(&mut stops, -10.0..=10.0).fixed_decimals(1).clamping(egui::SliderClamping::Edits);
        if ui.add(slider).changed() {
            *exposure = exposure.changed(stops - exposure.stops());
        }
    });
    ui.end_row();

    ui.label("Tone");
    choice(ui, &mut development.tone);
    ui.label("Gamut");
    choice(ui, &mut development.gamut);
}

/// Row for choosing one of several values.
fn choice<T: ValueEnum + PartialEq>(ui: &mut Ui, chosen: &mut T) {
    ui.horizontal(|ui| {
        for value in T::value_variants() {
            ui.selectable_value(chosen, value.clone(), development::name(value));
        }
    });
    ui.end_row();
}

/// Keys and their meanings; the same list as in the README.
const KEYS: [(&str, &str); 25] = [
    ("W S  ↑ ↓", "pedal, push back; thrust forward, back; the arrows lower and raise the nose when flying"),
    ("A D  ← →", "steer; thrust sideways; the arrows turn the nose"),
    ("R F", "thrust up, down when flying"),
    ("Q E", "roll"),
    ("Shift", "sprint"),
    ("Space", "brake"),
    ("J L I K", "look left, right, up, down, as a drag of the mouse does; rooms and tracked heads look by themselves"),
    ("O", "look ahead again, as the middle button does"),
    ("M", "look back, as long as it is held"),
    ("1 2 3", "bicycle, drive, fly"),
    ("P", "pause"),
    (".", "one step while paused"),
    ("− =", "your clock slower, faster"),
    ("G B N", "geometry, Doppler shift, searchlight effect: on, off"),
    ("T", "next tone curve"),
    ("[ ]", "darker, brighter"),
    ("C", "photo"),
    ("V", "record the whole ride, from its beginning"),
    ("Backspace", "back to the start"),
    ("F1 H", "this help"),
    ("F2", "show or hide the readings"),
    ("F3", "settings"),
    ("F4", "move the corners of a room's pictures"),
    ("F11", "full screen"),
    ("Esc", "leave"),
];

fn help(ui: &Ui, open: &mut bool) {
    Window::new("Keys").open(open).anchor(Align2::CENTER_CENTER, [0.0, -20.0]).resizable(false).show(ui.ctx(), |ui| {
        Grid::new("keys").num_columns(2).spacing([24.0, 5.0]).show(ui, |ui| {
            for (keys, meaning) in KEYS {
                ui.label(RichText::new(keys).monospace().strong());
                ui.label(meaning);
                ui.end_row();
            }
        });
    });
}
