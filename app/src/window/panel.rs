//! Settings panel. Each control is made by [`Controls`], which asks for its purpose.

use super::controls::Controls;
use super::help;
use crate::command::Latency;
use crate::frame::Look;
use clap::ValueEnum;
use egui::{Align2, Grid, RichText, ScrollArea, Slider, Ui, Window};
use hardware::heard::DeviceReport;
use input::{Action, VehicleKind};
use render::display::{Development, Exposure, Gamut, Tone, development};
use view::Places;

/// Settings that the panel changes by itself: how the picture is drawn, which no recording depends on.
#[derive(Clone, Debug)]
pub struct Settings {
    /// True if the panel is open.
    pub open: bool,
    /// True if the help is open.
    pub help: bool,
    /// True in a kiosk, which has no settings.
    pub kiosk: bool,
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
    /// Reports on the devices.
    pub devices: Vec<DeviceReport>,
    /// Sentence about the renderer and the amount that it draws.
    pub drawing: String,
    /// True if frames may overlap, so that their order can be chosen.
    pub overlaps: bool,
    /// Sentence on how well several windows keep step.
    pub in_step: Option<String>,
}

/// Largest height of the section on devices, points.
const DEVICES_HEIGHT: f32 = 160.0;

/// Purpose of each view of places, in the order of [`Places::ALL`].
const PURPOSES_OF_PLACES: [&str; 3] = [
    "Bends and moves everything to where its light comes from.",
    "Everything where it is now for you: contracted along your motion. No light brings this, so none is shifted.",
    "Everything where it is now in the world, as if light were infinitely fast.",
];

/// Vehicles, with their purposes.
const VEHICLES: [(VehicleKind, &str, &str); 3] = [
    (VehicleKind::Bicycle, "bicycle", "Pedal along the street, and steer with the handlebar."),
    (VehicleKind::Drive, "drive", "Glide over the ground in any direction."),
    (VehicleKind::Fly, "fly", "Fly freely, up and down as well."),
];

/// Orders of a frame's work, with their purposes.
const LATENCIES: [(Latency, &str, &str); 2] = [
    (Latency::Overlap, "smooth", "More pictures a second. Each is shown one picture later."),
    (Latency::Low, "quick to answer", "Each picture shows your newest movement. There are fewer of them."),
];

/// Buttons, with their purposes.
const BUTTONS: [(&str, Action, &str); 6] = [
    ("Pause", Action::TogglePause, "Stops the world, or lets it go on."),
    ("Step", Action::Step, "Moves the world on by one small step while it is paused."),
    ("To the start", Action::Restart, "Takes you back to where the ride began."),
    ("Straighten", Action::Recentre, "Makes where your tracked head is and looks now the middle. U does the same."),
    ("Photo", Action::Photo, "Saves the picture as a file, photo-001.png and so on."),
    ("Record", Action::ToggleRecording, "Saves the whole ride as a file, ride-001.mcap and so on, or ends the file."),
];

/// Shows the panel. Changes of the ride are returned as actions, so that they are recorded like keys.
pub fn show(ui: &mut Ui, settings: &mut Settings, ride: &PanelRide) -> Vec<Action> {
    let mut actions = Vec::new();
    if settings.help {
        help::show(ui, &mut settings.help, settings.kiosk);
    }
    let mut open = settings.open;
    Window::new("Settings").open(&mut open).anchor(Align2::RIGHT_TOP, [-12.0, 40.0]).resizable(false).show(
        ui.ctx(),
        |ui| {
            Grid::new("settings").num_columns(2).spacing([16.0, 8.0]).show(ui, |ui| {
                ui.label("Vehicle");
                ui.horizontal(|ui| {
                    for (kind, name, purpose) in VEHICLES {
                        if Controls::new(ui).choice(ride.vehicle == kind, name, purpose) {
                            actions.push(Action::Vehicle(kind));
                        }
                    }
                });
                ui.end_row();

                ui.label("Speed of light");
                let mut kilometres_per_hour = ride.speed_of_light * 3.6;
                let slider = Slider::new(&mut kilometres_per_hour, 5.0..=2000.0).logarithmic(true).suffix(" km/h");
                let purpose = "How fast light is in this world. The slower it is, the sooner you see relativity.";
                if Controls::new(ui).slider(slider, purpose) {
                    actions.push(Action::SpeedOfLight(kilometres_per_hour / 3.6));
                }
                ui.end_row();

                ui.label("Speed of your clock");
                let mut scale = ride.time_scale;
                let slider = Slider::new(&mut scale, 0.05..=4.0).logarithmic(true);
                let purpose =
                    "How much of your own time passes in a second. Below 1 you see everything in slow motion.";
                if Controls::new(ui).slider(slider, purpose) {
                    actions.push(Action::TimeScale(scale));
                }
                ui.end_row();

                ui.label("Effects");
                ui.horizontal(|ui| {
                    let effects = &mut settings.look.effects;
                    let mut controls = Controls::new(ui);
                    for (places, purpose) in Places::ALL.into_iter().zip(PURPOSES_OF_PLACES) {
                        if controls.choice(effects.places == places, places.name(), purpose) {
                            effects.places = places;
                        }
                    }
                    controls.switch(
                        &mut effects.doppler,
                        "Doppler",
                        "Shifts colours: bluer ahead, redder behind. Off: colours as at rest.",
                    );
                    controls.switch(
                        &mut effects.searchlight,
                        "searchlight",
                        "Makes it brighter ahead and darker behind. Off: brightness as at rest.",
                    );
                });
                ui.end_row();

                light(ui, &mut settings.look.development);

                ui.label("Field of view");
                let range = Slider::new(&mut settings.look.fov_deg, 20.0..=140.0).suffix("°");
                let purpose = "How much you see from the lower to the upper edge. Small is like a telescope.";
                Controls::new(ui).slider(range.clamping(egui::SliderClamping::Edits), purpose);
                ui.end_row();

                if ride.overlaps {
                    ui.label("Frames");
                    ui.horizontal(|ui| {
                        for (latency, name, purpose) in LATENCIES {
                            if Controls::new(ui).choice(settings.look.latency == latency, name, purpose) {
                                settings.look.latency = latency;
                            }
                        }
                    });
                    ui.end_row();
                }
            });
            ui.separator();
            ui.horizontal(|ui| {
                for (label, action, purpose) in BUTTONS {
                    if Controls::new(ui).button(label, purpose) {
                        actions.push(action);
                    }
                }
            });
            ui.separator();
            devices(ui, &ride.devices);
            ui.separator();
            for line in [&ride.drawing].into_iter().chain(&ride.in_step) {
                ui.label(RichText::new(line).small());
            }
        },
    );
    settings.open = open;
    actions
}

/// Section on the devices: a line each, and below it, set in, what it sends and what is wrong.
fn devices(ui: &mut Ui, devices: &[DeviceReport]) {
    ui.label("Devices");
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

/// Rows for the development of radiance into the picture.
fn light(ui: &mut Ui, development: &mut Development) {
    ui.label("Exposure");
    ui.horizontal(|ui| {
        let exposure = &mut development.exposure;
        let mut controls = Controls::new(ui);
        let purpose = "Adapts to the brightness, as an eye does.";
        if controls.choice(matches!(exposure, Exposure::Auto(_)), "auto", purpose) {
            *exposure = Exposure::AUTO;
        }
        let purpose = "Stays as it is: what is white at rest is shown white.";
        if controls.choice(matches!(exposure, Exposure::Stops(_)), "white", purpose) {
            *exposure = Exposure::WHITE;
        }
        let mut stops = exposure.stops();
        let slider = Slider::new(&mut stops, -10.0..=10.0).fixed_decimals(1).clamping(egui::SliderClamping::Edits);
        let purpose = "Makes the picture brighter or darker. One more is twice as bright.";
        if controls.slider(slider, purpose) {
            *exposure = exposure.changed(stops - exposure.stops());
        }
    });
    ui.end_row();

    ui.label("Tone");
    choice(ui, &mut development.tone, |tone| match tone {
        Tone::Reinhard => "Keeps detail in what is bright, and leaves the rest as it is.",
        Tone::Linear => "Shows brightness as it is. What is brighter than white is white.",
        Tone::Exponential => "Bright places fade into white, as on photographic film.",
        Tone::Filmic => "More contrast, with dark shadows, as in the cinema.",
        Tone::Histogram => "Shares the screen's brightness out, so that dark and bright places both show detail.",
    });
    ui.label("Gamut");
    choice(ui, &mut development.gamut, |gamut| match gamut {
        Gamut::Desaturate => "Colours that the screen cannot show become paler.",
        Gamut::White => "Colours that the screen cannot show are mixed with white, and then darkened.",
        Gamut::Clamp => "Colours that the screen cannot show are cut off. Their hue may change.",
    });
}

/// Row for choosing one of several values.
fn choice<T: ValueEnum + PartialEq>(ui: &mut Ui, chosen: &mut T, purpose: impl Fn(&T) -> &'static str) {
    ui.horizontal(|ui| {
        for value in T::value_variants() {
            if Controls::new(ui).choice(chosen == value, &development::name(value), purpose(value)) {
                *chosen = value.clone();
            }
        }
    });
    ui.end_row();
}

#[cfg(test)]
mod tests {
    //! Law: every control of the panel says what it is for. [`Controls`] asks for a sentence; a control that is made
    //! past it would have none.

    use super::*;

    #[test]
    fn no_control_is_made_without_its_purpose() {
        let source = include_str!("panel.rs");
        let panel = source.split("#[cfg(test)]").next().expect("a text has a first part");
        let makers = [
            "ui.add(Button",
            "ui.add(Slider",
            "ui.button(",
            "ui.selectable",
            "ui.toggle",
            "ui.checkbox",
            "ui.radio",
            "ui.link",
        ];
        for maker in makers {
            assert!(!panel.contains(maker), "{maker} makes a control without a tooltip");
        }
        assert!(panel.matches("Controls::new(ui)").count() >= 8);
    }

    #[test]
    fn the_mouse_on_a_button_shows_its_purpose() {
        let context = egui::Context::default();
        context.all_styles_mut(|style| style.interaction.tooltip_delay = 0.0);
        let shown = |at: Option<egui::Pos2>, seconds: f64| {
            let input = egui::RawInput {
                screen_rect: Some(egui::Rect::from_min_size(egui::Pos2::ZERO, egui::vec2(400.0, 300.0))),
                time: Some(seconds),
                events: at.map(egui::Event::PointerMoved).into_iter().collect(),
                ..Default::default()
            };
            let mut place = egui::Pos2::ZERO;
            let output = context.run_ui(input, |ui| {
                let [label, purpose] = ["press", "It says what it is for."];
                Controls::new(ui).button(label, purpose);
                place = ui.min_rect().center();
            });
            (format!("{:?}", output.shapes).contains("It says what it is for"), place)
        };
        let mut place = egui::Pos2::ZERO;
        let mut seen = false;
        for frame in 0..40 {
            let (now, at) = shown((frame == 2).then_some(place), 0.1 * f64::from(frame));
            (seen, place) = (seen || now, at);
        }
        assert!(seen, "no tooltip at {place:?}");
    }
}
