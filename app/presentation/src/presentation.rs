//! State of what is shown, and its change by actions.

use crate::latency::Latency;
use crate::vignette::Vignette;
use input::{Action, Setting, Switch};
use render::display::{Development, development};
use view::{Colouring, Dial, Effects, Places};
use words::{Language, Phrase};

/// State of all that decides how a ride is shown, and nothing of how it goes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Presentation {
    /// Effects of relativity on the picture.
    pub effects: Effects,
    /// Vertical field of view of a flat picture, degrees.
    pub fov_deg: f64,
    /// Development of radiance into the picture.
    pub development: Development,
    /// Division of a frame's time between transforming and drawing.
    pub latency: Latency,
    /// Way of drawing; `None` for the one that the ride began with.
    pub dial: Option<Dial>,
    /// Language of the interface.
    pub language: Language,
    /// True if the view is from outside.
    pub outside: bool,
    /// Value that the colours of the view from outside show.
    pub colouring: Colouring,
    /// True if the view from outside shows what was seen at the moment of the switch.
    pub frozen: bool,
    /// True if the head-up display is shown.
    pub readings: bool,
    /// True if the menu is open.
    pub menu: bool,
    /// True if the help is open.
    pub help: bool,
    /// True if the plan of the world is shown.
    pub miniature: bool,
    /// True if the Minkowski diagram is shown.
    pub diagram: bool,
    /// True if the diagram is drawn in the vehicle's frame.
    pub diagram_of_vehicle: bool,
    /// True if the readings of the scene's clocks are shown.
    pub clocks: bool,
    /// True if the planner is shown.
    pub planner: bool,
    /// Darkening of the edges of a headset's pictures.
    pub vignette: Vignette,
    /// True if lines of the vehicle are shown about the rider, in a headset or a room.
    pub cockpit: bool,
}

impl Default for Presentation {
    fn default() -> Self {
        Self {
            effects: Effects::ALL,
            fov_deg: 60.0,
            development: Development::default(),
            latency: Latency::default(),
            dial: None,
            language: Language::default(),
            outside: false,
            colouring: Colouring::default(),
            frozen: false,
            readings: true,
            menu: false,
            help: false,
            miniature: false,
            diagram: false,
            diagram_of_vehicle: false,
            clocks: false,
            planner: false,
            vignette: Vignette::default(),
            cockpit: false,
        }
    }
}

impl Presentation {
    /// The same in another language.
    #[must_use]
    pub fn in_language(self, language: Language) -> Self {
        Self { language, ..self }
    }

    /// True if this switch is on.
    pub fn is_on(mut self, switch: Switch) -> bool {
        let bends = self.effects.bend();
        self.switch(switch).map_or(bends, |on| *on)
    }

    /// State of a switch; `None` for that of the geometry, which is one of three views.
    fn switch(&mut self, switch: Switch) -> Option<&mut bool> {
        let on = match switch {
            Switch::Geometry => return None,
            Switch::Doppler => &mut self.effects.doppler,
            Switch::Searchlight => &mut self.effects.searchlight,
            Switch::Outside => &mut self.outside,
            Switch::Frozen => &mut self.frozen,
            Switch::Readings => &mut self.readings,
            Switch::Menu => &mut self.menu,
            Switch::Miniature => &mut self.miniature,
            Switch::Diagram => &mut self.diagram,
            Switch::DiagramOfVehicle => &mut self.diagram_of_vehicle,
            Switch::Clocks => &mut self.clocks,
            Switch::Planner => &mut self.planner,
            Switch::Cockpit => &mut self.cockpit,
        };
        Some(on)
    }

    /// Carries out an action, if it is one of these. Returns a sentence for the rider where the picture alone would not
    /// say what has happened.
    pub fn act(&mut self, action: &Action) -> Option<String> {
        match action {
            Action::Toggle(switch) => self.turn(*switch, !self.is_on(*switch)),
            Action::Turn(switch, on) => self.turn(*switch, *on),
            Action::ToggleHelp => {
                self.help = !self.help;
                None
            }
            Action::NextView => self.next(Setting::View),
            Action::Expose(stops) => {
                self.development.exposure = self.development.exposure.changed(*stops as f32);
                Some(self.language.fill(Phrase::ExposureIs, &[&self.development.exposure]))
            }
            Action::Next(setting) => self.next(*setting),
            Action::Set(setting, text) => match self.set(*setting, text) {
                Some(()) => None,
                None => Some(self.language.fill(Phrase::NotUnderstood, &[text])),
            },
            _ => None,
        }
    }

    /// Turns a switch on or off.
    fn turn(&mut self, switch: Switch, on: bool) -> Option<String> {
        match self.switch(switch) {
            Some(state) => *state = on,
            None => self.effects.places = if on { Places::Seen } else { Places::Instant },
        }
        if switch == Switch::Frozen && on {
            self.outside = true;
        }
        if switch == Switch::Outside && !on {
            self.frozen = false;
        }
        let phrase = effect(switch)?;
        let said = if on { Phrase::On } else { Phrase::Off };
        Some(self.language.fill(said, &[&self.language.text(phrase)]))
    }

    /// True for an action that a presentation carries out, and that a replay repeats. What the rider has opened to read
    /// or to choose is not opened again, and whoever watches has a comfort of their own.
    pub fn repeats(action: &Action) -> bool {
        match action {
            Action::Toggle(switch) | Action::Turn(switch, _) => {
                !matches!(switch, Switch::Menu | Switch::Readings | Switch::Cockpit)
            }
            Action::Set(setting, _) | Action::Next(setting) => {
                !matches!(setting, Setting::Language | Setting::Vignette)
            }
            Action::NextView | Action::Expose(_) | Action::Orbit { .. } => true,
            _ => false,
        }
    }

    /// Takes the next value of a setting that has a few.
    fn next(&mut self, setting: Setting) -> Option<String> {
        match setting {
            Setting::Tone => {
                self.development.tone = development::next(self.development.tone);
                Some(self.language.fill(Phrase::ToneIs, &[&development::name(&self.development.tone)]))
            }
            Setting::Gamut => {
                self.development.gamut = development::next(self.development.gamut);
                None
            }
            Setting::Latency => {
                self.latency = development::next(self.latency);
                None
            }
            Setting::Language => {
                self.language = self.language.next();
                None
            }
            Setting::Effects | Setting::View => {
                self.effects.places = self.effects.places.next();
                Some(self.language.fill(Phrase::ViewIs, &[&self.language.text(view(self.effects.places))]))
            }
            Setting::Colouring => {
                self.colouring = self.colouring.next();
                Some(self.language.fill(Phrase::ColouringIs, &[&self.language.text(colouring(self.colouring))]))
            }
            Setting::Vignette => {
                self.vignette = development::next(self.vignette);
                Some(self.language.fill(Phrase::VignetteIs, &[&self.language.text(vignette(self.vignette))]))
            }
            Setting::Fov | Setting::Exposure | Setting::Renderer => None,
        }
    }
}

/// Name of a view.
pub fn view(places: Places) -> Phrase {
    match places {
        Places::Seen => Phrase::Seen,
        Places::Measured => Phrase::Measured,
        Places::Instant => Phrase::Instant,
    }
}

/// Name of a vignette.
pub fn vignette(vignette: Vignette) -> Phrase {
    match vignette {
        Vignette::Off => Phrase::VignetteOff,
        Vignette::Weak => Phrase::VignetteWeak,
        Vignette::Strong => Phrase::VignetteStrong,
    }
}

/// Name of a colouring.
pub fn colouring(colouring: Colouring) -> Phrase {
    match colouring {
        Colouring::Light => Phrase::ByLight,
        Colouring::Doppler => Phrase::ByDoppler,
        Colouring::Delay => Phrase::ByDelay,
    }
}

/// Name of a switch that changes the light, whose state is told.
fn effect(switch: Switch) -> Option<Phrase> {
    match switch {
        Switch::Doppler => Some(Phrase::Doppler),
        Switch::Searchlight => Some(Phrase::Searchlight),
        _ => None,
    }
}
