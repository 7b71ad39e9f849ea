//! One picture: its observer, its camera and its effects; and how its light is stored.

use crate::camera::{Camera, Field};
use crate::effects::Effects;
use glam::{DQuat, DVec2};
use physics::Observer;

/// Height of a standing visitor's eyes above the ground, metres.
pub const EYE_HEIGHT_M: f64 = 1.6;

/// Observer and the direction of view.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gaze {
    /// Event and celerity of the eye in the world.
    pub observer: Observer,
    /// Rotation from the eye's axes (x right, y up, −z ahead) to the observer's, which a pure boost makes of the
    /// world's.
    pub observer_from_eye: DQuat,
}

/// One picture to be drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shot {
    /// Direction of view, and the part of the plane ahead that the picture shows.
    pub camera: Camera,
    /// Event and celerity of the eye in the world.
    pub observer: Observer,
    /// Effects of relativity on the picture.
    pub effects: Effects,
    /// Factor of the stored radiance instead of the one that [`Shot::scale`] would choose, for pictures that are
    /// joined into one.
    pub stored_scale: Option<f64>,
}

impl Gaze {
    /// Picture straight ahead with square pixels and a vertical field of view of `fov_y_deg` degrees.
    pub fn shot(&self, fov_y_deg: f64, effects: Effects) -> Shot {
        let field = Field::Ahead { fov_y_rad: fov_y_deg.to_radians() };
        let camera = Camera { observer_from_eye: self.observer_from_eye, field };
        Shot { camera, observer: self.observer, effects, stored_scale: None }
    }
}

impl Shot {
    /// Factor of the stored radiance, with which short floats can hold it. It undoes the mean searchlight effect of a
    /// picture of usual shape.
    pub fn scale(&self) -> f64 {
        if let Some(scale) = self.stored_scale {
            return scale;
        }
        if !self.effects.brighten() {
            return 1.0;
        }
        let steps = [-0.8, -0.4, 0.0, 0.4, 0.8];
        let places = steps.into_iter().flat_map(|x| steps.map(|y| DVec2::new(x, y)));
        let (celerity, bends) = (self.observer.celerity, self.effects.bend());
        let logs = places.map(|place| self.camera.doppler_at(place, celerity, bends).ln());
        let mean = logs.sum::<f64>() / (steps.len() * steps.len()) as f64;
        (-4.0 * mean).exp().clamp(1e-30, 1e30)
    }
}

/// Scale in which a texture holds radiance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stored {
    /// Luminance of a surface that is white at rest, cd/m².
    pub white: f64,
    /// Factor of the texture's values: its red, green and blue are linear sRGB, relative to that white, times this.
    pub scale: f64,
    /// True if Doppler shift or searchlight effect changed the light. Then the texture's alpha is the luminance of
    /// the same surface without any shift, relative to white and not scaled.
    pub shifted: bool,
}

impl Stored {
    /// Scale of unshifted light: relative to white, factor 1.
    pub const UNSHIFTED: Self = Self { white: 1.0, scale: 1.0, shifted: false };
}
