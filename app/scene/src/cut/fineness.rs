//! Options of a cut: its accuracy, and the pictures that it is for.

use glam::DVec3;
use physics::Observer;
use view::Camera;

/// Accuracy and limits of a cut.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CutFineness {
    /// Largest allowed distance of anything from its exact place in the picture, pixels.
    pub tolerance_px: f64,
    /// Angle by which the camera may turn until the next cut, radians.
    pub turn_rad: f64,
    /// Largest number of triangles. The tolerance is doubled until the cut stays within it.
    pub triangles: usize,
}

/// Pictures that a cut is for: one, or all that one eye sees.
#[derive(Clone, Debug, PartialEq)]
pub struct CutViewpoint {
    /// Observer whose eye sees the pictures.
    pub observer: Observer,
    /// Camera and size in pixels of each picture.
    pub pictures: Vec<(Camera, [u32; 2])>,
    /// Place of the cameras relative to the eye, observer's axes, metres, if they look at the photo-surface from
    /// outside.
    pub outside: Option<DVec3>,
}

impl CutViewpoint {
    /// Makes a viewpoint with one picture.
    pub fn new(observer: Observer, camera: Camera, size: [u32; 2]) -> Self {
        Self { observer, pictures: vec![(camera, size)], outside: None }
    }
}
