//! One picture: who looks, through which camera, with which effects; and how its light is stored.

use crate::camera::Camera;
use crate::effects::Effects;
use glam::{DQuat, DVec2};
use physics::photo_surface::Eye;
use physics::{Celerity, Event, Observer};

/// Place, motion and direction of view of an eye.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gaze {
    /// Place and celerity of the eye, world axes.
    pub eye: Eye,
    /// World time of the view, metres of light travel.
    pub ct: f64,
    /// Rotation from the eye's axes (x right, y up, −z ahead) to the observer's.
    pub observer_from_eye: DQuat,
}

/// What one picture shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shot {
    /// Where the eye points.
    pub camera: Camera,
    /// Place and celerity of the eye, world axes.
    pub eye: Eye,
    /// World time of the view, metres of light travel.
    pub ct: f64,
    /// What relativity does to the picture.
    pub effects: Effects,
    /// What radiance is multiplied by, instead of [`Shot::scale`]'s own choice: for pictures that are put together.
    pub stored_scale: Option<f64>,
}

impl Shot {
    /// Who looks, when, and from where.
    pub fn observer(&self) -> Observer {
        let event = Event { ct: self.ct, position: self.eye.position() };
        Observer { event, celerity: self.celerity() }
    }

    /// How the eye moves.
    pub fn celerity(&self) -> Celerity {
        Celerity::new(self.eye.celerity()).unwrap_or_default()
    }

    /// What radiance is multiplied by so that short floats can hold it: the searchlight effect undone, as it is in the mean of a picture of
    /// usual shape.
    pub fn scale(&self) -> f64 {
        if let Some(scale) = self.stored_scale {
            return scale;
        }
        if !self.effects.searchlight {
            return 1.0;
        }
        let steps = [-0.8, -0.4, 0.0, 0.4, 0.8];
        let places = steps.into_iter().flat_map(|x| steps.map(|y| DVec2::new(x, y)));
        let logs = places.map(|place| self.camera.doppler_at(place, self.celerity(), self.effects.geometry).ln());
        let mean = logs.sum::<f64>() / (steps.len() * steps.len()) as f64;
        (-4.0 * mean).exp().clamp(1e-30, 1e30)
    }
}

/// Scale in which a texture holds radiance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stored {
    /// Luminance of what is white at rest, cd/m².
    pub white: f64,
    /// Factor of the texture's values: its red, green and blue are linear sRGB, relative to that white, times this.
    pub scale: f64,
    /// True if Doppler shift or searchlight effect changed the light. Then the texture's alpha is the luminance of
    /// the same surface without any shift, relative to white and not scaled.
    pub shifted: bool,
}

impl Stored {
    /// Light as it was emitted: relative to white, not scaled, not shifted.
    pub const UNSHIFTED: Self = Self { white: 1.0, scale: 1.0, shifted: false };
}
