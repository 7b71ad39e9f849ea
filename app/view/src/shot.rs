//! One picture: who looks, through which camera, with which effects; and how its light is stored.

use crate::camera::Camera;
use crate::effects::Effects;
use glam::{DQuat, DVec2};
use physics::photo_surface::Eye;
use physics::{Celerity, Event, Observer};

/// Where an eye is, how it moves, and where it looks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gaze {
    /// Place and celerity, world axes.
    pub eye: Eye,
    /// World time of the look, metres of light travel.
    pub ct: f64,
    /// From eye axes (x right, y up, −z ahead) to the observer's.
    pub observer_from_eye: DQuat,
}

/// What one picture shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shot {
    /// Where the eye points.
    pub camera: Camera,
    /// Place and celerity of the eye, world axes.
    pub eye: Eye,
    /// World time of the look, metres of light travel.
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

/// How a texture holds radiance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stored {
    /// Luminance in cd/m² of what is white at rest.
    pub white: f64,
    /// The texture's red, green and blue are linear sRGB, relative to that white, times this.
    pub scale: f64,
    /// Whether Doppler shift or searchlight effect changed the light. Then the texture's alpha is the luminance that the same
    /// surface has unshifted, relative to white and not scaled.
    pub shifted: bool,
}

impl Stored {
    /// Light that is as it was sent out.
    pub const UNSHIFTED: Self = Self { white: 1.0, scale: 1.0, shifted: false };
}
