//! Notices in the rider's language: of the vehicle, of recordings, of the picture.

use render::certainty::Certainty;
use ride::{LogError, Notice, RAPIDITY_CAP, ReplayError};
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

/// Sentence of a fault of the recording. Reasons of the system stay as it words them.
pub fn log_fault(fault: &LogError, language: Language) -> String {
    match fault {
        LogError::Recording(error) => language.fill(Phrase::NotRecorded, &[error]),
        LogError::NotRemembered { why } => language.fill(Phrase::NotRemembered, &[why]),
        LogError::Incomplete { path } => language.fill(Phrase::RecordingCut, &[&path.display()]),
    }
}

/// Sentence of a fault of a replay.
pub fn replay_fault(fault: &ReplayError, language: Language) -> String {
    match fault {
        ReplayError::Differs { frame, difference } => language
            .fill(Phrase::ReplayDiffers, &[frame, &difference.field, &difference.recorded, &difference.replayed]),
        fault => fault.to_string(),
    }
}

/// Error of a picture's directions.
pub fn accuracy(certainty: &Certainty, language: Language) -> String {
    format!("±{}", angle(certainty, language))
}

/// Notice of a picture whose directions are too uncertain.
pub fn uncertainty(certainty: &Certainty, language: Language) -> Option<String> {
    let phrase = if certainty.is_rounded() { Phrase::AsternUncertain } else { Phrase::DirectionsUncertain };
    certainty.is_noticed().then(|| language.fill(phrase, &[&angle(certainty, language)]))
}

fn angle(certainty: &Certainty, language: Language) -> String {
    certainty.about([Phrase::Arcminutes, Phrase::Arcseconds].map(|unit| language.text(unit)))
}

#[cfg(test)]
mod tests {
    //! Law: in English a notice reads as the vehicle words it, so that the terminal and the window say the same.

    use super::*;
    use input::recording::{FrameDifference, RecordingError};

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

    #[test]
    fn the_window_says_of_recordings_what_the_terminal_says() {
        let lost = LogError::NotRemembered { why: "EIO".to_owned() };
        let cut = LogError::Incomplete { path: "ride.mcap".into() };
        for (fault, named) in [(lost, "EIO"), (cut, "ride.mcap")] {
            assert_eq!(log_fault(&fault, Language::English), fault.to_string());
            let german = log_fault(&fault, Language::German);
            assert!(german.contains(named) && german != fault.to_string(), "{german}");
        }
        // What the system says stays as it says it.
        let system = RecordingError::Exists { path: "ride.mcap".into() };
        let (said, recording) = (system.to_string(), LogError::Recording(system));
        for language in Language::ALL {
            assert!(log_fault(&recording, language).ends_with(&said));
        }
        let difference = FrameDifference { field: "own_s".into(), recorded: "1".into(), replayed: "2".into() };
        let differs = ReplayError::Differs { frame: 7, difference };
        assert_eq!(replay_fault(&differs, Language::English), differs.to_string());
        let german = replay_fault(&differs, Language::German);
        assert!(["Bild 7", "own_s war 1, ist 2"].iter().all(|part| german.contains(part)), "{german}");
    }

    #[test]
    fn the_window_says_of_a_picture_what_the_terminal_says() {
        let pixel_rad = 1e-4;
        let edges = Certainty { drawn_rad: 0.2, rounded_rad: 0.0, pixel_rad };
        let numbers = Certainty { drawn_rad: 0.0, rounded_rad: 2e-3, pixel_rad };
        for certainty in [edges, numbers] {
            assert_eq!(uncertainty(&certainty, Language::English), Some(certainty.sentence()));
        }
        let german = uncertainty(&numbers, Language::German);
        assert!(german.is_some_and(|german| german.contains("hinten sind um etwa 6.9 Bogenminuten unsicher")));
        assert_eq!(accuracy(&edges, Language::German), "±11°");
        assert_eq!(uncertainty(&Certainty { rounded_rad: 1e-9, drawn_rad: 0.0, pixel_rad }, Language::English), None);
    }
}
