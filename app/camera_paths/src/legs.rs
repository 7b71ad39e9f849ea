//! Course under thrust: legs of constant proper acceleration in the observer's axes, which a pure boost makes of the
//! world's, integrated in the steps and by the method of the vehicles.
//!
//! A state a second is kept. From the one before, a moment is at most a second of steps away, and the rest of a step is
//! taken as the frames of a ride take it.

use crate::course_moment::CourseMoment;
use crate::eye::PathEye;
use glam::DVec3;
use physics::worldline::{Integrator, Rk4, Thrust, WorldlineError, WorldlineState};

/// Steps of a second of own time.
const STEPS_A_SECOND: f64 = 240.0;
/// Steps from one kept state to the next.
const KEPT: usize = 240;

/// Leg of a course.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ThrustLeg {
    /// Length, seconds of own time.
    pub(crate) seconds: f64,
    /// Proper acceleration, observer's axes, in units of c per second of own time.
    pub(crate) thrust_per_s: DVec3,
}

/// Course under thrust.
#[derive(Clone, Debug)]
pub(crate) struct LegCourse {
    legs: Vec<RiddenLeg>,
    /// Eye, by own time.
    eye: PathEye,
    light_m_s: f64,
}

/// Leg that has been ridden.
#[derive(Clone, Debug)]
struct RiddenLeg {
    leg: ThrustLeg,
    /// Own time of its beginning, seconds.
    begins_s: f64,
    /// Number of steps, all of one length.
    steps: usize,
    /// States after each `KEPT` steps, the first at the beginning.
    kept: Vec<WorldlineState>,
}

/// Leg that leads beyond what can be computed, counted from 0, and the rapidity at its end.
pub(crate) type FarLeg = (usize, f64);

impl LegCourse {
    /// Course from a state. No leg may end at more than `most_rapidity`.
    pub(crate) fn new(
        start: WorldlineState,
        legs: &[ThrustLeg],
        eye: PathEye,
        light_m_s: f64,
        most_rapidity: f64,
    ) -> Result<Self, FarLeg> {
        let mut course = Self { legs: Vec::with_capacity(legs.len()), eye, light_m_s };
        let (mut state, mut begins_s) = (start, 0.0);
        for (number, leg) in legs.iter().enumerate() {
            let steps = ((leg.seconds * STEPS_A_SECOND).ceil() as usize).max(1);
            let mut ridden = RiddenLeg { leg: *leg, begins_s, steps, kept: Vec::with_capacity(steps / KEPT + 1) };
            for step in 0..steps {
                if step % KEPT == 0 {
                    ridden.kept.push(state);
                }
                let next = ridden.step(&state, leg.seconds / steps as f64, light_m_s);
                state = next.map_err(|_| (number, f64::INFINITY))?;
                if state.celerity.rapidity() > most_rapidity {
                    return Err((number, state.celerity.rapidity()));
                }
            }
            begins_s += leg.seconds;
            course.legs.push(ridden);
        }
        Ok(course)
    }

    /// Length, seconds of own time.
    pub(crate) fn length_s(&self) -> f64 {
        self.legs.last().map_or(0.0, |leg| leg.begins_s + leg.leg.seconds)
    }

    /// Moment at a time of its own, seconds.
    pub(crate) fn at(&self, own_s: f64) -> CourseMoment {
        let own_s = own_s.clamp(0.0, self.length_s());
        let number = self.legs.partition_point(|leg| leg.begins_s <= own_s).saturating_sub(1);
        let leg = &self.legs[number];
        let state = leg.at(own_s - leg.begins_s, self.light_m_s);
        let observer = state.observer();
        // At rest it will move as it is pushed.
        let pushed = || {
            let later =
                self.legs[number..].iter().map(|leg| leg.leg.thrust_per_s).find(|thrust| *thrust != DVec3::ZERO);
            later.unwrap_or(DVec3::NEG_Z)
        };
        let ahead = observer.celerity.direction().unwrap_or_else(pushed);
        let turn = self.eye.turn(own_s, &observer, ahead);
        CourseMoment { observer, turn, fov_deg: self.eye.fov_deg(own_s) }
    }
}

impl RiddenLeg {
    fn at(&self, own_s: f64, light_m_s: f64) -> WorldlineState {
        let length_s = self.leg.seconds / self.steps as f64;
        let whole = ((own_s / length_s) as usize).min(self.steps);
        let kept = (whole / KEPT).min(self.kept.len() - 1);
        let mut state = self.kept[kept];
        let rest_s = own_s - whole as f64 * length_s;
        let lengths = std::iter::repeat_n(length_s, whole - kept * KEPT).chain((rest_s > 0.0).then_some(rest_s));
        for step_s in lengths {
            // Longer steps than these have been taken.
            state = self.step(&state, step_s, light_m_s).unwrap_or(state);
        }
        state
    }

    fn step(&self, state: &WorldlineState, step_s: f64, light_m_s: f64) -> Result<WorldlineState, WorldlineError> {
        let acceleration = self.leg.thrust_per_s / light_m_s;
        let control = |state: &WorldlineState| Thrust::in_boost_axes(state, acceleration);
        Rk4.step(state, step_s * light_m_s, &control)
    }
}
