//! Reader of tour files: strict, with the line and the key in every sentence.

use crate::plan::{
    StationRide, TourAnswer, TourEvent, TourPanel, TourPlan, TourQuestion, TourRoute, TourStation, TourText, TourView,
};
use crate::tour_error::TourError;
use glam::DVec3;
use input::VehicleKind;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::ops::RangeInclusive;
use std::path::Path;
use toml::Spanned;

/// Largest file of a tour, bytes.
pub const LARGEST_BYTES: u64 = 1 << 20;
/// Largest numbers of stations, of points of a route, of answers, and of characters in a text.
const MOST_STATIONS: usize = 200;
const MOST_POINTS: usize = 10_000;
const MOST_ANSWERS: usize = 6;
const MOST_CHARACTERS: usize = 2000;
/// Allowed times of a station, seconds; speeds, m/s; rates of thrust, per second; rates of gain, m/s²; and coordinates,
/// metres.
const SECONDS: RangeInclusive<f64> = 0.1..=600.0;
const SPEED: RangeInclusive<f64> = 0.0..=1e9;
const LIGHT: RangeInclusive<f64> = 1e-6..=1e12;
const THRUST: RangeInclusive<f64> = 1e-3..=1e2;
const GAIN: RangeInclusive<f64> = 1e-3..=1e3;
const FARTHEST_M: f64 = 1e9;
/// Largest time between an event and its station, seconds.
const FARTHEST_S: f64 = 1e6;
/// Rate at which a rider gains speed if the tour does not say, m/s².
const USUAL_GAIN_M_S2: f64 = 1.0;

/// Units of speed, longest first where one ends like another, with their metres per second.
const UNITS: [(&str, f64); 4] = [("km/h", 1.0 / 3.6), ("km/s", 1e3), ("m/s", 1.0), ("c", 299_792_458.0)];

type Words = BTreeMap<String, String>;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct PlanTable {
    title: Spanned<Words>,
    scene: Spanned<String>,
    speed_of_light: Option<Spanned<String>>,
    vehicle: Option<Spanned<String>>,
    thrust: Option<Spanned<f64>>,
    gain: Option<Spanned<f64>>,
    start: Option<Spanned<StartTable>>,
    route: Option<Spanned<RouteValue>>,
    recording: Option<Spanned<String>>,
    #[serde(default)]
    station: Vec<Spanned<StationTable>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct StartTable {
    position: [f64; 3],
    look: [f64; 3],
}

#[derive(Deserialize)]
#[serde(untagged, expecting = "expected \"circuit\" or a list of points [x, y, z]")]
enum RouteValue {
    Named(String),
    Points(Vec<[f64; 3]>),
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct StationTable {
    seconds: Spanned<f64>,
    until: Option<Spanned<f64>>,
    speed: Option<Spanned<String>>,
    thrust: Option<Spanned<[i8; 3]>>,
    effects: Option<Spanned<String>>,
    view: Option<Spanned<String>>,
    show: Option<Vec<Spanned<String>>>,
    #[serde(default)]
    event: Vec<Spanned<EventTable>>,
    caption: Option<Spanned<Words>>,
    #[serde(default)]
    pause: bool,
    question: Option<Spanned<QuestionTable>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct EventTable {
    name: Spanned<Words>,
    position: [f64; 3],
    #[serde(default)]
    after: f64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct QuestionTable {
    ask: Spanned<Words>,
    answer: Vec<Spanned<AnswerTable>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct AnswerTable {
    text: Spanned<Words>,
    #[serde(default)]
    right: bool,
    why: Spanned<Words>,
}

/// Reads a tour's file.
///
/// # Errors
/// [`TourError`], with the file, the line and the key.
pub fn read(path: &Path) -> Result<TourPlan, TourError> {
    let name = path.display().to_string();
    let bytes =
        regular_file::read(path, LARGEST_BYTES).map_err(|fault| TourError::File { path: path.to_owned(), fault })?;
    let text = String::from_utf8(bytes).map_err(|_| TourError::NoText { name: name.clone() })?;
    parse(&name, &text)
}

/// Reads a tour's text. `name`: file or name of the tour, for messages.
///
/// # Errors
/// [`TourError::Line`].
pub fn parse(name: &str, text: &str) -> Result<TourPlan, TourError> {
    let source = Source { name, text };
    let table: PlanTable = toml::from_str(text).map_err(|error| {
        let at = error.span().map_or(0, |span| span.start);
        source.fault(at, error.message().trim().to_owned())
    })?;
    source.plan(table)
}

/// Text of a tour, for the lines of its faults.
struct Source<'a> {
    name: &'a str,
    text: &'a str,
}

impl Source<'_> {
    fn fault(&self, at: usize, fault: String) -> TourError {
        let before = self.text.as_bytes().get(..at).unwrap_or_default();
        let line = 1 + before.iter().filter(|&&byte| byte == b'\n').count();
        TourError::Line { name: self.name.to_owned(), line, fault }
    }

    fn plan(&self, table: PlanTable) -> Result<TourPlan, TourError> {
        let vehicle = match &table.vehicle {
            None => VehicleKind::Bicycle,
            Some(named) => match named.get_ref().as_str() {
                "bicycle" => VehicleKind::Bicycle,
                "drive" => VehicleKind::Drive,
                "fly" => VehicleKind::Fly,
                other => return Err(self.named(named, "vehicle", other, "bicycle, drive or fly")),
            },
        };
        let rides = vehicle == VehicleKind::Bicycle && table.recording.is_none();
        if table.station.is_empty() {
            return Err(self.fault(self.text.len(), "it has no station: add a table [[station]]".to_owned()));
        }
        if let Some(beyond) = table.station.get(MOST_STATIONS) {
            let fault = format!("it has more than {MOST_STATIONS} stations: cut it into several tours");
            return Err(self.fault(beyond.span().start, fault));
        }
        let thrusts = |station: &Spanned<StationTable>| Some(station.get_ref().thrust.as_ref()?.span().start);
        if let (Some(_), Some(at)) = (&table.recording, table.station.iter().find_map(thrusts)) {
            return Err(self.fault(at, "the recording rides by itself: take thrust away".to_owned()));
        }
        let mut stations: Vec<TourStation> = Vec::new();
        for station in table.station {
            let before = stations.last().map(|station| station.ride);
            stations.push(self.station(station, rides, before)?);
        }
        Ok(TourPlan {
            title: self.words("title", table.title)?,
            scene: self.plain("scene", table.scene)?,
            speed_of_light_m_s: table
                .speed_of_light
                .map(|text| self.speed("speed_of_light", &text, LIGHT))
                .transpose()?,
            vehicle,
            thrust_per_s: table.thrust.map(|value| self.number("thrust", &value, THRUST)).transpose()?,
            gain_m_s2: table.gain.map_or(Ok(USUAL_GAIN_M_S2), |value| self.number("gain", &value, GAIN))?,
            start: table.start.map(|start| self.start(&start)).transpose()?,
            route: table.route.map_or(Ok(TourRoute::Circuit), |route| self.route(route))?,
            recording: table.recording.map(|text| self.plain("recording", text)).transpose()?,
            stations,
        })
    }

    fn start(&self, start: &Spanned<StartTable>) -> Result<[DVec3; 2], TourError> {
        let StartTable { position, look } = start.get_ref();
        let [position, look] = [*position, *look].map(DVec3::from_array);
        let at = start.span().start;
        self.place(at, "start.position", position)?;
        if look.try_normalize().is_none() {
            return Err(self.fault(at, format!("start.look is {look}: expected a direction, as in [0, 0, -1]")));
        }
        Ok([position, look.normalize()])
    }

    fn place(&self, at: usize, key: &str, place: DVec3) -> Result<(), TourError> {
        if place.is_finite() && place.abs().max_element() <= FARTHEST_M {
            return Ok(());
        }
        Err(self.fault(at, format!("{key} holds {place}: expected three numbers of metres up to {FARTHEST_M:e}")))
    }

    fn route(&self, route: Spanned<RouteValue>) -> Result<TourRoute, TourError> {
        let at = route.span().start;
        match route.into_inner() {
            RouteValue::Named(name) if name == "circuit" => Ok(TourRoute::Circuit),
            RouteValue::Named(name) => {
                Err(self.fault(at, format!("route is \"{name}\": expected \"circuit\" or a list of points [x, y, z]")))
            }
            RouteValue::Points(points) if points.len() > MOST_POINTS => {
                Err(self.fault(at, format!("route has {} points: expected at most {MOST_POINTS}", points.len())))
            }
            RouteValue::Points(points) => {
                let points: Vec<DVec3> = points.into_iter().map(DVec3::from_array).collect();
                points.iter().try_for_each(|point| self.place(at, "route", *point))?;
                Ok(TourRoute::Points(points))
            }
        }
    }

    fn station(
        &self,
        station: Spanned<StationTable>,
        rides: bool,
        before: Option<StationRide>,
    ) -> Result<TourStation, TourError> {
        let at = station.span().start;
        let table = station.into_inner();
        let ride = match (&table.speed, &table.thrust) {
            (Some(_), Some(thrust)) => {
                let fault = "a station has speed or thrust, not both: take one away";
                return Err(self.fault(thrust.span().start, fault.to_owned()));
            }
            (Some(speed), None) if !rides => {
                let fault = "speed is for a bicycle that rides along its route: take it away";
                return Err(self.fault(speed.span().start, fault.to_owned()));
            }
            (Some(speed), None) if speed.get_ref().trim().ends_with('c') => {
                let fault = "speed is road per second of the rider's own time, so that c is no bound of it: \
                             write it in km/h or m/s";
                return Err(self.fault(speed.span().start, fault.to_owned()));
            }
            (Some(speed), None) => StationRide::Along { speed_m_s: self.speed("speed", speed, SPEED)? },
            (None, Some(thrust)) => self.thrust(thrust, rides)?,
            (None, None) if rides => before.unwrap_or(StationRide::Along { speed_m_s: 0.0 }),
            (None, None) => StationRide::Coast,
        };
        let effects = table.effects.map(|text| {
            let parsed = text.get_ref().parse();
            parsed.map_err(|fault| self.fault(text.span().start, format!("effects is \"{}\": {fault}", text.get_ref())))
        });
        let view = table.view.map(|text| match text.get_ref().as_str() {
            "seen" => Ok(TourView::Seen),
            "measured" => Ok(TourView::Measured),
            "instant" => Ok(TourView::Instant),
            other => Err(self.named(&text, "view", other, "seen, measured or instant")),
        });
        let show = table.show.map(|names| {
            let panel = |text: &Spanned<String>| match text.get_ref().as_str() {
                "diagram" => Ok(TourPanel::Diagram),
                "diagram-of-vehicle" => Ok(TourPanel::DiagramOfVehicle),
                "miniature" => Ok(TourPanel::Miniature),
                "clocks" => Ok(TourPanel::Clocks),
                other => Err(self.named(text, "show", other, "diagram, diagram-of-vehicle, miniature or clocks")),
            };
            names.iter().map(panel).collect::<Result<Vec<_>, _>>()
        });
        let until_m = table.until.map(|value| self.number("until", &value, 0.0..=FARTHEST_M));
        if let (Some(_), false) = (&until_m, rides) {
            return Err(self.fault(at, "until is a length along a bicycle's route: take it away".to_owned()));
        }
        Ok(TourStation {
            seconds: self.number("seconds", &table.seconds, SECONDS)?,
            until_m: until_m.transpose()?,
            ride,
            effects: effects.transpose()?,
            view: view.transpose()?,
            show: show.transpose()?,
            events: table.event.into_iter().map(|event| self.event(event)).collect::<Result<_, _>>()?,
            caption: table.caption.map_or(Ok(TourText::default()), |words| self.words("caption", words))?,
            pause: table.pause,
            question: table.question.map(|question| self.question(question)).transpose()?,
        })
    }

    fn event(&self, event: Spanned<EventTable>) -> Result<TourEvent, TourError> {
        let at = event.span().start;
        let EventTable { name, position, after: after_s } = event.into_inner();
        let position = DVec3::from_array(position);
        self.place(at, "position", position)?;
        if !(after_s.is_finite() && after_s.abs() <= FARTHEST_S) {
            let fault = format!("after is {after_s}: expected seconds from −{FARTHEST_S} to {FARTHEST_S}");
            return Err(self.fault(at, fault));
        }
        Ok(TourEvent { name: self.words("name", name)?, position, after_s })
    }

    fn thrust(&self, thrust: &Spanned<[i8; 3]>, rides: bool) -> Result<StationRide, TourError> {
        let at = thrust.span().start;
        if rides {
            let fault = "thrust is for the vehicles drive and fly: set the vehicle, or a speed";
            return Err(self.fault(at, fault.to_owned()));
        }
        let axes = *thrust.get_ref();
        if axes.iter().any(|axis| !(-1..=1).contains(axis)) {
            let fault = format!("thrust is {axes:?}: expected −1, 0 or 1 for right, up and backward, as in [0, 0, -1]");
            return Err(self.fault(at, fault));
        }
        Ok(StationRide::Thrust(axes))
    }

    fn question(&self, question: Spanned<QuestionTable>) -> Result<TourQuestion, TourError> {
        let at = question.span().start;
        let QuestionTable { ask, answer } = question.into_inner();
        let answers = answer.into_iter().map(|answer| {
            let AnswerTable { text, right, why } = answer.into_inner();
            Ok(TourAnswer { text: self.words("text", text)?, right, why: self.words("why", why)? })
        });
        let answers: Vec<TourAnswer> = answers.collect::<Result<_, TourError>>()?;
        let right = answers.iter().filter(|answer| answer.right).count();
        if !(2..=MOST_ANSWERS).contains(&answers.len()) || right != 1 {
            let (count, fault) = (answers.len(), "expected two to six answers, one of them with right = true");
            return Err(self.fault(at, format!("the question has {count} answers, {right} of them right: {fault}")));
        }
        Ok(TourQuestion { ask: self.words("ask", ask)?, answers })
    }

    fn words(&self, key: &str, words: Spanned<Words>) -> Result<TourText, TourError> {
        let at = words.span().start;
        let words = words.into_inner();
        let is_code = |code: &String| code.len() == 2 && code.bytes().all(|byte| byte.is_ascii_lowercase());
        if let Some(code) = words.keys().find(|code| !is_code(code)) {
            let fault = format!("{key} has the language \"{code}\": expected two letters, as in {key}.en = \"…\"");
            return Err(self.fault(at, fault));
        }
        if words.is_empty() || words.values().any(|text| text.trim().is_empty()) {
            return Err(self.fault(at, format!("{key} has no text: give it one, as in {key}.en = \"…\"")));
        }
        match words.values().map(|text| text.chars().count()).find(|&count| count > MOST_CHARACTERS) {
            Some(count) => {
                let fault = format!("{key} has {count} characters: expected at most {MOST_CHARACTERS}");
                Err(self.fault(at, fault))
            }
            None => Ok(TourText(words)),
        }
    }

    fn plain(&self, key: &str, text: Spanned<String>) -> Result<String, TourError> {
        let at = text.span().start;
        let text = text.into_inner();
        if text.trim().is_empty() || text.chars().any(char::is_control) {
            return Err(self.fault(at, format!("{key} is {text:?}: expected a name or a file")));
        }
        Ok(text)
    }

    fn number(&self, key: &str, value: &Spanned<f64>, allowed: RangeInclusive<f64>) -> Result<f64, TourError> {
        let number = *value.get_ref();
        if allowed.contains(&number) {
            return Ok(number);
        }
        let (least, most) = (allowed.start(), allowed.end());
        Err(self.fault(value.span().start, format!("{key} is {number}: expected a number from {least} to {most}")))
    }

    /// Speed in m/s, from a number and a unit.
    fn speed(&self, key: &str, text: &Spanned<String>, allowed: RangeInclusive<f64>) -> Result<f64, TourError> {
        let written = text.get_ref().trim();
        let unit = UNITS.iter().find_map(|(unit, factor)| Some((written.strip_suffix(unit)?, factor)));
        let parsed = unit.and_then(|(number, factor)| Some(number.trim().parse::<f64>().ok()? * factor));
        parsed.filter(|speed| allowed.contains(speed)).ok_or_else(|| {
            let fault =
                format!("{key} is \"{written}\": expected a number and m/s, km/h, km/s or c, as in \"30 km/h\"");
            self.fault(text.span().start, fault)
        })
    }

    fn named(&self, text: &Spanned<String>, key: &str, got: &str, expected: &str) -> TourError {
        self.fault(text.span().start, format!("{key} is \"{got}\": expected {expected}"))
    }
}
