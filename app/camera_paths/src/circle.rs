//! Circle at a constant speed: the one course whose own time is in closed form, τ = t/γ.

use crate::course_moment::CourseMoment;
use crate::eye::{PathEye, celerity_of};
use glam::DVec3;
use physics::{Event, Observer};
use std::f64::consts::TAU;

/// Circle at a constant speed.
#[derive(Clone, Debug)]
pub(crate) struct CircleCourse {
    /// Centre, world axes, metres.
    pub(crate) centre: DVec3,
    /// Radius towards the beginning, and at a right angle to it along the motion there, world axes, metres.
    pub(crate) axes: [DVec3; 2],
    /// Speed, m/s of the world, below that of light.
    pub(crate) speed_m_s: f64,
    /// Number of turns.
    pub(crate) turns: f64,
    /// Eye, by own time.
    pub(crate) eye: PathEye,
    pub(crate) light_m_s: f64,
    /// World time of the beginning, seconds.
    pub(crate) begins_s: f64,
}

impl CircleCourse {
    /// Own time per world time, 1/γ.
    fn slower(&self) -> f64 {
        celerity_of(DVec3::X * (self.speed_m_s / self.light_m_s)).1
    }

    /// Length, seconds of own time.
    pub(crate) fn length_s(&self) -> f64 {
        self.turns * TAU * self.axes[0].length() / self.speed_m_s * self.slower()
    }

    /// Moment at a time of its own, seconds.
    pub(crate) fn at(&self, own_s: f64) -> CourseMoment {
        let own_s = own_s.clamp(0.0, self.length_s());
        let world_s = own_s / self.slower();
        let angle = self.speed_m_s * world_s / self.axes[0].length();
        let (sine, cosine) = (libm::sin(angle), libm::cos(angle));
        let [from, along] = self.axes;
        let ahead = (along * cosine - from * sine).normalize();
        let event = Event {
            ct: (self.begins_s + world_s) * self.light_m_s,
            position: self.centre + from * cosine + along * sine,
        };
        let observer = Observer { event, celerity: celerity_of(ahead * (self.speed_m_s / self.light_m_s)).0 };
        let turn = self.eye.turn(own_s, &observer, ahead);
        CourseMoment { observer, turn, fov_deg: self.eye.fov_deg(own_s) }
    }
}
