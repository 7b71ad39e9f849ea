//! Settings of the tracker: the table `[tracker]` of a display file.
//!
//! ```
//! # let text = r#"
//! url = "vrpn://192.168.0.10/Head"
//! sensor = 0
//! room_from_tracker = { position = [0.0, 2.5, -1.5], yaw = 90 }
//! head_from_sensor = { position = [0.0, 0.08, 0.05] }
//! mode = "position-and-velocity"
//! velocity = { filter = "mean", frames = 4 }
//! # "#;
//! # let config: input::HeadConfig = toml::from_str(text).unwrap();
//! # config.check().unwrap();
//! # assert_eq!(config.room_from_tracker.yaw, 90.0);
//! ```

use serde::{Deserialize, Serialize};

use super::flip::FlipAxis;
use super::placement::{AxesPlacement, HEAD_FROM_SENSOR, ROOM_FROM_TRACKER, within};
use super::snap_step::is_step;
use super::stance::Stance;
use super::tracking_mode::TrackingMode;
use super::unit::LengthUnit;
use super::url::TrackerUrl;
use crate::config_error::{ConfigError, positive};
use crate::wand::config::WandConfig;

/// Settings of the tracked head.
///
/// *Frames, units*: the room's axes, in which the screens stand: x right, y up, z backward, metres. Angles are in
/// degrees.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct HeadConfig {
    /// Address of the tracker.
    pub url: TrackerUrl,
    /// Number of the tracker's sensor, or body, that is on the head.
    #[serde(default)]
    pub sensor: i32,
    /// Unit of the lengths that the tracker sends, if it is not the usual one of such trackers.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub scale: Option<LengthUnit>,
    /// Directions that the tracker counts the other way. They are mirrored before the placement.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub flip: Vec<FlipAxis>,
    /// Placement of the tracker's axes in the room; for opentrack from `home`, where its centre is.
    #[serde(default)]
    pub room_from_tracker: AxesPlacement,
    /// Placement of the sensor's axes in the head's, whose origin is midway between the eyes.
    #[serde(default)]
    pub head_from_sensor: AxesPlacement,
    /// True if `sensor` is the number of one of DTrack's inertial bodies: line `6di` instead of `6d`.
    #[serde(default, skip_serializing_if = "is_false")]
    pub inertial: bool,
    /// Parts of the head's state that are used.
    #[serde(default)]
    pub mode: TrackingMode,
    /// Filter that makes the velocity from poses.
    #[serde(default)]
    pub velocity: VelocityFilter,
    /// Time in which the velocity of a lost head fades, seconds.
    #[serde(default = "fade_s")]
    pub fade_s: f64,
    /// Place of the head until the tracker has seen it, metres; start of a head that the mouse moves.
    #[serde(default = "home")]
    pub home: [f64; 3],
    /// Poses that become the straight one: at `home`, facing −z.
    #[serde(default, skip_serializing_if = "Recentring::is_never")]
    pub recentre: Recentring,
    /// Stance of the rider, which says what of a straight pose is the seat's; seated in recordings made before one
    /// could stand.
    #[serde(default, skip_serializing_if = "Stance::is_seated")]
    pub stance: Stance,
    /// Step of the turn that a flick of the other hand's stick makes, degrees, with OpenXR; 0 for none, as in
    /// recordings made before such turns.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub snap_turn_deg: f64,
    /// Edition of the rules by which the poses of the head count: since edition 2 its turn moves the eyes, and real
    /// time is the head's own; since edition 3 poses that can only be in another unit are rejected; since edition 4
    /// a headset's straight pose keeps what is upright. Recordings without
    /// it are of edition 1.
    #[serde(default = "first_edition")]
    pub edition: u32,
    /// Settings of a wand that the same tracker sees; `None` without one, and in recordings made before wands were.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub wand: Option<WandConfig>,
}

fn is_false(flag: &bool) -> bool {
    !flag
}

fn is_zero(number: &f64) -> bool {
    *number == 0.0
}

/// Present edition of the rules by which the poses of the head count.
pub const HEAD_EDITION: u32 = 4;

fn first_edition() -> u32 {
    1
}

fn fade_s() -> f64 {
    0.2
}

/// Place of the eyes of a person who stands in the middle, metres.
fn home() -> [f64; 3] {
    [0.0, 1.7, 0.0]
}

/// Poses of a tracker that become the straight one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Recentring {
    /// No pose: the tracker is calibrated to the room.
    #[default]
    Never,
    /// Pose of the moment at which the rider presses the key.
    Key,
    /// First pose, and that of each moment at which the rider presses the key.
    Start,
}

impl Recentring {
    fn is_never(&self) -> bool {
        *self == Self::Never
    }
}

/// Filter that makes a velocity from poses. The example `head_filters` measures the latency and the remaining noise
/// of each.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "filter", rename_all = "kebab-case", deny_unknown_fields)]
pub enum VelocityFilter {
    /// Mean over the tracker's last frames (W 6.4.1).
    Mean {
        /// Number of frames.
        #[serde(default = "frames")]
        frames: u32,
    },
    /// Slope of the straight line that is closest to the places in a window of time.
    LeastSquares {
        /// Length of the window, seconds.
        #[serde(default = "window_s")]
        window_s: f64,
    },
    /// Low-pass whose cutoff rises with the acceleration: [`crate::filters::OneEuro`] on the differences.
    OneEuro {
        /// Cutoff while the velocity is steady, Hz.
        #[serde(default = "minimum_cutoff_hz")]
        minimum_cutoff_hz: f64,
        /// Rise of the cutoff with the acceleration, Hz per m/s².
        #[serde(default = "acceleration_coefficient")]
        acceleration_coefficient: f64,
        /// Cutoff for the acceleration, Hz.
        #[serde(default = "acceleration_cutoff_hz")]
        acceleration_cutoff_hz: f64,
    },
    /// Difference of the last two poses, without a filter.
    Off,
}

fn frames() -> u32 {
    4
}

fn window_s() -> f64 {
    0.05
}

fn minimum_cutoff_hz() -> f64 {
    1.0
}

fn acceleration_coefficient() -> f64 {
    1.0
}

fn acceleration_cutoff_hz() -> f64 {
    1.0
}

impl Default for VelocityFilter {
    /// Mean over four frames, as in W 6.4.1.
    fn default() -> Self {
        Self::Mean { frames: frames() }
    }
}

impl VelocityFilter {
    /// Largest number of frames that are averaged.
    const MOST_FRAMES: u32 = 1000;
    /// Length of the longest window, seconds.
    const LONGEST_WINDOW_S: f64 = 1.0;

    /// Least-squares filter with its usual window.
    pub fn least_squares() -> Self {
        Self::LeastSquares { window_s: window_s() }
    }

    /// One Euro filter with its usual cutoffs.
    pub fn one_euro() -> Self {
        Self::OneEuro {
            minimum_cutoff_hz: minimum_cutoff_hz(),
            acceleration_coefficient: acceleration_coefficient(),
            acceleration_cutoff_hz: acceleration_cutoff_hz(),
        }
    }

    fn check(self) -> Result<(), ConfigError> {
        match self {
            Self::Mean { frames: 1..=Self::MOST_FRAMES } | Self::Off => Ok(()),
            Self::Mean { frames } => Err(ConfigError {
                key: "tracker.velocity.frames",
                value: frames.to_string(),
                expected: "a number of frames from 1 to 1000",
            }),
            Self::LeastSquares { window_s } if (1e-3..=Self::LONGEST_WINDOW_S).contains(&window_s) => Ok(()),
            Self::LeastSquares { window_s } => Err(ConfigError {
                key: "tracker.velocity.window_s",
                value: window_s.to_string(),
                expected: "a number of seconds from 0.001 to 1",
            }),
            Self::OneEuro { minimum_cutoff_hz, acceleration_coefficient, acceleration_cutoff_hz } => {
                positive("tracker.velocity.minimum_cutoff_hz", minimum_cutoff_hz)?;
                if !(0.0..=1e6).contains(&acceleration_coefficient) {
                    return Err(ConfigError {
                        key: "tracker.velocity.acceleration_coefficient",
                        value: acceleration_coefficient.to_string(),
                        expected: "a number from 0 to 1e6",
                    });
                }
                positive("tracker.velocity.acceleration_cutoff_hz", acceleration_cutoff_hz)
            }
        }
    }
}

impl HeadConfig {
    /// Settings of a tracker without calibration: its axes are the room's, its sensor is the head.
    pub fn new(url: TrackerUrl) -> Self {
        Self {
            url,
            sensor: 0,
            scale: None,
            flip: Vec::new(),
            room_from_tracker: AxesPlacement::default(),
            head_from_sensor: AxesPlacement::default(),
            inertial: false,
            mode: TrackingMode::default(),
            velocity: VelocityFilter::default(),
            fade_s: fade_s(),
            home: home(),
            recentre: Recentring::default(),
            stance: Stance::default(),
            snap_turn_deg: 0.0,
            edition: HEAD_EDITION,
            wand: None,
        }
    }

    /// True if the turn of the head moves the eyes, and real time is the head's own.
    pub fn counts_turn_and_clock(&self) -> bool {
        self.edition >= 2
    }

    /// VRPN devices of the wand other than the head's, each once; none without a wand or a server.
    pub fn wand_devices(&self) -> Vec<String> {
        let (TrackerUrl::Vrpn { device, .. }, Some(wand)) = (&self.url, &self.wand) else {
            return Vec::new();
        };
        let wand = wand.devices(device);
        let mut names = Vec::new();
        for name in [wand.pose, wand.buttons, wand.axes] {
            if name != *device && !names.contains(&name) {
                names.push(name);
            }
        }
        names
    }

    /// True if a pose in another unit is known by its distance.
    pub(super) fn knows_units(&self) -> bool {
        self.edition >= 3
    }

    /// True if the tracker knows what is upright, and a straight pose keeps that.
    pub(super) fn keeps_upright(&self) -> bool {
        self.edition >= 4 && self.url == TrackerUrl::Openxr
    }

    /// True if the tracker is opentrack.
    pub(super) fn is_opentrack(&self) -> bool {
        matches!(self.url, TrackerUrl::Opentrack { .. })
    }

    /// Checks the unit and the mirrors.
    fn check_axes(&self) -> Result<(), ConfigError> {
        let bad = |expected| ConfigError { key: "tracker.flip", value: format!("{:?}", self.flip), expected };
        if self.flip.iter().any(|flip| flip.is_angle()) && !self.is_opentrack() {
            return Err(bad("\"x\", \"y\", \"z\"; yaw, pitch and roll alone only with url = \"opentrack://\""));
        }
        if (1..self.flip.len()).any(|number| self.flip[..number].contains(&self.flip[number])) {
            return Err(bad("each direction at most once"));
        }
        match self.scale {
            Some(unit) if self.url == TrackerUrl::Mouse => Err(ConfigError {
                key: "tracker.scale",
                value: unit.to_string(),
                expected: "nothing with url = \"mouse\", which sends no lengths",
            }),
            _ => Ok(()),
        }
    }

    /// Checks every setting.
    ///
    /// # Errors
    /// The first setting that cannot be used.
    pub fn check(&self) -> Result<(), ConfigError> {
        let is_dtrack = matches!(self.url, TrackerUrl::Dtrack { .. });
        if self.inertial && !is_dtrack {
            let expected = "nothing but with DTrack, whose line 6di it reads";
            return Err(ConfigError { key: "tracker.inertial", value: "true".to_owned(), expected });
        }
        if let Some(wand) = &self.wand {
            let has_names = matches!(self.url, TrackerUrl::Vrpn { .. });
            let is_headset = self.url == TrackerUrl::Openxr;
            if is_headset && !matches!(wand.sensor, 1 | 2) {
                let expected = "1, the left hand, or 2, the right one, with url = \"openxr://\"";
                return Err(ConfigError { key: "tracker.wand.sensor", value: wand.sensor.to_string(), expected });
            }
            if !has_names && !is_dtrack && !is_headset {
                let expected = "no wand but with a VRPN server, DTrack or OpenXR";
                return Err(ConfigError { key: "tracker.wand", value: format!("that of {}", self.url), expected });
            }
            wand.check(has_names)?;
        }
        self.check_axes()?;
        self.room_from_tracker.check(&ROOM_FROM_TRACKER)?;
        self.head_from_sensor.check(&HEAD_FROM_SENSOR)?;
        let placements = [(ROOM_FROM_TRACKER, self.room_from_tracker), (HEAD_FROM_SENSOR, self.head_from_sensor)];
        for (keys, placement) in placements {
            if self.url == TrackerUrl::Mouse && placement != AxesPlacement::default() {
                let value = format!("{:?}", placement.position);
                let expected = "nothing with url = \"mouse\", which moves the head itself from `home`";
                return Err(ConfigError { key: keys.position, value, expected });
            }
        }
        if !is_step(self.snap_turn_deg) {
            let expected = "an angle from 0, for no turns in steps, to 180 degrees";
            return Err(ConfigError { key: "tracker.snap_turn_deg", value: self.snap_turn_deg.to_string(), expected });
        }
        self.velocity.check()?;
        positive("tracker.fade_s", self.fade_s)?;
        within("tracker.home", self.home)
    }
}

#[cfg(test)]
#[path = "config_tests.rs"]
mod tests;
