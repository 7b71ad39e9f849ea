//! Course through keys: a spline of places over own time or over the world's.
//!
//! Over own time the spline's velocity is the celerity times c, which has no limit; the world's time is the integral of
//! γ. Over the world's time its velocity has to stay below c, and own time is the integral of 1/γ, of which the inverse
//! leads back to the keys' time.

use crate::course_moment::CourseMoment;
use crate::eye::{PathEye, celerity_of};
use crate::fastest::fastest;
use crate::path_clock::PathClock;
use crate::place_spline::{PlaceSpline, SplinePoint};
use glam::DVec3;
use physics::{Celerity, Event, Observer};

/// Time over which keys are given.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum KeyTime {
    /// Time of the camera's own clock.
    Own,
    /// Time of the world, at rest in which the scene is.
    World,
}

/// Course through keys.
#[derive(Clone, Debug)]
pub(crate) struct KeyCourse {
    spline: PlaceSpline,
    time: KeyTime,
    /// Clock that keys do not give: the world's by own time, or own time by the world's, seconds.
    clock: PathClock,
    eye: PathEye,
    light_m_s: f64,
    /// World time of the first key, seconds.
    begins_s: f64,
}

/// Key after which a course would be as fast as light, counted from 0, and the speed, m/s.
pub(crate) type FastKey = (usize, f64);

impl KeyCourse {
    /// Course whose first key is met at the world time `begins_s`.
    pub(crate) fn new(
        spline: PlaceSpline,
        time: KeyTime,
        eye: PathEye,
        light_m_s: f64,
        begins_s: f64,
    ) -> Result<Self, FastKey> {
        if time == KeyTime::World {
            for (key, ends) in spline.times_s().windows(2).enumerate() {
                let speed = fastest([ends[0], ends[1]], &|at| spline.at(at).velocity.length());
                if speed >= light_m_s {
                    return Err((key, speed));
                }
            }
        }
        let clock = PathClock::new(spline.times_s(), &rate(&spline, time, light_m_s));
        Ok(Self { spline, time, clock, eye, light_m_s, begins_s })
    }

    fn first_s(&self) -> f64 {
        self.spline.times_s()[0]
    }

    /// Length, seconds of own time.
    pub(crate) fn length_s(&self) -> f64 {
        let times = self.spline.times_s();
        match self.time {
            KeyTime::Own => times[times.len() - 1] - times[0],
            KeyTime::World => self.clock.end(),
        }
    }

    /// Moment at a time of its own, seconds.
    pub(crate) fn at(&self, own_s: f64) -> CourseMoment {
        let rate = rate(&self.spline, self.time, self.light_m_s);
        let (key_s, world_s) = match self.time {
            KeyTime::Own => {
                let key_s = self.first_s() + own_s.clamp(0.0, self.length_s());
                (key_s, self.clock.reading(key_s, &rate))
            }
            KeyTime::World => {
                let key_s = self.clock.parameter(own_s, &rate);
                (key_s, key_s - self.first_s())
            }
        };
        let point = self.spline.at(key_s);
        let over_c = point.velocity / self.light_m_s;
        let celerity = match self.time {
            KeyTime::Own => Celerity::new(over_c).unwrap_or_default(),
            KeyTime::World => celerity_of(over_c).0,
        };
        let event = Event { ct: (self.begins_s + world_s) * self.light_m_s, position: point.place };
        let observer = Observer { event, celerity };
        let turn = self.eye.turn(key_s, &observer, self.ahead(key_s, &point));
        CourseMoment { observer, turn, fov_deg: self.eye.fov_deg(key_s) }
    }

    /// Direction of the motion. At rest that in which the camera will move, or has moved.
    fn ahead(&self, key_s: f64, point: &SplinePoint) -> DVec3 {
        /// Velocity below which there is none, as a share of light's.
        const REST: f64 = 1e-9;
        let moves = |velocity: DVec3| velocity.length() > REST * self.light_m_s;
        if moves(point.velocity) {
            return point.velocity;
        }
        let times = self.spline.times_s();
        let after = times.partition_point(|time| *time <= key_s);
        let middle = |interval: usize| self.spline.at(0.5 * (times[interval] + times[interval + 1])).velocity;
        let later = (after.saturating_sub(1)..times.len() - 1).map(middle).find(|velocity| moves(*velocity));
        let earlier = || (0..after.saturating_sub(1)).rev().map(middle).find(|velocity| moves(*velocity));
        later.or_else(earlier).unwrap_or(DVec3::NEG_Z)
    }
}

/// Rate of the clock that keys do not give.
fn rate(spline: &PlaceSpline, time: KeyTime, light_m_s: f64) -> impl Fn(f64) -> f64 {
    move |key_s| {
        let over_c = spline.at(key_s).velocity / light_m_s;
        match time {
            KeyTime::Own => (1.0 + over_c.length_squared()).sqrt(),
            KeyTime::World => celerity_of(over_c).1,
        }
    }
}
