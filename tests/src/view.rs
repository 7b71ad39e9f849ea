//! Direction of a pixel, from first principles.

use glam::DVec3;
use physics::Observer;
use view::{Camera, Effects, Shot};

/// Flat picture: its direction and its size.
#[derive(Clone, Copy, Debug)]
pub struct View {
    /// Direction towards the middle of the picture, observer's axes, of any length.
    pub look: DVec3,
    /// Upward direction of the picture, as nearly as possible; not along `look`.
    pub up: DVec3,
    /// Full vertical angle, degrees.
    pub fov_degrees: f64,
    /// Width and height, pixels.
    pub size: [u32; 2],
}

impl View {
    /// Unit vector along which a place in the picture looks, observer's axes.
    ///
    /// *Units:* pixels from the upper left corner; the middle of the first pixel is at one half.
    pub fn direction(&self, [x, y]: [f64; 2]) -> DVec3 {
        let forward = self.look.normalize();
        let right = forward.cross(self.up).normalize();
        let above = right.cross(forward);
        let [width, height] = self.size.map(f64::from);
        (forward + ((x - 0.5 * width) * right + (0.5 * height - y) * above) / self.focal_length()).normalize()
    }

    /// Distance of the picture from the eye in pixels. A small angle near the middle, times this distance, is a
    /// length in the picture.
    pub fn focal_length(&self) -> f64 {
        0.5 * f64::from(self.size[1]) / (0.5 * self.fov_degrees.to_radians()).tan()
    }

    /// Camera of the program for the same picture.
    pub fn camera(&self) -> Camera {
        Camera::looking(self.look, self.up, self.fov_degrees.to_radians())
    }

    /// Shot of the program for the same picture, as this observer sees it.
    pub fn shot(&self, observer: &Observer, effects: Effects) -> Shot {
        Shot { camera: self.camera(), observer: *observer, effects, stored_scale: None, outside: None }
    }
}

/// Middle of a pixel, in pixels from the upper left corner.
pub fn middle([column, row]: [u32; 2]) -> [f64; 2] {
    [f64::from(column) + 0.5, f64::from(row) + 0.5]
}
