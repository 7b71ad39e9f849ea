//! Sentences on the corners of a room's pictures while they are moved.

use walls::calibration::{Calibration, CalibrationError};
use words::{Language, Phrase};

/// Names of the corners, in the order of a warp's places.
const NAMES: [Phrase; 4] = [Phrase::UpperLeft, Phrase::UpperRight, Phrase::LowerRight, Phrase::LowerLeft];

/// Chosen corner and its place.
pub fn corner_place(calibration: &Calibration, language: Language) -> String {
    let (channel, at, is_saved) = calibration.place();
    let name = language.text(NAMES[calibration.chosen().1]);
    let place = language.fill(Phrase::CornerAt, &[&channel, &name, &at.x, &at.y]);
    if is_saved { place } else { language.fill(Phrase::CornerUnsaved, &[&place]) }
}

/// Sentence on a key press that is refused.
pub fn corner_refused(error: &CalibrationError, language: Language) -> String {
    match error {
        CalibrationError::MeasuredWarp { channel } => language.fill(Phrase::MeasuredWarp, &[channel]),
        CalibrationError::NotConvex { channel, .. } => language.fill(Phrase::NotConvex, &[channel]),
    }
}

#[cfg(test)]
mod tests {
    //! Law: in English the window says what the error says; in German it says something else, of the same channel.
    #![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

    use super::*;
    use room::{Display, NotConvex};
    use walls::calibration::CornerKey;

    #[test]
    fn the_window_says_what_the_error_says() {
        let channel = "left".to_owned();
        for error in [
            CalibrationError::MeasuredWarp { channel: channel.clone() },
            CalibrationError::NotConvex { channel, error: NotConvex },
        ] {
            assert_eq!(corner_refused(&error, Language::English), error.to_string());
            let german = corner_refused(&error, Language::German);
            assert!(german.contains("left") && german != error.to_string(), "{german}");
        }
    }

    #[test]
    fn the_chosen_corner_is_named_with_its_place_until_it_is_saved() {
        let display = Display::built_in("window").unwrap();
        let mut calibration = Calibration::new(&display);
        let name = display.channels[0].name.clone();
        assert_eq!(corner_place(&calibration, Language::English), format!("{name}: upper left corner at 0, 0 pixels"));
        calibration.press(CornerKey::Right, false).unwrap();
        let moved = format!("{name}: Ecke links oben bei 1, 0 Pixel, nicht gespeichert");
        assert_eq!(corner_place(&calibration, Language::German), moved);
    }
}
