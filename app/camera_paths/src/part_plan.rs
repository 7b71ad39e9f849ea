//! Plan of one part of a path: what its file says, checked, before a speed of light makes a course of it.

use crate::circle::CircleCourse;
use crate::course::PathCourse;
use crate::course_moment::CourseMoment;
use crate::error::CameraPathError;
use crate::eye::EyeKeys;
use crate::keys::{KeyCourse, KeyTime};
use crate::legs::{LegCourse, ThrustLeg};
use crate::place_spline::PlaceSpline;
use glam::{DQuat, DVec3};
use physics::Celerity;
use physics::worldline::WorldlineState;

/// Largest rapidity of a course: that of the vehicles.
pub(crate) const MOST_RAPIDITY: f64 = 27.0;

/// Plan of one part.
#[derive(Clone, Debug)]
pub(crate) struct PartPlan {
    /// Scene of the part; `None` for that of the part before, or the usual one.
    pub(crate) scene: Option<String>,
    /// Speed of light, m/s; `None` for that of the part before, or the usual one.
    pub(crate) light_m_s: Option<f64>,
    /// Point of the world that is looked at where no direction is given.
    pub(crate) watch: Option<[f64; 3]>,
    pub(crate) course: CoursePlan,
}

/// Plan of a course.
#[derive(Clone, Debug)]
pub(crate) enum CoursePlan {
    /// Keys over a time.
    Keys { time: KeyTime, keys: Vec<PlannedKey> },
    /// Legs of thrust, from a start or from the end of the part before.
    Legs { start: Option<PlannedStart>, legs: Vec<PlannedLeg> },
    /// Circle.
    Circle(PlannedCircle),
}

/// What is seen from a place of a course.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct PlannedView {
    pub(crate) look: Option<[f64; 3]>,
    pub(crate) up: Option<[f64; 3]>,
    pub(crate) fov_deg: Option<f64>,
}

/// Key of a course.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PlannedKey {
    pub(crate) at_s: f64,
    pub(crate) position: DVec3,
    pub(crate) stop: bool,
    pub(crate) view: PlannedView,
}

/// Start of legs.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PlannedStart {
    pub(crate) position: DVec3,
    pub(crate) celerity: Celerity,
    pub(crate) view: PlannedView,
}

/// Leg of thrust, and what is seen at its end.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PlannedLeg {
    pub(crate) seconds: f64,
    pub(crate) push: PlannedPush,
    pub(crate) view: PlannedView,
}

/// Proper acceleration, observer's axes.
#[derive(Clone, Copy, Debug)]
pub(crate) enum PlannedPush {
    /// Metres per second².
    MetresPerSecond2(DVec3),
    /// Units of c per second.
    LightPerSecond(DVec3),
}

/// Circle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PlannedCircle {
    pub(crate) centre: DVec3,
    pub(crate) radius_m: f64,
    /// Axis of the turn, right-handed, of length 1.
    pub(crate) normal: DVec3,
    /// Direction from the centre to the beginning, of length 1, at a right angle to the axis.
    pub(crate) from: DVec3,
    pub(crate) speed_m_s: f64,
    pub(crate) turns: f64,
    pub(crate) view: PlannedView,
}

/// Part before, whose end a part may go on from.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PartBefore {
    /// Moment of its end.
    pub(crate) end: CourseMoment,
}

impl PlannedView {
    fn add_to(&self, keys: &mut EyeKeys, time: f64) {
        keys.add(time, self.look, self.up, self.fov_deg);
    }
}

impl PartPlan {
    /// True if the part goes on in the scene of the part before, and in its time.
    pub(crate) fn goes_on(&self) -> bool {
        self.scene.is_none() && self.light_m_s.is_none()
    }

    /// Course of the part where light has the speed `light_m_s`. `before`: part that it goes on from. `name` and
    /// `part`: file, and part in words, for messages.
    pub(crate) fn course(
        &self,
        light_m_s: f64,
        before: Option<PartBefore>,
        (name, part): (&str, &str),
    ) -> Result<PathCourse, CameraPathError> {
        let went_on_s = before.map(|before| before.end.observer.event.ct / light_m_s);
        let too_fast = |place: String, speed_m_s| CameraPathError::TooFast {
            name: name.to_owned(),
            place: format!("{part}{place}"),
            speed_m_s,
            light_m_s,
        };
        match &self.course {
            CoursePlan::Keys { time, keys } => {
                let mut seen = EyeKeys::default();
                keys.iter().for_each(|key| key.view.add_to(&mut seen, key.at_s));
                let stops: Vec<bool> = keys.iter().map(|key| key.stop).collect();
                let (times, places) = keys.iter().map(|key| (key.at_s, key.position)).unzip();
                let spline = PlaceSpline::new(times, places, &stops);
                let of_keys_s = if *time == KeyTime::World { keys[0].at_s } else { 0.0 };
                let begins_s = went_on_s.unwrap_or(of_keys_s);
                let course = KeyCourse::new(spline, *time, seen.eye(self.watch), light_m_s, begins_s);
                let between = |key| format!("between key {} and key {}", key + 1, key + 2);
                let course = course.map_err(|(key, speed)| too_fast(between(key), speed))?;
                Ok(PathCourse::Keys(Box::new(course)))
            }
            CoursePlan::Legs { start, legs } => {
                let mut seen = EyeKeys::default();
                let state = begin_legs(start.as_ref(), before, went_on_s.unwrap_or(0.0) * light_m_s);
                if let Some(start) = start {
                    start.view.add_to(&mut seen, 0.0);
                }
                let mut end_s = 0.0;
                for leg in legs {
                    end_s += leg.seconds;
                    leg.view.add_to(&mut seen, end_s);
                }
                // Without a word of the beginning, the look turns from that of the part before.
                if let Some(before) = before.filter(|_| seen.turns.first().is_some_and(|(time, _)| *time > 0.0)) {
                    seen.turns.insert(0, (0.0, before.end.turn));
                }
                let legs: Vec<ThrustLeg> = legs.iter().map(|leg| leg.of_light(light_m_s)).collect();
                let course = LegCourse::new(state, &legs, seen.eye(self.watch), light_m_s, MOST_RAPIDITY);
                let course = course.map_err(|(leg, rapidity)| CameraPathError::Rapidity {
                    name: name.to_owned(),
                    place: format!("{part}leg {}", leg + 1),
                    rapidity,
                    most: MOST_RAPIDITY,
                })?;
                Ok(PathCourse::Legs(Box::new(course)))
            }
            CoursePlan::Circle(circle) => {
                if circle.speed_m_s >= light_m_s {
                    return Err(too_fast("on the circle".to_owned(), circle.speed_m_s));
                }
                let mut seen = EyeKeys::default();
                circle.view.add_to(&mut seen, 0.0);
                let radius = circle.from * circle.radius_m;
                Ok(PathCourse::Circle(Box::new(CircleCourse {
                    centre: circle.centre,
                    axes: [radius, circle.normal.cross(radius)],
                    speed_m_s: circle.speed_m_s,
                    turns: circle.turns,
                    eye: seen.eye(self.watch),
                    light_m_s,
                    begins_s: went_on_s.unwrap_or(0.0),
                })))
            }
        }
    }
}

/// State in which legs begin: of their own start, or of the end of the part before.
fn begin_legs(start: Option<&PlannedStart>, before: Option<PartBefore>, ct: f64) -> WorldlineState {
    let of_before = before.map(|before| before.end.observer);
    let (position, celerity) = match (start, of_before) {
        (Some(start), _) => (start.position, start.celerity),
        (None, Some(observer)) => (observer.event.position, observer.celerity),
        (None, None) => (DVec3::ZERO, Celerity::ZERO),
    };
    WorldlineState::new(physics::Event { ct, position }, celerity, DQuat::IDENTITY)
}

impl PlannedLeg {
    fn of_light(&self, light_m_s: f64) -> ThrustLeg {
        let thrust_per_s = match self.push {
            PlannedPush::MetresPerSecond2(acceleration) => acceleration / light_m_s,
            PlannedPush::LightPerSecond(thrust) => thrust,
        };
        ThrustLeg { seconds: self.seconds, thrust_per_s }
    }
}
