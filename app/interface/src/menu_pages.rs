//! Pages of the menu.

use crate::controls::Controls;
use crate::menu_comfort::comfort;
use crate::menu_drawing::drawing;
use crate::menu_ride::MenuRide;
use crate::menu_rows::row;
use clap::ValueEnum;
use egui::{RichText, ScrollArea, Slider, SliderClamping, Ui};
use hardware::heard::DeviceReport;
use input::{Action, Setting, Switch, TrackingMode, VehicleKind};
use presentation::{Latency, Presentation, colouring};
use render::display::{Exposure, Gamut, Tone, development};
use view::{Colouring, Places};
use words::{Language, Phrase};

/// Largest height of the section on devices, points.
const DEVICES_HEIGHT: f32 = 200.0;

/// Vehicles, with their purposes.
const VEHICLES: [(VehicleKind, Phrase, Phrase); 3] = [
    (VehicleKind::Bicycle, Phrase::Bicycle, Phrase::BicyclePurpose),
    (VehicleKind::Drive, Phrase::Drive, Phrase::DrivePurpose),
    (VehicleKind::Fly, Phrase::Fly, Phrase::FlyPurpose),
];

/// Speeds of light, m/s, with their names.
const LIGHT_SPEEDS: [(f64, &str); 2] = [(30.0 / 3.6, "30 km/h"), (100.0 / 3.6, "100 km/h")];
/// Speed of light of a walker, m/s.
const WALKING_M_S: f64 = 5.0 / 3.6;
/// Speed of light of nature, m/s.
const REAL_M_S: f64 = 299_792_458.0;

/// Orders of a frame's work, with their purposes.
const LATENCIES: [(Latency, Phrase, Phrase); 2] =
    [(Latency::Overlap, Phrase::Smooth, Phrase::SmoothPurpose), (Latency::Low, Phrase::Quick, Phrase::QuickPurpose)];

/// Uses of the tracked head, with their purposes.
const HEADS: [(TrackingMode, Phrase, Phrase); 3] = [
    (TrackingMode::PositionAndVelocity, Phrase::HeadBoth, Phrase::HeadBothPurpose),
    (TrackingMode::Position, Phrase::HeadPlace, Phrase::HeadPlacePurpose),
    (TrackingMode::None, Phrase::HeadOff, Phrase::HeadOffPurpose),
];

/// Buttons of the first page, with their purposes.
const BUTTONS: [(Phrase, Action, Phrase); 5] = [
    (Phrase::Pause, Action::TogglePause, Phrase::PausePurpose),
    (Phrase::Step, Action::Step, Phrase::StepPurpose),
    (Phrase::Restart, Action::Restart, Phrase::RestartPurpose),
    (Phrase::Photo, Action::Photo, Phrase::PhotoPurpose),
    (Phrase::PhotoSphere, Action::PhotoSphere, Phrase::PhotoSpherePurpose),
];

/// Views, with their purposes.
const VIEWS: [(Places, Phrase); 3] = [
    (Places::Seen, Phrase::SeenPurpose),
    (Places::Measured, Phrase::MeasuredPurpose),
    (Places::Instant, Phrase::InstantPurpose),
];

/// Switches of what explains, with their purposes.
const SWITCHES: [(Switch, Phrase, Phrase); 8] = [
    (Switch::Outside, Phrase::Outside, Phrase::OutsidePurpose),
    (Switch::Frozen, Phrase::Freeze, Phrase::FreezePurpose),
    (Switch::Miniature, Phrase::Miniature, Phrase::MiniaturePurpose),
    (Switch::Diagram, Phrase::Diagram, Phrase::DiagramPurpose),
    (Switch::DiagramOfVehicle, Phrase::DiagramOfVehicle, Phrase::DiagramOfVehiclePurpose),
    (Switch::Clocks, Phrase::Clocks, Phrase::ClocksPurpose),
    (Switch::Planner, Phrase::Planner, Phrase::PlannerPurpose),
    (Switch::Readings, Phrase::Readings, Phrase::ReadingsPurpose),
];

/// Page on the ride.
pub fn ride(ui: &mut Ui, presentation: &Presentation, state: &MenuRide, actions: &mut Vec<Action>) {
    let language = presentation.language;
    row(ui, language, Phrase::Vehicle, |ui| {
        for (kind, name, purpose) in VEHICLES {
            if Controls::new(ui, language).choice(state.vehicle == kind, name, purpose) {
                actions.push(Action::Vehicle(kind));
            }
        }
    });
    row(ui, language, Phrase::SpeedOfLight, |ui| {
        let mut kilometres_per_hour = state.speed_of_light * 3.6;
        let slider = Slider::new(&mut kilometres_per_hour, 5.0..=2000.0).logarithmic(true).suffix(" km/h");
        let slider = slider.clamping(SliderClamping::Edits);
        if Controls::new(ui, language).slider(slider, Phrase::SpeedOfLightPurpose) {
            actions.push(Action::SpeedOfLight(kilometres_per_hour / 3.6));
        }
        let named = LIGHT_SPEEDS.map(|(speed, name)| (speed, name.to_owned()));
        let walking = (WALKING_M_S, language.text(Phrase::WalkingPace).to_owned());
        let real = (REAL_M_S, language.text(Phrase::RealLight).to_owned());
        for (speed, name) in [walking].into_iter().chain(named).chain([real]) {
            let chosen = (state.speed_of_light / speed - 1.0).abs() < 1e-6;
            if Controls::new(ui, language).named_choice(chosen, &name, Phrase::SpeedOfLightPurpose) {
                actions.push(Action::SpeedOfLight(speed));
            }
        }
    });
    row(ui, language, Phrase::ClockSpeed, |ui| {
        let mut scale = state.time_scale;
        let slider = Slider::new(&mut scale, 0.05..=4.0).logarithmic(true).clamping(SliderClamping::Edits);
        if Controls::new(ui, language).slider(slider, Phrase::ClockSpeedPurpose) {
            actions.push(Action::TimeScale(scale));
        }
    });
    comfort(ui, presentation, state, actions);
    ui.separator();
    ui.horizontal_wrapped(|ui| {
        for (label, action, purpose) in BUTTONS {
            let chosen = action == Action::TogglePause && state.paused;
            if Controls::new(ui, language).choice(chosen, label, purpose) {
                actions.push(action);
            }
        }
        if Controls::new(ui, language).choice(state.recording, Phrase::Record, Phrase::RecordPurpose) {
            actions.push(Action::ToggleRecording);
        }
    });
}

/// Page on the picture.
pub fn picture(ui: &mut Ui, presentation: &Presentation, state: &MenuRide, actions: &mut Vec<Action>) {
    let language = presentation.language;
    row(ui, language, Phrase::Effects, |ui| {
        for (switch, name, purpose) in [
            (Switch::Doppler, Phrase::Doppler, Phrase::DopplerPurpose),
            (Switch::Searchlight, Phrase::Searchlight, Phrase::SearchlightPurpose),
        ] {
            toggle(ui, presentation, (switch, name, purpose), actions);
        }
    });
    row(ui, language, Phrase::Brightness, |ui| {
        let exposure = presentation.development.exposure;
        let automatic = matches!(exposure, Exposure::Auto(_));
        let mut set = |exposure: Exposure| actions.push(Action::Set(Setting::Exposure, exposure.to_string()));
        if Controls::new(ui, language).choice(automatic, Phrase::Automatic, Phrase::AutomaticPurpose) {
            set(if automatic { Exposure::WHITE } else { Exposure::AUTO });
        }
        let mut stops = exposure.stops();
        let slider = Slider::new(&mut stops, -10.0..=10.0).fixed_decimals(1).clamping(SliderClamping::Edits);
        if Controls::new(ui, language).slider(slider, Phrase::BrightnessPurpose) {
            set(exposure.changed(stops - exposure.stops()));
        }
    });
    row(ui, language, Phrase::ToneCurve, |ui| {
        choices(ui, language, (Setting::Tone, presentation.development.tone), tone_purpose, actions);
    });
    row(ui, language, Phrase::Colours, |ui| {
        choices(ui, language, (Setting::Gamut, presentation.development.gamut), gamut_purpose, actions);
    });
    if state.is_flat {
        row(ui, language, Phrase::FieldOfView, |ui| {
            let mut fov_deg = presentation.fov_deg;
            let slider = Slider::new(&mut fov_deg, 20.0..=140.0).suffix("°").fixed_decimals(0);
            let slider = slider.clamping(SliderClamping::Edits);
            if Controls::new(ui, language).slider(slider, Phrase::FieldOfViewPurpose) {
                actions.push(Action::Set(Setting::Fov, fov_deg.to_string()));
            }
        });
    }
    drawing(ui, language, state, actions);
    if state.overlaps {
        row(ui, language, Phrase::Frames, |ui| {
            for (latency, name, purpose) in LATENCIES {
                if Controls::new(ui, language).choice(presentation.latency == latency, name, purpose) {
                    actions.push(Action::Set(Setting::Latency, development::name(&latency)));
                }
            }
        });
    }
    if let Some(tracking) = state.tracking {
        row(ui, language, Phrase::Head, |ui| {
            for (mode, name, purpose) in HEADS {
                if Controls::new(ui, language).choice(tracking == mode, name, purpose) {
                    actions.push(Action::Tracking(mode));
                }
            }
            if Controls::new(ui, language).button(Phrase::Straighten, Phrase::StraightenPurpose) {
                actions.push(Action::Recentre);
            }
        });
    }
}

/// Page on what explains.
pub fn understand(ui: &mut Ui, presentation: &Presentation, actions: &mut Vec<Action>) {
    let language = presentation.language;
    row(ui, language, Phrase::View, |ui| {
        for (places, purpose) in VIEWS {
            let chosen = presentation.effects.places == places;
            if Controls::new(ui, language).choice(chosen, presentation::view(places), purpose) {
                actions.push(Action::Set(Setting::View, places.name().to_owned()));
            }
        }
    });
    row(ui, language, Phrase::ColouringChoice, |ui| {
        for value in Colouring::ALL {
            let (chosen, name) = (presentation.colouring == value, colouring(value));
            if Controls::new(ui, language).choice(chosen, name, Phrase::ColouringPurpose) {
                actions.push(Action::Set(Setting::Colouring, value.name().to_owned()));
            }
        }
    });
    ui.separator();
    ui.horizontal_wrapped(|ui| {
        for switch in SWITCHES {
            toggle(ui, presentation, switch, actions);
        }
        if Controls::new(ui, language).choice(presentation.help, Phrase::Help, Phrase::HelpPurpose) {
            actions.push(Action::ToggleHelp);
        }
    });
}

/// Page on the program.
pub fn program(ui: &mut Ui, presentation: &Presentation, state: &MenuRide, actions: &mut Vec<Action>) {
    let language = presentation.language;
    row(ui, language, Phrase::LanguageChoice, |ui| {
        for other in Language::ALL {
            let chosen = language == other;
            if Controls::new(ui, language).named_choice(chosen, other.name(), Phrase::LanguagePurpose) {
                actions.push(Action::Set(Setting::Language, other.to_string()));
            }
        }
    });
    ui.separator();
    devices(ui, language, &state.devices);
    ui.separator();
    for line in &state.drawing {
        ui.label(RichText::new(line).small());
    }
    ui.separator();
    if Controls::new(ui, language).button(Phrase::Leave, Phrase::LeavePurpose) {
        actions.push(Action::Leave);
    }
}

/// Section on the devices: a line each, and below it, set in, what it sends and what is wrong.
fn devices(ui: &mut Ui, language: Language, devices: &[DeviceReport]) {
    ui.label(language.text(Phrase::Devices));
    ScrollArea::vertical().max_height(DEVICES_HEIGHT).show(ui, |ui| {
        for (number, device) in devices.iter().enumerate() {
            ui.label(RichText::new(&device.line).small().strong());
            if !device.details.is_empty() {
                ui.indent(number, |ui| {
                    device.details.iter().for_each(|detail| {
                        ui.label(RichText::new(detail).small());
                    });
                });
            }
        }
    });
}

/// Switch of the presentation.
fn toggle(
    ui: &mut Ui,
    presentation: &Presentation,
    (switch, name, purpose): (Switch, Phrase, Phrase),
    actions: &mut Vec<Action>,
) {
    if Controls::new(ui, presentation.language).choice(presentation.is_on(switch), name, purpose) {
        actions.push(Action::Toggle(switch));
    }
}

/// Choices of a setting by their names on the command line.
fn choices<T: ValueEnum + PartialEq>(
    ui: &mut Ui,
    language: Language,
    (setting, chosen): (Setting, T),
    purpose: impl Fn(&T) -> Phrase,
    actions: &mut Vec<Action>,
) {
    for value in T::value_variants() {
        let name = development::name(value);
        if Controls::new(ui, language).named_choice(chosen == *value, &name, purpose(value)) {
            actions.push(Action::Set(setting, name));
        }
    }
}

fn tone_purpose(tone: &Tone) -> Phrase {
    match tone {
        Tone::Reinhard => Phrase::ReinhardPurpose,
        Tone::Linear => Phrase::LinearPurpose,
        Tone::Exponential => Phrase::ExponentialPurpose,
        Tone::Filmic => Phrase::FilmicPurpose,
        Tone::Histogram => Phrase::HistogramPurpose,
    }
}

fn gamut_purpose(gamut: &Gamut) -> Phrase {
    match gamut {
        Gamut::Desaturate => Phrase::DesaturatePurpose,
        Gamut::White => Phrase::WhitePurpose,
        Gamut::Clamp => Phrase::ClampPurpose,
    }
}

#[cfg(test)]
mod tests {
    //! Law: every control of the menu says what it is for. [`Controls`] asks for a phrase; a control that is made past
    //! it would have none.

    #[test]
    fn no_control_is_made_without_its_purpose() {
        for source in [
            include_str!("menu_pages.rs"),
            include_str!("menu.rs"),
            include_str!("menu_world.rs"),
            include_str!("menu_drawing.rs"),
            include_str!("menu_comfort.rs"),
        ] {
            let menu = source.split("#[cfg(test)]").next().expect("a text has a first part");
            let makers = [
                "ui.add(",
                "ui.button(",
                "ui.selectable",
                "ui.toggle",
                "ui.checkbox",
                "ui.radio",
                "ui.drag",
                "ui.menu",
            ];
            for maker in makers {
                assert!(!menu.contains(maker), "{maker}");
            }
        }
    }
}
