//! Actions: commands that take effect once, at a press.
//!
//! Buttons of any device and the program's own panels end in the same list. A panel sends a small JSON text
//! (`"step"`, `{"time_scale":0.5}`), which passes through the recording like any other device's bytes.

use serde::{Deserialize, Serialize};

use crate::head::snap_step::is_step;
use crate::head::stance::Stance;
use crate::head::tracking_mode::TrackingMode;

/// Vehicle that the controls drive.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum VehicleKind {
    /// Bicycle: wheel speed, handlebar and brake (B 5.6.1).
    #[default]
    Bicycle,
    /// Thrust in the horizontal plane.
    Drive,
    /// Thrust in three directions, and roll.
    Fly,
}

/// Setting whose values have texts, those of the command line's option of the same name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Setting {
    /// Effects of relativity on the picture.
    Effects,
    /// Vertical field of view of a flat picture, degrees.
    Fov,
    /// Brightness of the picture.
    Exposure,
    /// Curve from radiance to the screen's brightness.
    Tone,
    /// Treatment of colours that the screen cannot show.
    Gamut,
    /// Order of transforming and drawing within a frame.
    Latency,
    /// Method of drawing, and its dial.
    Renderer,
    /// Language of the interface.
    Language,
    /// Value that the colours of the view from outside show.
    Colouring,
    /// Darkening of the edges of a headset's pictures with motion that is not felt.
    Vignette,
    /// One of three views: seen, measured, instant. The switches of the light stay as they are.
    View,
}

/// Part of the picture or of the interface that is on or off.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Switch {
    /// Apparent places instead of the present ones.
    Geometry,
    /// Doppler shift.
    Doppler,
    /// Searchlight effect.
    Searchlight,
    /// View from outside onto what is seen.
    Outside,
    /// View from outside onto what was seen at the moment of the switch.
    Frozen,
    /// Head-up display.
    Readings,
    /// Menu.
    Menu,
    /// Plan of the world.
    Miniature,
    /// Minkowski diagram of the ride.
    Diagram,
    /// Diagram in the vehicle's frame instead of the world's.
    DiagramOfVehicle,
    /// Readings of the scene's clocks.
    Clocks,
    /// Planner, which says when to turn round.
    Planner,
    /// Lines of the vehicle about the rider, in a headset or a room.
    Cockpit,
}

/// Direction in which the focus of a menu moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum FocusStep {
    /// To the left.
    Left,
    /// To the right.
    Right,
    /// Upward.
    Up,
    /// Downward.
    Down,
}

/// Command that takes effect once.
///
/// Every wish of a rider is one, whichever key, button, pointer or panel it comes from, and is recorded.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Action {
    /// Stops the clock, or lets it run. The head still looks and walks meanwhile.
    TogglePause,
    /// Stops the clock if true, lets it run if false.
    Hold(bool),
    /// Advances by one step while paused.
    Step,
    /// Proper time per real time; finite, not negative.
    TimeScale(f64),
    /// Factor on the time scale; finite, positive.
    ScaleTime(f64),
    /// Speed of light in the world, m/s; finite, positive.
    SpeedOfLight(f64),
    /// Thrust of a rider who is nobody, as on a tour, from now on: right, up, backward, each from −1 to 1. That of
    /// devices is added to it.
    Thrust([f64; 3]),
    /// Change of the vehicle.
    Vehicle(VehicleKind),
    /// Look along the nose again.
    LookAhead,
    /// Makes the present pose of a tracked head the straight one.
    Recentre,
    /// Use of the tracked head.
    Tracking(TrackingMode),
    /// The next use of the tracked head: place and velocity, place alone, none.
    NextTracking,
    /// Stance of a rider in a headset; the present pose is the straight one of that stance.
    Stance(Stance),
    /// Step of the turn that a flick of the other hand's stick makes, degrees, 0 to 180; 0 for none.
    SnapTurn(f64),
    /// Return to the start.
    Restart,
    /// Place of the world to be at rest at.
    Jump(Place),
    /// Scene to ride in, by its name or file. The ride ends, and another begins there.
    Scene(String),
    /// Tour to go on, by its name or file. The ride ends, and the tour begins.
    Tour(String),
    /// Value of a setting, as on the command line.
    Set(Setting, String),
    /// The next value of a setting that has a few.
    Next(Setting),
    /// A switch, turned.
    Toggle(Switch),
    /// A switch, turned on or off.
    Turn(Switch, bool),
    /// The next of three views: seen, measured, instant.
    NextView,
    /// Stops by which the picture becomes brighter; finite.
    Expose(f64),
    /// Request for a picture.
    Photo,
    /// Request for a picture of all directions.
    PhotoSphere,
    /// Starts or stops recording.
    ToggleRecording,
    /// Shows or hides the help.
    ToggleHelp,
    /// Focus of the menu, moved by one control.
    Focus(FocusStep),
    /// Chooses what the pointer shows, or where nothing is to be chosen, goes on with a tour or stops it.
    Choose,
    /// Goes on with a tour, or stops it.
    GoOn,
    /// Camera of the view from outside, led about the eye.
    Orbit {
        /// Turns to the right and up, radians.
        turn_rad: [f64; 2],
        /// Factor by which it comes closer.
        closer: f64,
    },
    /// Answer to a tour's question, by its number from 0.
    Answer(u8),
    /// Fills the monitors, or leaves them.
    ToggleFullScreen,
    /// Shows or hides the test grids of a room.
    ToggleCalibration,
    /// End of the ride.
    Leave,
}

/// Place and direction in the world.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Place {
    /// Point on the ground, or the eye where there is none, world axes, metres.
    pub position_m: [f64; 3],
    /// Direction of the nose, world axes, of any length but zero.
    pub look: [f64; 3],
}

impl Place {
    /// Largest coordinate, metres.
    const FARTHEST_M: f64 = 1e12;

    fn is_sound(&self) -> bool {
        let within = |vector: &[f64; 3]| vector.iter().all(|part| part.abs() <= Self::FARTHEST_M);
        within(&self.position_m) && within(&self.look) && self.look.iter().any(|part| part.abs() > 1e-9)
    }
}

/// Most bytes of a text in an action.
const LONGEST_TEXT: usize = 4096;

impl Action {
    /// JSON text of the action, as the settings' decoder reads it.
    pub fn to_bytes(&self) -> Box<[u8]> {
        serde_json::to_vec(self).expect("an action is always representable as JSON").into_boxed_slice()
    }

    /// Action of a text as in a table of keys: its JSON, or its bare name.
    pub fn named(text: &str) -> Option<Self> {
        let bare = || serde_json::from_value(serde_json::Value::String(text.to_owned()));
        serde_json::from_str(text).or_else(|_| bare()).ok().filter(Self::is_sound)
    }

    /// True if the numbers and texts of the action are in their ranges.
    pub(crate) fn is_sound(&self) -> bool {
        match self {
            Self::TimeScale(scale) => scale.is_finite() && *scale >= 0.0,
            Self::ScaleTime(factor) | Self::SpeedOfLight(factor) => factor.is_finite() && *factor > 0.0,
            Self::Thrust(axes) => axes.iter().all(|axis| (-1.0..=1.0).contains(axis)),
            Self::Expose(stops) => stops.is_finite(),
            Self::SnapTurn(degrees) => is_step(*degrees),
            Self::Orbit { turn_rad, closer } => {
                turn_rad.iter().all(|turn| turn.is_finite()) && closer.is_finite() && *closer > 0.0
            }
            Self::Jump(place) => place.is_sound(),
            Self::Scene(text) | Self::Tour(text) | Self::Set(_, text) => text.len() <= LONGEST_TEXT,
            _ => true,
        }
    }
}
