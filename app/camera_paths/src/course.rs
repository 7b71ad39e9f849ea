//! Course of a camera through one part of a path.

use crate::camera_course::CameraCourse;
use crate::circle::CircleCourse;
use crate::course_moment::CourseMoment;
use crate::keys::KeyCourse;
use crate::legs::LegCourse;

/// Course through one part of a path.
#[derive(Clone, Debug)]
pub(crate) enum PathCourse {
    /// Course through keys.
    Keys(Box<KeyCourse>),
    /// Course under thrust.
    Legs(Box<LegCourse>),
    /// Circle.
    Circle(Box<CircleCourse>),
    /// Course of an animated camera.
    Camera(Box<CameraCourse>),
}

impl PathCourse {
    /// Length, seconds of own time.
    pub(crate) fn length_s(&self) -> f64 {
        match self {
            Self::Keys(course) => course.length_s(),
            Self::Legs(course) => course.length_s(),
            Self::Circle(course) => course.length_s(),
            Self::Camera(course) => course.length_s(),
        }
    }

    /// Moment at a time of its own, seconds.
    pub(crate) fn at(&self, own_s: f64) -> CourseMoment {
        match self {
            Self::Keys(course) => course.at(own_s),
            Self::Legs(course) => course.at(own_s),
            Self::Circle(course) => course.at(own_s),
            Self::Camera(course) => course.at(own_s),
        }
    }
}
