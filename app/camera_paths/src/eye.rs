//! Eye of a camera on its way: where it looks, in the observer's axes.

use crate::number_spline::NumberSpline;
use crate::turn_spline::TurnSpline;
use glam::{DQuat, DVec3};
use physics::aberration::Aberration;
use physics::{Celerity, Observer};
use view::Camera;

/// Direction of view along a course.
#[derive(Clone, Debug)]
pub(crate) enum EyeCourse {
    /// View along the motion.
    Ahead,
    /// View in which a point of the world is seen in the middle.
    Watching(DVec3),
    /// View by directions at given times.
    Turning(TurnSpline),
}

/// Eye along a course: its direction of view and its field of view.
#[derive(Clone, Debug)]
pub(crate) struct PathEye {
    pub(crate) course: EyeCourse,
    /// Vertical field of view, degrees, if the path gives any.
    pub(crate) fov: Option<NumberSpline>,
}

/// Directions and fields of view that a path gives at times of its own.
#[derive(Clone, Debug, Default)]
pub(crate) struct EyeKeys {
    /// Times and rotations from the eye's axes to the observer's.
    pub(crate) turns: Vec<(f64, DQuat)>,
    /// Times and vertical fields of view, degrees.
    pub(crate) fovs: Vec<(f64, f64)>,
}

impl EyeKeys {
    /// Adds what is given at a time: direction of view and of the picture's top, and field of view.
    pub(crate) fn add(&mut self, time: f64, look: Option<[f64; 3]>, up: Option<[f64; 3]>, fov: Option<f64>) {
        self.turns.extend(look.map(|look| (time, looking(look, up))));
        self.fovs.extend(fov.map(|fov| (time, fov)));
    }

    /// Eye that these make. `watched`: point of the world to look at where they name no direction.
    pub(crate) fn eye(self, watched: Option<[f64; 3]>) -> PathEye {
        let course = match (self.turns.is_empty(), watched) {
            (false, _) => {
                let (times, turns) = self.turns.into_iter().unzip();
                EyeCourse::Turning(TurnSpline::new(times, turns))
            }
            (true, Some(point)) => EyeCourse::Watching(DVec3::from_array(point)),
            (true, None) => EyeCourse::Ahead,
        };
        let (times, fovs): (Vec<f64>, Vec<f64>) = self.fovs.into_iter().unzip();
        PathEye { course, fov: (!times.is_empty()).then(|| NumberSpline::new(times, fovs)) }
    }
}

impl PathEye {
    /// Rotation from the eye's axes to the observer's at a time of the course. `ahead`: direction of the motion, where
    /// the observer rests that in which it will move.
    pub(crate) fn turn(&self, time: f64, observer: &Observer, ahead: DVec3) -> DQuat {
        match &self.course {
            EyeCourse::Turning(turns) => turns.at(time),
            EyeCourse::Ahead => looking(ahead.to_array(), None),
            EyeCourse::Watching(point) => {
                let (seen, _) =
                    Aberration::new(observer.celerity).observer_from_world(*point - observer.event.position);
                looking(seen.to_array(), None)
            }
        }
    }

    /// Vertical field of view at a time, degrees.
    pub(crate) fn fov_deg(&self, time: f64) -> Option<f64> {
        self.fov.as_ref().map(|fov| fov.at(time))
    }
}

/// Rotation of an eye that looks along `look`, with `up`, or the world's y, as far up as that allows.
pub(crate) fn looking(look: [f64; 3], up: Option<[f64; 3]>) -> DQuat {
    let up = up.map_or(DVec3::Y, DVec3::from_array);
    Camera::looking(DVec3::from_array(look), up, 1.0).observer_from_eye
}

/// Celerity of a velocity below that of light, and its Lorentz factor's inverse √(1 − β²).
pub(crate) fn celerity_of(beta: DVec3) -> (Celerity, f64) {
    let slower = ((1.0 - beta.length()) * (1.0 + beta.length())).max(f64::MIN_POSITIVE).sqrt();
    (Celerity::new(beta / slower).unwrap_or_default(), slower)
}
