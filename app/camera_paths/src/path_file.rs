//! Reader of path files: strict, with the line and the key in every sentence.

use crate::error::CameraPathError;
use crate::keys::KeyTime;
use crate::part_plan::{
    CoursePlan, MOST_RAPIDITY, PartPlan, PlannedCircle, PlannedKey, PlannedLeg, PlannedPush, PlannedStart, PlannedView,
};
use crate::speed_text::SpeedText;
use glam::DVec3;
use physics::Celerity;
use serde::Deserialize;
use std::f64::consts::TAU;
use std::ops::RangeInclusive;
use std::path::Path;
use toml::Spanned;

/// Largest file of a path, bytes.
const LARGEST_BYTES: u64 = 16 << 20;
/// Largest numbers of parts, and of keys or legs of a part.
const MOST_PARTS: usize = 1000;
const MOST_KEYS: usize = 100_000;
/// Allowed coordinates, metres; times of keys, seconds; lengths of a leg, and of all of a part, seconds of own time;
/// radii, metres; periods, seconds; turns; fields of view, degrees; and thrusts, c per second.
const FARTHEST_M: f64 = 1e15;
const LATEST_S: f64 = 1e9;
const LEG_S: RangeInclusive<f64> = 1e-6..=36_000.0;
const LONGEST_LEGS_S: f64 = 36_000.0;
const RADIUS_M: RangeInclusive<f64> = 1e-6..=1e15;
const PERIOD_S: RangeInclusive<f64> = 1e-9..=1e12;
const TURNS: RangeInclusive<f64> = 1e-6..=1e6;
const FOV_DEG: RangeInclusive<f64> = 1.0..=170.0;
const FASTEST_THRUST: f64 = 100.0;

/// File of a path that has been read and not yet met its scenes.
#[derive(Clone, Debug)]
pub struct PathFile {
    /// Name for messages.
    pub(crate) name: String,
    pub(crate) parts: Vec<PartPlan>,
}

/// Scene of a part of a path, and the speed of light in it.
#[derive(Clone, Debug, PartialEq)]
pub struct PathScene {
    /// Scene, as on the command line; `None` where the path names none.
    pub scene: Option<String>,
    /// Speed of light, m/s; `None` where the path names none.
    pub speed_of_light_m_s: Option<f64>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct PathPartsTable {
    part: Vec<Spanned<PathPartTable>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct PathPartTable {
    scene: Option<String>,
    speed_of_light: Option<Spanned<SpeedText>>,
    time: Option<Spanned<String>>,
    watch: Option<Spanned<[f64; 3]>>,
    #[serde(default)]
    key: Vec<Spanned<KeyTable>>,
    start: Option<Spanned<PathStartTable>>,
    #[serde(default)]
    leg: Vec<Spanned<LegTable>>,
    circle: Option<Spanned<CircleTable>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct KeyTable {
    at: f64,
    position: [f64; 3],
    look: Option<[f64; 3]>,
    up: Option<[f64; 3]>,
    fov: Option<f64>,
    #[serde(default)]
    stop: bool,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct PathStartTable {
    position: [f64; 3],
    #[serde(default)]
    celerity: [f64; 3],
    look: Option<[f64; 3]>,
    up: Option<[f64; 3]>,
    fov: Option<f64>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct LegTable {
    seconds: f64,
    acceleration: Option<[f64; 3]>,
    thrust: Option<[f64; 3]>,
    look: Option<[f64; 3]>,
    up: Option<[f64; 3]>,
    fov: Option<f64>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct CircleTable {
    centre: [f64; 3],
    radius: f64,
    normal: Option<[f64; 3]>,
    from: Option<[f64; 3]>,
    speed: Option<SpeedText>,
    period: Option<f64>,
    turns: Option<f64>,
    look: Option<[f64; 3]>,
    up: Option<[f64; 3]>,
    fov: Option<f64>,
}

impl PathFile {
    /// Reads a path's file.
    ///
    /// # Errors
    /// [`CameraPathError`], with the file, the line and the key.
    pub fn read(path: &Path) -> Result<Self, CameraPathError> {
        let name = path.display().to_string();
        let bytes = regular_file::read(path, LARGEST_BYTES)
            .map_err(|fault| CameraPathError::File { path: path.to_owned(), fault })?;
        let text = String::from_utf8(bytes).map_err(|_| CameraPathError::NoText { name: name.clone() })?;
        Self::parse(&name, &text)
    }

    /// Reads a path's text. `name`: file of the path, for messages.
    ///
    /// # Errors
    /// [`CameraPathError::Line`].
    pub fn parse(name: &str, text: &str) -> Result<Self, CameraPathError> {
        let source = PathText { name, text };
        let table: toml::Table = source.table()?;
        let parts = if table.contains_key("part") {
            source.table::<PathPartsTable>()?.part
        } else {
            vec![Spanned::new(0..0, source.table::<PathPartTable>()?)]
        };
        if parts.is_empty() || parts.len() > MOST_PARTS {
            return Err(source.fault(0, format!("it has {} parts; expected 1 to {MOST_PARTS}", parts.len())));
        }
        let parts = parts.into_iter().enumerate();
        let parts = parts.map(|(number, part)| source.part(number, part)).collect::<Result<_, _>>()?;
        Ok(Self { name: name.to_owned(), parts })
    }

    /// Scenes of the parts, in their order, as the file names them. A part that names neither a scene nor a speed of
    /// light has those of the part before.
    pub fn scenes(&self) -> Vec<PathScene> {
        let mut scenes: Vec<PathScene> = Vec::with_capacity(self.parts.len());
        for part in &self.parts {
            let own = PathScene { scene: part.scene.clone(), speed_of_light_m_s: part.light_m_s };
            let before = scenes.last().cloned();
            let scene = match before {
                Some(before) if own.scene.is_none() => PathScene {
                    scene: before.scene,
                    speed_of_light_m_s: own.speed_of_light_m_s.or(before.speed_of_light_m_s),
                },
                _ => own,
            };
            scenes.push(scene);
        }
        scenes
    }
}

/// Text of a path, for the lines of its faults.
struct PathText<'a> {
    name: &'a str,
    text: &'a str,
}

impl PathText<'_> {
    fn fault(&self, at: usize, fault: String) -> CameraPathError {
        let before = self.text.as_bytes().get(..at).unwrap_or_default();
        let line = 1 + before.iter().filter(|&&byte| byte == b'\n').count();
        CameraPathError::Line { name: self.name.to_owned(), line, fault }
    }

    fn table<T: for<'a> Deserialize<'a>>(&self) -> Result<T, CameraPathError> {
        toml::from_str(self.text).map_err(|error| {
            let at = error.span().map_or(0, |span| span.start);
            self.fault(at, error.message().trim().to_owned())
        })
    }

    fn part(&self, number: usize, part: Spanned<PathPartTable>) -> Result<PartPlan, CameraPathError> {
        let at = part.span().start;
        let part = part.into_inner();
        let fault = |what: &str| Err(self.fault(at, format!("part {}: {what}", number + 1)));
        let courses = [!part.key.is_empty(), !part.leg.is_empty(), part.circle.is_some()];
        match courses.into_iter().filter(|given| *given).count() {
            1 => {}
            0 => return fault("it has no way; give it two or more [[key]], a [[leg]] or a [circle]"),
            _ => return fault("it has keys, legs or a circle at once; give each its own [[part]]"),
        }
        if part.start.is_some() && part.leg.is_empty() {
            return fault("start belongs to legs; give it a [[leg]]");
        }
        if part.time.is_some() && part.key.is_empty() {
            return fault("time belongs to keys; leave it out");
        }
        let light = part.speed_of_light.map(|light| {
            let at = light.span().start;
            let speed = light.get_ref().metres_per_second();
            speed.map_err(|fault| self.fault(at, format!("speed_of_light: {fault}")))
        });
        let watch = part.watch.map(|watch| {
            let at = watch.span().start;
            self.point(at, "watch", watch.into_inner()).map(|point| point.to_array())
        });
        let (scene, light_m_s, watch) = (part.scene, light.transpose()?, watch.transpose()?);
        let goes_on = number > 0 && scene.is_none() && light_m_s.is_none();
        let course = if let Some(circle) = part.circle {
            let at = circle.span().start;
            CoursePlan::Circle(self.circle(at, circle.into_inner())?)
        } else if part.key.is_empty() {
            if part.start.is_none() && !goes_on {
                return fault("its legs begin nowhere; give it a [start] with a position");
            }
            let start = part.start.map(|start| self.start(start)).transpose()?;
            CoursePlan::Legs { start, legs: self.legs(part.leg)? }
        } else {
            let time = part.time.map_or(Ok(KeyTime::Own), |time| match time.get_ref().as_str() {
                "own" => Ok(KeyTime::Own),
                "world" => Ok(KeyTime::World),
                other => {
                    Err(self.fault(time.span().start, format!("time is \"{other}\"; expected \"own\" or \"world\"")))
                }
            })?;
            if part.key.len() < 2 {
                return fault("it has one key; give it two at least");
            }
            CoursePlan::Keys { time, keys: self.keys(part.key)? }
        };
        Ok(PartPlan { scene, light_m_s, watch, course })
    }

    fn keys(&self, keys: Vec<Spanned<KeyTable>>) -> Result<Vec<PlannedKey>, CameraPathError> {
        if keys.len() > MOST_KEYS {
            return Err(self.fault(0, format!("it has {} keys; at most {MOST_KEYS} are read", keys.len())));
        }
        let mut planned: Vec<PlannedKey> = Vec::with_capacity(keys.len());
        for (number, key) in keys.into_iter().enumerate() {
            let at = key.span().start;
            let KeyTable { at: at_s, position, look, up, fov, stop } = key.into_inner();
            let which = format!("key {}", number + 1);
            if at_s.is_nan() || at_s.abs() > LATEST_S {
                return Err(self.fault(at, format!("{which}: at is {at_s}; expected seconds")));
            }
            if let Some(before) = planned.last().filter(|before| before.at_s >= at_s) {
                let order =
                    format!("{which}: at is {at_s}, and the key before is at {}; put the keys in order", before.at_s);
                return Err(self.fault(at, order));
            }
            let position = self.point(at, &format!("{which}: position"), position)?;
            let view = self.view(at, &which, look, up, fov)?;
            planned.push(PlannedKey { at_s, position, stop, view });
        }
        Ok(planned)
    }

    fn start(&self, start: Spanned<PathStartTable>) -> Result<PlannedStart, CameraPathError> {
        let at = start.span().start;
        let PathStartTable { position, celerity, look, up, fov } = start.into_inner();
        let position = self.point(at, "start: position", position)?;
        let celerity = Celerity::new(DVec3::from_array(celerity)).ok();
        let celerity = celerity.filter(|celerity| celerity.rapidity() <= MOST_RAPIDITY).ok_or_else(|| {
            self.fault(at, format!("start: celerity has to be finite, with a rapidity of at most {MOST_RAPIDITY}"))
        })?;
        Ok(PlannedStart { position, celerity, view: self.view(at, "start", look, up, fov)? })
    }

    fn legs(&self, legs: Vec<Spanned<LegTable>>) -> Result<Vec<PlannedLeg>, CameraPathError> {
        let mut all_s = 0.0;
        let mut planned = Vec::with_capacity(legs.len());
        for (number, leg) in legs.into_iter().enumerate() {
            let at = leg.span().start;
            let LegTable { seconds, acceleration, thrust, look, up, fov } = leg.into_inner();
            let which = format!("leg {}", number + 1);
            self.within(at, &format!("{which}: seconds"), seconds, LEG_S)?;
            all_s += seconds;
            if all_s > LONGEST_LEGS_S {
                return Err(
                    self.fault(at, format!("{which}: the legs take more than {LONGEST_LEGS_S} s; make them shorter"))
                );
            }
            let push = match (acceleration, thrust) {
                (Some(_), Some(_)) => {
                    return Err(
                        self.fault(at, format!("{which}: it has an acceleration and a thrust; give one of them"))
                    );
                }
                (Some(acceleration), None) => {
                    PlannedPush::MetresPerSecond2(self.point(at, &format!("{which}: acceleration"), acceleration)?)
                }
                (None, thrust) => {
                    let thrust = self.point(at, &format!("{which}: thrust"), thrust.unwrap_or_default())?;
                    self.within(at, &format!("{which}: thrust"), thrust.length(), 0.0..=FASTEST_THRUST)?;
                    PlannedPush::LightPerSecond(thrust)
                }
            };
            planned.push(PlannedLeg { seconds, push, view: self.view(at, &which, look, up, fov)? });
        }
        Ok(planned)
    }

    fn circle(&self, at: usize, circle: CircleTable) -> Result<PlannedCircle, CameraPathError> {
        let CircleTable { centre, radius, normal, from, speed, period, turns, look, up, fov } = circle;
        let centre = self.point(at, "circle: centre", centre)?;
        self.within(at, "circle: radius", radius, RADIUS_M)?;
        let normal = self.direction(at, "circle: normal", normal)?.unwrap_or(DVec3::Y);
        let turns = turns.unwrap_or(1.0);
        self.within(at, "circle: turns", turns, TURNS)?;
        let speed_m_s = match (speed, period) {
            (Some(speed), None) => {
                speed.metres_per_second().map_err(|fault| self.fault(at, format!("circle: speed: {fault}")))?
            }
            (None, Some(period)) => {
                self.within(at, "circle: period", period, PERIOD_S)?;
                TAU * radius / period
            }
            _ => return Err(self.fault(at, "circle: give it either a speed or a period".to_owned())),
        };
        let from = match self.direction(at, "circle: from", from)? {
            None => normal.any_orthonormal_vector(),
            Some(from) => from.reject_from_normalized(normal).try_normalize().ok_or_else(|| {
                self.fault(at, "circle: from is along the normal; give it another direction".to_owned())
            })?,
        };
        let view = self.view(at, "circle", look, up, fov)?;
        Ok(PlannedCircle { centre, radius_m: radius, normal, from, speed_m_s, turns, view })
    }

    fn view(
        &self,
        at: usize,
        which: &str,
        look: Option<[f64; 3]>,
        up: Option<[f64; 3]>,
        fov_deg: Option<f64>,
    ) -> Result<PlannedView, CameraPathError> {
        self.direction(at, &format!("{which}: look"), look)?;
        self.direction(at, &format!("{which}: up"), up)?;
        if up.is_some() && look.is_none() {
            return Err(self.fault(at, format!("{which}: it has an up without a look; give it both")));
        }
        if let Some(fov) = fov_deg {
            self.within(at, &format!("{which}: fov"), fov, FOV_DEG)?;
        }
        Ok(PlannedView { look, up, fov_deg })
    }

    fn within(&self, at: usize, what: &str, value: f64, range: RangeInclusive<f64>) -> Result<(), CameraPathError> {
        if range.contains(&value) {
            return Ok(());
        }
        Err(self.fault(at, format!("{what} is {value}; expected a number from {} to {}", range.start(), range.end())))
    }

    fn point(&self, at: usize, what: &str, point: [f64; 3]) -> Result<DVec3, CameraPathError> {
        let point = DVec3::from_array(point);
        // Not a number is not within.
        if point.to_array().iter().all(|coordinate| coordinate.abs() <= FARTHEST_M) {
            return Ok(point);
        }
        Err(self.fault(at, format!("{what} is {point}; expected three numbers, none beyond {FARTHEST_M:e}")))
    }

    fn direction(&self, at: usize, what: &str, direction: Option<[f64; 3]>) -> Result<Option<DVec3>, CameraPathError> {
        let Some(given) = direction else { return Ok(None) };
        let unit = self.point(at, what, given)?.try_normalize();
        unit.map(Some).ok_or_else(|| self.fault(at, format!("{what} has no length; expected a direction")))
    }
}
