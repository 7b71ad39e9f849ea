//! Who looks at a picture in any projection, and with how many eyes.

use glam::DVec3;
use view::{Effects, Gaze};

/// Eyes of a stereo picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StereoEyes {
    /// Distance between the eyes, metres.
    pub separation_m: f64,
    /// Distance of the wall on which a flat picture is shown, metres: both eyes see in the same place what is as far
    /// away.
    pub wall_m: f64,
    /// Axis about which the head turns in a dome or cube, axes of the picture's middle, a unit vector. That of a sphere
    /// is its own.
    pub upright: DVec3,
}

/// Eye, direction and effects of one picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProjectedView {
    /// Point midway between the eyes, and the direction of the picture's middle.
    pub gaze: Gaze,
    /// Vertical field of view of a flat picture, degrees.
    pub fov_deg: f64,
    /// Effects of relativity.
    pub effects: Effects,
}
