//! Tracker of the head: from the display's `[tracker]` table, or from the command line instead.

use glam::{DMat3, DVec3};
use input::head::{HEAD_EDITION, Recentring, TrackingMode, VelocityFilter};
use input::{ConfigError, HeadConfig, HeadState, TrackerUrl};
use physics::Celerity;
use room::Display;
use serde::Deserialize;
use thiserror::Error;
use walls::RoomHead;

/// Window of the velocity of a head that opentrack follows, unless the display says otherwise, seconds.
const OPENTRACK_WINDOW_S: f64 = 0.1;

/// Reason why a head cannot be tracked.
#[derive(Debug, Error)]
pub enum TrackerError {
    /// A `[tracker]` table that cannot be understood.
    #[error("display {display}, [tracker]: {reason}")]
    Table {
        /// Name of the display.
        display: String,
        /// Reason, as the reader of the table words it.
        reason: String,
    },
    /// A display that tracks no head, where one is asked for.
    #[error(
        "display {0} tracks no head: its table [tracker] is missing, or says mode = \"none\"; name a tracker with --tracker"
    )]
    Untracked(String),
    /// A sensor that is chosen of no tracker.
    #[error(
        "--sensor chooses a sensor of a tracker: name that with --tracker, or a display whose file has a table [tracker]"
    )]
    Sensor,
    /// A setting with a value that is not allowed.
    #[error("display {display}: {source}")]
    Setting {
        /// Name of the display.
        display: String,
        /// Setting, and the reason.
        source: ConfigError,
    },
}

/// Tracker settings of a display. `url` replaces the tracker that the display names.
///
/// # Errors
/// [`TrackerError`], with the display's name and the key.
pub fn head_config(display: &Display, url: Option<&TrackerUrl>) -> Result<Option<HeadConfig>, TrackerError> {
    let name = || display.name.clone();
    let table = match &display.tracker {
        None => None,
        Some(table) => Some(
            HeadConfig::deserialize(table.clone())
                .map_err(|error| TrackerError::Table { display: name(), reason: one_line(&error.to_string()) })?,
        ),
    };
    let config = match (table, url) {
        (Some(config), Some(url)) => Some(HeadConfig { url: url.clone(), ..config }),
        (None, Some(url)) => Some(HeadConfig::new(url.clone())),
        (config, None) => config,
    };
    let given = |key: &str| display.tracker.as_ref().is_some_and(|table| table.get(key).is_some());
    let config = config.map(|config| with_usual(config, display, given));
    if let Some(config) = &config {
        config.check().map_err(|source| TrackerError::Setting { display: name(), source })?;
    }
    Ok(config.filter(|config| config.mode != TrackingMode::None))
}

/// The settings, with the usual values of this display and this tracker for each key that is not `given`.
fn with_usual(mut config: HeadConfig, display: &Display, given: impl Fn(&str) -> bool) -> HeadConfig {
    let is_opentrack = matches!(config.url, TrackerUrl::Opentrack { .. });
    if !given("edition") {
        config.edition = HEAD_EDITION;
    }
    if !given("home") {
        config.home = display.viewer.head_m.to_array();
    }
    if !given("velocity") && is_opentrack {
        // Cameras of desks are noisier than trackers of rooms.
        config.velocity = VelocityFilter::LeastSquares { window_s: OPENTRACK_WINDOW_S };
    }
    if !given("recentre") {
        let is_placed = given("room_from_tracker");
        config.recentre = match display.viewer.turns_pictures {
            _ if is_opentrack => Recentring::Key,
            // A window that stands for what is ahead of the head stands before it, wherever the tracker's floor is.
            true if !is_placed && config.url != TrackerUrl::Mouse => Recentring::Start,
            true => Recentring::Key,
            false => Recentring::Never,
        };
    }
    config
}

/// Head as a tracker reports it, in a world whose speed of light is `speed_of_light` m/s.
///
/// A velocity or a turn that is not finite counts as zero.
pub fn head(state: &HeadState, speed_of_light: f64) -> RoomHead {
    let turn_rate = state.turn_rad_s / speed_of_light;
    RoomHead {
        place_m: state.position_m,
        room_from_head: DMat3::from_quat(state.orientation),
        celerity: Celerity::new(state.velocity_m_s / speed_of_light).unwrap_or_default(),
        turn_rate: if turn_rate.is_finite() { turn_rate } else { DVec3::ZERO },
    }
}

/// Report of several lines as a single line.
fn one_line(report: &str) -> String {
    report.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    //! Law under test: a display's own tracker is the one that is used, and a table that cannot be used is reported
    //! with display and key.
    #![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

    use super::*;
    use glam::DQuat;
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
    fn a_window_that_turns_with_the_head_stands_before_it_and_a_room_stands_where_it_is() {
        let recentre =
            |display: &Display, url: &str| head_config(display, Some(&url.parse().unwrap())).unwrap().unwrap().recentre;
        for (name, url, expected) in [
            ("window", "vrpn://lab/Head", Recentring::Start),
            ("desk", "dtrack://:5000", Recentring::Start),
            ("desk", "opentrack://", Recentring::Key),
            ("window", "mouse", Recentring::Key),
            ("cave4", "vrpn://lab/Head", Recentring::Never),
            ("cave4", "opentrack://", Recentring::Key),
        ] {
            assert_eq!(recentre(&Display::built_in(name).unwrap(), url), expected, "{name}, {url}");
        }
        // Whoever has measured, or says so, is believed.
        let window = |table: &str| Display {
            tracker: Some(toml::from_str(table).unwrap()),
            ..Display::built_in("window").unwrap()
        };
        let placed = window("url = \"mouse\"\nroom_from_tracker = { position = [0, 1.3, 0] }");
        assert_eq!(recentre(&placed, "vrpn://lab/Head"), Recentring::Key);
        assert_eq!(recentre(&window("url = \"mouse\"\nrecentre = \"never\""), "opentrack://"), Recentring::Never);
    }

    #[test]
    fn the_noise_of_a_desks_camera_is_filtered_unless_the_display_says_how() {
        let velocity =
            |display: &Display| head_config(display, Some(&"opentrack://".parse().unwrap())).unwrap().unwrap().velocity;
        let desk = Display::built_in("desk").unwrap();
        assert_eq!(velocity(&desk), VelocityFilter::LeastSquares { window_s: 0.1 });
        assert_eq!(velocity(&display("url = \"mouse\"\nvelocity = { filter = \"off\" }")), VelocityFilter::Off);
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
            turn_rad_s: DVec3::new(0.0, 2.5, 0.0),
            tracked: Tracking::Tracked,
        };
        let head = head(&state, 25.0 / 3.0);
        assert_eq!(head.celerity.vector(), DVec3::new(0.0, 0.0, -0.75)); // β = 0.6
        assert_eq!((head.place_m, head.turn_rate), (state.position_m, DVec3::new(0.0, 0.3, 0.0)));
    }
}
