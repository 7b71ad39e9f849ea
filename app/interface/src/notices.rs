//! Notices of the vehicle in the rider's language.

use ride::{Notice, RAPIDITY_CAP};
use words::{Language, Phrase};

/// Sentence of a notice.
pub fn notice(notice: Notice, language: Language) -> String {
    let phrase = match notice {
        Notice::RapidityCapped => return language.fill(Phrase::RapidityCapped, &[&RAPIDITY_CAP]),
        Notice::ControlsNotFinite => Phrase::ControlsNotFinite,
        Notice::TakenByRk4 => Phrase::TakenByRk4,
        Notice::NotIntegrated => Phrase::NotIntegrated,
        Notice::HeldByWalls => Phrase::HeldByWalls,
        Notice::SpeedOfLightRefused => Phrase::SpeedOfLightRefused,
    };
    language.text(phrase).to_owned()
}

#[cfg(test)]
mod tests {
    //! Law: in English a notice reads as the vehicle words it, so that the terminal and the window say the same.

    use super::*;

    #[test]
    fn the_window_says_what_the_vehicle_says() {
        for each in [
            Notice::RapidityCapped,
            Notice::ControlsNotFinite,
            Notice::TakenByRk4,
            Notice::NotIntegrated,
            Notice::HeldByWalls,
            Notice::SpeedOfLightRefused,
        ] {
            assert_eq!(notice(each, Language::English), each.to_string());
            assert_ne!(notice(each, Language::German), each.to_string());
        }
    }
}
