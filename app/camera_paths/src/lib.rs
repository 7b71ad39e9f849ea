//! Camera paths: where the camera of a film is at each moment of its own clock, how fast it moves, and where it looks.
//!
//! A path is a file (docs/FILMS.md). `path_file` reads it strictly into plans, one for each part of the film
//! (`part_plan`); `camera_path` makes courses of these, one after the other. A course is one of four: `keys` with
//! places in between that never jerk (`place_spline`, `turn_spline`, `number_spline`), `legs` of thrust that the
//! integrator of vehicles rides, a `circle`, or the animated camera of a glTF scene (`camera_course`). `path_clock`
//! leads from own time to the time of the world or of the keys, and `fastest` finds where a course is fastest, so that
//! it can be refused.

mod camera_course;
mod camera_path;
mod circle;
mod course;
mod course_moment;
mod error;
mod eye;
mod fastest;
mod keys;
mod legs;
mod number_spline;
mod part_plan;
mod path_clock;
mod path_file;
mod place_spline;
mod speed_text;
mod turn_spline;

pub use camera_path::{CameraPath, PathView};
pub use error::CameraPathError;
pub use path_file::{PathFile, PathScene};
