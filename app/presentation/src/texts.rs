//! Texts of the settings: those of the command line's options, for recordings and the settings file.

use crate::presentation::Presentation;
use clap::ValueEnum;
use input::{Action, Setting};
use render::display::development;
use std::collections::BTreeMap;
use view::{Colouring, Dial, Effects, Places};

/// Field of view that can be drawn, degrees, as on the command line.
const FOV_DEG: std::ops::RangeInclusive<f64> = 1.0..=170.0;

/// Name of the text that says which effects of light are switched on, whether or not the view shows them.
const LIGHT: &str = "light";

/// Settings by their names. Comfort is no part of a recording: whoever watches it has a comfort of their own.
const NAMES: [(&str, Setting); 10] = [
    ("effects", Setting::Effects),
    ("view", Setting::View),
    ("fov", Setting::Fov),
    ("exposure", Setting::Exposure),
    ("tone", Setting::Tone),
    ("gamut", Setting::Gamut),
    ("latency", Setting::Latency),
    ("renderer", Setting::Renderer),
    ("language", Setting::Language),
    ("colouring", Setting::Colouring),
];

impl Presentation {
    /// Gives a setting the value of a text. `None` if the text names none, which changes nothing.
    pub(crate) fn set(&mut self, setting: Setting, text: &str) -> Option<()> {
        match setting {
            Setting::Effects => {
                let effects: Effects = text.parse().ok()?;
                // Effects of light have no part in what is measured, and are as before in the next view.
                let measured = effects.places == Places::Measured;
                self.effects = if measured { Effects { places: effects.places, ..self.effects } } else { effects };
            }
            Setting::View => self.effects.places = Places::named(text)?,
            Setting::Fov => self.fov_deg = text.parse().ok().filter(|fov| FOV_DEG.contains(fov))?,
            Setting::Exposure => self.development.exposure = text.parse().ok()?,
            Setting::Tone => self.development.tone = choice(text)?,
            Setting::Gamut => self.development.gamut = choice(text)?,
            Setting::Latency => self.latency = choice(text)?,
            Setting::Renderer if text.is_empty() => self.dial = None,
            Setting::Renderer => {
                let dial: Dial = text.parse().ok()?;
                dial.check_for_ride().ok()?;
                self.dial = Some(dial);
            }
            Setting::Language => self.language = text.parse().ok()?,
            Setting::Colouring => self.colouring = Colouring::ALL.into_iter().find(|known| known.name() == text)?,
            Setting::Vignette => self.vignette = choice(text)?,
        }
        Some(())
    }

    /// Text of a setting's value.
    pub fn text(&self, setting: Setting) -> String {
        match setting {
            Setting::Effects => self.effects.to_string(),
            Setting::View => self.effects.places.name().to_owned(),
            Setting::Fov => self.fov_deg.to_string(),
            Setting::Exposure => self.development.exposure.to_string(),
            Setting::Tone => development::name(&self.development.tone),
            Setting::Gamut => development::name(&self.development.gamut),
            Setting::Latency => development::name(&self.latency),
            Setting::Renderer => self.dial.map_or_else(String::new, |dial| dial.to_string()),
            Setting::Language => self.language.to_string(),
            Setting::Colouring => self.colouring.name().to_owned(),
            Setting::Vignette => development::name(&self.vignette),
        }
    }

    /// JSON text of all settings, as it stands in a recording's header.
    pub fn to_json(&self) -> String {
        let mut texts: BTreeMap<_, _> = NAMES.into_iter().map(|(name, setting)| (name, self.text(setting))).collect();
        let light = Self { effects: Effects { places: Places::Seen, ..self.effects }, ..*self };
        texts.insert(LIGHT, light.text(Setting::Effects));
        serde_json::to_string(&texts).expect("texts are always JSON")
    }

    /// The same, with the settings of a recording's header. Those that are missing or unknown stay as they are.
    #[must_use]
    pub fn with_json(mut self, json: &str) -> Self {
        let texts: BTreeMap<String, String> = serde_json::from_str(json).unwrap_or_default();
        if let Some(Ok(Effects { doppler, searchlight, .. })) = texts.get(LIGHT).map(|text| text.parse()) {
            self.effects = Effects { doppler, searchlight, ..self.effects };
        }
        for (name, setting) in NAMES {
            if let Some(text) = texts.get(name) {
                self.act(&Action::Set(setting, text.clone()));
            }
        }
        self
    }
}

/// Choice of a name on the command line.
fn choice<T: ValueEnum>(text: &str) -> Option<T> {
    T::from_str(text, false).ok()
}

#[cfg(test)]
mod tests {
    //! Laws: what a presentation writes, it reads again as the same; a text that is no value changes nothing; a switch
    //! turned twice is as it was.

    use super::*;
    use crate::latency::Latency;
    use crate::vignette::Vignette;
    use input::Switch;
    use render::display::{Exposure, Tone};
    use words::Language;

    #[test]
    fn settings_survive_their_texts() {
        let mut other = Presentation::default();
        for (setting, text) in [
            (Setting::Effects, "geometry,doppler"),
            (Setting::View, "seen"),
            (Setting::Fov, "75.5"),
            (Setting::Exposure, "auto-0.5"),
            (Setting::Tone, "filmic"),
            (Setting::Gamut, "clamp"),
            (Setting::Latency, "low"),
            (Setting::Renderer, "--renderer polygon --tolerance 2"),
            (Setting::Language, "de"),
            (Setting::Colouring, "delay"),
        ] {
            assert_eq!(other.act(&Action::Set(setting, text.to_owned())), None, "{text}");
            assert_eq!(other.text(setting), text);
        }
        assert_eq!((other.fov_deg, other.latency, other.language), (75.5, Latency::Low, Language::German));
        assert_eq!((other.development.exposure, other.development.tone), (Exposure::Auto(-0.5), Tone::Filmic));
        assert_eq!(Presentation::default().with_json(&other.to_json()), other);
    }

    #[test]
    fn a_key_goes_through_three_views_and_round() {
        let mut shown = Presentation::default();
        for places in Places::ALL {
            assert_eq!(shown.effects.places, places);
            shown.act(&Action::NextView);
        }
        assert_eq!(shown, Presentation::default());
    }

    #[test]
    fn a_text_that_is_no_value_changes_nothing() {
        let before = Presentation::default();
        for (_, setting) in NAMES {
            for text in ["", "171", "nan", "loud", "--renderer raytrace", "--tolerance nan", "--edge 1 --tolerance 1"] {
                if setting == Setting::Renderer && text.is_empty() {
                    continue;
                }
                let mut after = before;
                let told = after.act(&Action::Set(setting, text.to_owned()));
                assert!(told.is_some_and(|told| told.contains("no such value")), "{setting:?} {text}");
                assert_eq!(after, before, "{setting:?} {text}");
            }
        }
        for json in ["", "[]", "{\"tone\":3}", "{\"tune\":\"x\",\"fov\":\"0\"}"] {
            assert_eq!(before.with_json(json), before);
        }
    }

    #[test]
    fn every_view_is_reached_and_keeps_the_switches_of_the_light() {
        for before in Places::ALL {
            for view in Places::ALL {
                let mut after = Presentation::default();
                after.act(&Action::Set(Setting::View, before.name().to_owned()));
                after.act(&Action::Toggle(Switch::Doppler));
                after.act(&Action::Set(Setting::View, view.name().to_owned()));
                assert_eq!(after.effects, Effects { places: view, doppler: false, searchlight: true });
                // What is written keeps the switches that the view does not show.
                assert_eq!(Presentation::default().with_json(&after.to_json()), after);
            }
        }
    }

    #[test]
    fn comfort_is_the_onlookers_own() {
        let mut rider = Presentation::default();
        let asked = [
            Action::Set(Setting::Vignette, "strong".to_owned()),
            Action::Next(Setting::Vignette),
            Action::Next(Setting::Vignette),
            Action::Toggle(Switch::Cockpit),
        ];
        for (action, vignette) in asked.iter().zip([Vignette::Strong, Vignette::Off, Vignette::Weak, Vignette::Weak]) {
            rider.act(action);
            assert_eq!(rider.vignette, vignette);
            assert!(!Presentation::repeats(action), "{action:?}");
        }
        assert!(rider.cockpit);
        assert_eq!(Presentation::default().with_json(&rider.to_json()), Presentation::default());
        let told = rider.act(&Action::Set(Setting::Vignette, "black".to_owned()));
        assert!(told.is_some_and(|told| told.contains("no such value")) && rider.vignette == Vignette::Weak);
    }

    #[test]
    fn a_switch_turned_twice_is_as_it_was() {
        for switch in [
            Switch::Geometry,
            Switch::Doppler,
            Switch::Searchlight,
            Switch::Outside,
            Switch::Readings,
            Switch::Menu,
            Switch::Miniature,
            Switch::Diagram,
            Switch::DiagramOfVehicle,
            Switch::Clocks,
            Switch::Planner,
            Switch::Cockpit,
        ] {
            let mut after = Presentation::default();
            let before = after.is_on(switch);
            after.act(&Action::Toggle(switch));
            assert_eq!(after.is_on(switch), !before, "{switch:?}");
            after.act(&Action::Toggle(switch));
            assert_eq!(after, Presentation::default(), "{switch:?}");
            for on in [true, true, false, false] {
                after.act(&Action::Turn(switch, on));
                assert_eq!(after.is_on(switch), on, "{switch:?}");
            }
        }
        // What is frozen is seen from outside, and whoever goes back in thaws it.
        let mut frozen = Presentation::default();
        frozen.act(&Action::Toggle(Switch::Frozen));
        assert!(frozen.outside && frozen.frozen);
        frozen.act(&Action::Toggle(Switch::Outside));
        assert_eq!(frozen, Presentation::default());
    }
}
