//! Plan of a tour: its world, its route, and its stations with what they show and say.

use glam::DVec3;
use input::{DeskConfig, VehicleKind};
use ride::{LightSpeed, Nose, RideStart, Setup, VehicleSettings};
use scene::Start;
use std::collections::BTreeMap;
use view::{Effects, Places};

/// Text in several languages, by their two-letter codes.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct TourText(pub BTreeMap<String, String>);

impl TourText {
    /// Text in a language, else in English, else in any; empty if there is none.
    pub fn in_language(&self, code: &str) -> &str {
        let text = self.0.get(code).or_else(|| self.0.get("en")).or_else(|| self.0.values().next());
        text.map_or("", String::as_str)
    }
}

/// View of the world that a station shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum TourView {
    /// Things where their light comes from.
    #[default]
    Seen,
    /// Things where they are now in the observer's frame.
    Measured,
    /// Things where they are now in the world's frame.
    Instant,
}

impl TourView {
    /// Places that the view shows.
    pub fn places(self) -> Places {
        match self {
            Self::Seen => Places::Seen,
            Self::Measured => Places::Measured,
            Self::Instant => Places::Instant,
        }
    }
}

/// Instrument that a station shows beside the picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum TourPanel {
    /// Minkowski diagram of the ride, in the world's frame.
    Diagram,
    /// Minkowski diagram of the ride, in the vehicle's frame.
    DiagramOfVehicle,
    /// Plan of the world with the vehicle.
    Miniature,
    /// Readings of the scene's clocks, and the rider's own.
    Clocks,
}

/// Motion during a station.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StationRide {
    /// Ride along the tour's route at a top speed, m/s of road per second of the rider's own time; 0 stops.
    Along {
        /// Top speed, m/s.
        speed_m_s: f64,
    },
    /// Thrust in the pilot's axes, each −1, 0 or 1: right, up, backward.
    Thrust([i8; 3]),
    /// Motion without thrust.
    Coast,
}

/// Answer to a question.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TourAnswer {
    /// Answer itself.
    pub text: TourText,
    /// True if it is right.
    pub right: bool,
    /// Explanation that follows this answer.
    pub why: TourText,
}

/// Question at the end of a station; the tour waits for an answer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TourQuestion {
    /// Question itself.
    pub ask: TourText,
    /// Answers to choose from, at least two, one of them right.
    pub answers: Vec<TourAnswer>,
}

/// Station: a piece of the ride with what is shown and said meanwhile.
#[derive(Clone, Debug, PartialEq)]
pub struct TourStation {
    /// Longest time of the station, seconds of the rider's own time.
    pub seconds: f64,
    /// Length along the route at which the station ends, metres, if it does so before its time.
    pub until_m: Option<f64>,
    /// Motion.
    pub ride: StationRide,
    /// Effects from here on; `None` leaves them as they are.
    pub effects: Option<Effects>,
    /// View from here on; `None` leaves it as it is.
    pub view: Option<TourView>,
    /// Instruments from here on; `None` leaves them as they are.
    pub show: Option<Vec<TourPanel>>,
    /// Events that the diagram marks from here on.
    pub events: Vec<TourEvent>,
    /// Caption; empty for none.
    pub caption: TourText,
    /// True if the tour stops at the end of the station until the visitor goes on.
    pub pause: bool,
    /// Question at the end of the station.
    pub question: Option<TourQuestion>,
}

/// Event that the diagram marks.
#[derive(Clone, Debug, PartialEq)]
pub struct TourEvent {
    /// Name in the diagram.
    pub name: TourText,
    /// Place, world metres.
    pub position: DVec3,
    /// World time since the beginning of its station, seconds.
    pub after_s: f64,
}

/// Route of a tour on the ground.
#[derive(Clone, Debug, PartialEq)]
pub enum TourRoute {
    /// Scene's own closed circuit, from its start.
    Circuit,
    /// Open polyline of points, world metres.
    Points(Vec<DVec3>),
}

/// Plan of a tour.
#[derive(Clone, Debug, PartialEq)]
pub struct TourPlan {
    /// Title.
    pub title: TourText,
    /// Name of the scene, as `--scene` takes it; a file's is relative to the tour's own file.
    pub scene: String,
    /// Speed of light, m/s; `None` for the scene's own.
    pub speed_of_light_m_s: Option<f64>,
    /// Vehicle.
    pub vehicle: VehicleKind,
    /// Rapidity that full thrust gains in a second of own time; `None` for the usual.
    pub thrust_per_s: Option<f64>,
    /// Rate at which the rider of a bicycle gains speed, m/s².
    pub gain_m_s2: f64,
    /// Place and view at the start; `None` for the scene's own start.
    pub start: Option<[DVec3; 2]>,
    /// Route of a bicycle.
    pub route: TourRoute,
    /// Recording that is shown instead of a ride, relative to the tour's own file.
    pub recording: Option<String>,
    /// Stations in order, at least one.
    pub stations: Vec<TourStation>,
}

impl TourPlan {
    /// Longest time of the tour without its pauses, seconds of the rider's own time.
    pub fn longest_s(&self) -> f64 {
        self.stations.iter().map(|station| station.seconds).sum()
    }

    /// Setup of the tour's ride in a scene with this start and this speed of light; `desk` says how samples are
    /// decoded.
    pub fn setup(&self, start: &Start, light_speed: LightSpeed, desk: DeskConfig) -> Setup {
        let on_ground = start.position;
        let [position, look] = self.start.unwrap_or([on_ground, start.look]);
        let mut vehicle = VehicleSettings::default();
        vehicle.flight.nose = Nose::Gyroscopic;
        if let Some(thrust_per_s) = self.thrust_per_s {
            vehicle.flight.thrust_per_s = thrust_per_s;
        }
        // A pilot's reference point is the eye.
        let eye = if self.start.is_none() && self.vehicle == VehicleKind::Fly { start.eye() } else { position };
        Setup { light_speed, kind: self.vehicle, start: RideStart::at_rest(eye, look, DVec3::Y), vehicle, desk }
    }
}
