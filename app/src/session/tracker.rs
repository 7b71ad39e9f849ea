//! How the head before a display is tracked: the display's `[tracker]` table, or what the command line names instead.

use super::Head;
use crate::room::Display;
use glam::DMat3;
use input::head::TrackingMode;
use input::{ConfigError, HeadConfig, HeadState, TrackerUrl};
use physics::Celerity;
use serde::Deserialize;
use thiserror::Error;

/// Why a head cannot be tracked.
#[derive(Debug, Error)]
pub enum TrackerError {
    /// A table that says something else.
    #[error("display {display}, [tracker]: {reason}")]
    Table {
        /// Whose.
        display: String,
        /// As the reader of the table says it.
        reason: String,
    },
    /// A setting that cannot be used.
    #[error("display {display}: {source}")]
    Setting {
        /// Whose.
        display: String,
        /// Which, and why.
        source: ConfigError,
    },
}

/// The tracker of a display; `url` is asked instead of the one that the display names.
///
/// # Errors
/// [`TrackerError`], by the display's name and key.
pub fn head_config(display: &Display, url: Option<&TrackerUrl>) -> Result<Option<HeadConfig>, TrackerError> {
    let name = || display.name.clone();
    let home = display.viewer.head_m.to_array();
    let table = match &display.tracker {
        None => None,
        Some(table) => {
            let mut config = HeadConfig::deserialize(table.clone())
                .map_err(|error| TrackerError::Table { display: name(), reason: one_line(&error.to_string()) })?;
            if table.get("home").is_none() {
                config.home = home;
            }
            Some(config)
        }
    };
    let config = match (table, url) {
        (Some(config), Some(url)) => Some(HeadConfig { url: url.clone(), ..config }),
        (None, Some(url)) => Some(HeadConfig { home, ..HeadConfig::new(url.clone()) }),
        (config, None) => config,
    };
    if let Some(config) = &config {
        config.check().map_err(|source| TrackerError::Setting { display: name(), source })?;
    }
    Ok(config.filter(|config| config.mode != TrackingMode::None))
}

/// A head as a tracker sees it, where light goes at `speed_of_light` m/s.
///
/// A velocity that is none takes the head to rest.
pub fn head(state: &HeadState, speed_of_light: f64) -> Head {
    Head {
        place_m: state.position_m,
        room_from_head: DMat3::from_quat(state.orientation),
        celerity: Celerity::new(input::head::celerity(state.velocity_m_s, speed_of_light)).unwrap_or_default(),
    }
}

/// A report of several lines as one.
fn one_line(report: &str) -> String {
    report.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    //! A display's tracker must be the one that is asked; a table that cannot be used must be told of by display and key.
    #![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

    use super::*;
    use glam::{DQuat, DVec3};
    use input::head::Tracking;

    fn display(table: &str) -> Display {
        Display { tracker: Some(toml::from_str(table).unwrap()), ..Display::built_in("cave4").unwrap() }
    }

    #[test]
    fn the_command_line_names_another_tracker_and_keeps_the_rest() {
        let of_table = display("url = \"vrpn://lab/Head\"\nsensor = 2");
        let other = "dtrack://:5000".parse().unwrap();
        let config = head_config(&of_table, Some(&other)).unwrap().unwrap();
        assert_eq!((config.url, config.sensor), (other, 2));
        assert_eq!(config.home, of_table.viewer.head_m.to_array());
        assert_eq!(head_config(&Display::built_in("cave4").unwrap(), None).unwrap(), None);
        assert_eq!(head_config(&display("url = \"mouse\"\nmode = \"none\""), None).unwrap(), None);
    }

    #[test]
    fn what_cannot_be_used_is_told_by_display_and_key() {
        for (table, key) in [
            ("url = \"ftp://lab\"", "ftp"),
            ("url = \"mouse\"\nfade = 1", "fade"),
            ("url = \"mouse\"\nfade_s = -1.0", "fade_s"),
        ] {
            let told = head_config(&display(table), None).unwrap_err().to_string();
            assert!(told.contains("cave4") && told.contains(key), "{told}");
        }
    }

    #[test]
    fn a_tracked_velocity_is_celerity_times_c() {
        let state = HeadState {
            position_m: DVec3::new(0.1, 1.7, 0.2),
            orientation: DQuat::from_rotation_y(0.3),
            velocity_m_s: DVec3::new(0.0, 0.0, -6.25),
            tracked: Tracking::Tracked,
        };
        let head = head(&state, 25.0 / 3.0);
        assert_eq!(head.celerity.vector(), DVec3::new(0.0, 0.0, -0.75)); // β = 0.6
        assert_eq!(head.place_m, state.position_m);
    }
}
