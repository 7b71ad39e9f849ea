//! Tracker of the head: from the display's `[tracker]` table, or from the command line instead.

use crate::set_up::{SetUp, SetUpError};
use input::head::{HEAD_EDITION, Recentring, TrackingMode, VelocityFilter};
use input::openxr::{RIGHT_HAND, TRIGGER_AXIS};
use input::{HeadConfig, TrackerUrl, WandConfig};
use room::Display;
use thiserror::Error;

/// Name of the display for a tracked head if no display is named.
pub const WINDOW: &str = "window";
/// Name of the display for a head that opentrack follows if no display is named.
pub const DESK: &str = "desk";

/// Name of the display for this tracker if no display is named.
pub fn usual_display(tracker: &TrackerUrl) -> &'static str {
    if matches!(tracker, TrackerUrl::Opentrack { .. }) { DESK } else { WINDOW }
}

/// Step by which a headset's rider turns in the vehicle, unless the set-up says otherwise, degrees.
const SNAP_TURN_DEG: f64 = 30.0;
/// Window of the velocity of a head that opentrack follows, unless the display says otherwise, seconds.
const OPENTRACK_WINDOW_S: f64 = 0.1;

/// Reason why a head cannot be tracked.
#[derive(Debug, Error)]
pub enum TrackerError {
    /// A display that tracks no head, where one is asked for.
    #[error(
        "display {0} tracks no head: its table [tracker] is missing, or says mode = \"none\"; name a tracker with --tracker"
    )]
    Untracked(String),
    /// A sensor that is chosen of no tracker.
    #[error(
        "--sensor chooses a sensor of a tracker: name that with --tracker, or with --display or --set-up a file that has a table [tracker]"
    )]
    Sensor,
}

/// Tracker settings of a set-up, before a display. `url` replaces the tracker that the set-up names.
///
/// # Errors
/// [`SetUpError`], with the file's name and the key.
pub fn head_config(
    display: Option<&Display>,
    set_up: &SetUp,
    url: Option<&TrackerUrl>,
) -> Result<Option<HeadConfig>, SetUpError> {
    let config = match (set_up.head(url)?, url) {
        (None, Some(url)) => Some(HeadConfig::new(url.clone())),
        // A mouse and opentrack follow one head: numbers, units and wands of another tracker mean nothing to them.
        (Some(config), Some(url)) if has_one_head(url) && set_up.tracker_url().as_ref() != Some(url) => {
            Some(HeadConfig { velocity: config.velocity, mode: config.mode, ..HeadConfig::new(url.clone()) })
        }
        (config, _) => config,
    };
    let given = |key: &str| set_up.tracker().is_some_and(|table| table.get(key).is_some());
    let config = config.map(|config| with_usual(config, display, given));
    if let Some(config) = &config {
        config.check().map_err(|source| set_up.refused(source))?;
    }
    Ok(config.filter(|config| config.mode != TrackingMode::None))
}

fn has_one_head(tracker: &TrackerUrl) -> bool {
    matches!(tracker, TrackerUrl::Opentrack { .. } | TrackerUrl::Mouse)
}

/// Wand that is a headset's right controller.
fn controller() -> WandConfig {
    WandConfig { sensor: RIGHT_HAND, trigger: Some(TRIGGER_AXIS), ..WandConfig::default() }
}

/// The settings, with the usual values of this display and this tracker for each key that is not `given`.
fn with_usual(mut config: HeadConfig, display: Option<&Display>, given: impl Fn(&str) -> bool) -> HeadConfig {
    let is_opentrack = matches!(config.url, TrackerUrl::Opentrack { .. });
    if !given("edition") {
        config.edition = HEAD_EDITION;
    }
    if !given("velocity") && is_opentrack {
        // Cameras of desks are noisier than trackers of rooms.
        config.velocity = VelocityFilter::LeastSquares { window_s: OPENTRACK_WINDOW_S };
    }
    if !given("wand") && config.url == TrackerUrl::Openxr {
        config.wand = Some(controller());
    }
    let Some(display) = display else { return config };
    if !given("home") {
        config.home = display.viewer.head_m.to_array();
    }
    if !given("snap_turn_deg") && config.url == TrackerUrl::Openxr && display.viewer.turns_pictures {
        config.snap_turn_deg = SNAP_TURN_DEG;
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

#[cfg(test)]
mod tests {
    //! Law under test: a display's own tracker is the one that is used, and a table that cannot be used is reported
    //! with display and key.
    #![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

    use super::*;
    use input::head::Stance;

    fn display_of(name: &str, table: &str) -> Display {
        let set_up = toml::from_str(&format!("[tracker]\n{table}")).unwrap();
        Display { set_up, ..Display::built_in(name).unwrap() }
    }

    fn display(table: &str) -> Display {
        display_of("cave4", table)
    }

    /// Tracker settings of a display whose file is all of the set-up.
    fn config_of(display: &Display, url: Option<&TrackerUrl>) -> Result<Option<HeadConfig>, SetUpError> {
        head_config(Some(display), &SetUp::of(Some(display), None).unwrap(), url)
    }

    #[test]
    fn the_command_line_names_another_tracker_and_keeps_the_rest() {
        let of_table = display("url = \"vrpn://lab/Head\"\nsensor = 2");
        let other = "dtrack://:5000".parse().unwrap();
        let config = config_of(&of_table, Some(&other)).unwrap().unwrap();
        assert_eq!((config.url, config.sensor), (other, 2));
        assert_eq!(config.home, of_table.viewer.head_m.to_array());
        let of_room = display("url = \"vrpn://lab/Head\"\nsensor = 2\nscale = \"mm\"");
        for one_head in ["opentrack://", "mouse"] {
            let config = config_of(&of_room, Some(&one_head.parse().unwrap())).unwrap().unwrap();
            assert_eq!((config.sensor, config.scale), (0, None), "{one_head}");
        }
        assert_eq!(config_of(&Display::built_in("cave4").unwrap(), None).unwrap(), None);
        assert_eq!(config_of(&display("url = \"mouse\"\nmode = \"none\""), None).unwrap(), None);
    }

    #[test]
    fn the_right_controller_of_a_headset_is_the_wand_unless_the_display_says_which() {
        let wand = |display: &Display| config_of(display, Some(&"openxr://".parse().unwrap())).unwrap().unwrap().wand;
        let usual = wand(&Display::built_in("cave4").unwrap()).unwrap();
        assert_eq!((usual.sensor, usual.trigger), (2, Some(2)));
        let left = wand(&display("url = \"openxr://\"\n[tracker.wand]\nsensor = 1")).unwrap();
        assert_eq!((left.sensor, left.trigger), (1, None));
        assert_eq!(config_of(&display("url = \"vrpn://lab/Head\""), None).unwrap().unwrap().wand, None);
    }

    #[test]
    fn a_headset_turns_in_steps_where_its_pictures_turn_unless_the_set_up_says_otherwise() {
        let of = |display: &Display, url: &str| {
            let config = config_of(display, Some(&url.parse().unwrap())).unwrap().unwrap();
            (config.snap_turn_deg, config.stance)
        };
        let window = Display::built_in("window").unwrap();
        assert_eq!(of(&window, "openxr://"), (30.0, Stance::Seated));
        assert_eq!(of(&window, "vrpn://lab/Head"), (0.0, Stance::Seated));
        assert_eq!(of(&Display::built_in("cave4").unwrap(), "openxr://"), (0.0, Stance::Seated));
        let own = display_of("window", "url = \"openxr://\"\nsnap_turn_deg = 45\nstance = \"standing\"");
        assert_eq!(of(&own, "openxr://"), (45.0, Stance::Standing));
        let told = config_of(&display_of("window", "url = \"openxr://\"\nsnap_turn_deg = 200"), None).unwrap_err();
        assert!(told.to_string().contains("tracker.snap_turn_deg is 200"), "{told}");
    }

    #[test]
    fn a_window_that_turns_with_the_head_stands_before_it_and_a_room_stands_where_it_is() {
        let recentre =
            |display: &Display, url: &str| config_of(display, Some(&url.parse().unwrap())).unwrap().unwrap().recentre;
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
        let window = |table: &str| display_of("window", table);
        let placed = window("url = \"mouse\"\nroom_from_tracker = { position = [0, 1.3, 0] }");
        assert_eq!(recentre(&placed, "vrpn://lab/Head"), Recentring::Key);
        assert_eq!(recentre(&window("url = \"mouse\"\nrecentre = \"never\""), "opentrack://"), Recentring::Never);
    }

    #[test]
    fn the_noise_of_a_desks_camera_is_filtered_unless_the_display_says_how() {
        let velocity =
            |display: &Display| config_of(display, Some(&"opentrack://".parse().unwrap())).unwrap().unwrap().velocity;
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
            let told = config_of(&display(table), None).unwrap_err().to_string();
            assert!(told.contains("cave4") && told.contains(key), "{told}");
        }
    }
}
