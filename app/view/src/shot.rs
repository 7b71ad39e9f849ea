//! One picture: its observer, its camera and its effects; and how its light is stored.

use crate::camera::{Camera, Field};
use crate::effects::Effects;
use crate::outside::{Colouring, OutsideCamera, OutsideView};
use glam::{DQuat, DVec2, DVec3};
use physics::{Celerity, Event, Observer};

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
    /// Camera outside of the eye, of which `camera` is the direction then; `None` for what the eye itself sees.
    pub outside: Option<OutsideCamera>,
}

impl Gaze {
    /// Gaze at a share of the way to another, a moment later: events and celerities go in a straight line, directions
    /// turn evenly.
    #[must_use]
    pub fn towards(&self, later: &Self, share: f64) -> Self {
        let (here, there) = (&self.observer, &later.observer);
        let ct = here.event.ct + share * (there.event.ct - here.event.ct);
        let event = Event { ct, position: here.event.position.lerp(there.event.position, share) };
        // Between two finite celerities there is a finite one.
        let celerity = Celerity::new(here.celerity.vector().lerp(there.celerity.vector(), share));
        let celerity = celerity.unwrap_or(here.celerity);
        let observer_from_eye = self.observer_from_eye.slerp(later.observer_from_eye, share);
        Self { observer: Observer { event, celerity }, observer_from_eye }
    }

    /// Picture straight ahead with square pixels and a vertical field of view of `fov_y_deg` degrees.
    pub fn shot(&self, fov_y_deg: f64, effects: Effects) -> Shot {
        let field = Field::Ahead { fov_y_rad: fov_y_deg.to_radians() };
        let camera = Camera { observer_from_eye: self.observer_from_eye, field };
        Shot { camera, observer: self.observer, effects, stored_scale: None, outside: None }
    }
}

impl Shot {
    /// The same shot's photo-surface, looked at from outside, with the same field of view. World's up is up.
    #[must_use]
    pub fn from_outside(&self, view: &OutsideView) -> Self {
        let towards = view.look.unwrap_or(-view.place);
        let turned = Camera::looking(towards, DVec3::Y, 1.0);
        let camera = Camera { observer_from_eye: turned.observer_from_eye, field: self.camera.field };
        let eye = self.outside.map_or(self.camera, |outside| outside.eye);
        let outside = OutsideCamera { place: view.place, colouring: view.colouring, eye };
        Self { camera, outside: Some(outside), ..*self }
    }

    /// True if colours show light, false if they show another value of the photo-surface, seen from outside.
    pub fn shows_light(&self) -> bool {
        self.outside.is_none_or(|outside| outside.colouring == Colouring::Light || !self.effects.bend())
    }

    /// Factor of the stored radiance, with which short floats can hold it. It undoes the mean searchlight effect of a
    /// picture of usual shape.
    pub fn scale(&self) -> f64 {
        if let Some(scale) = self.stored_scale {
            return scale;
        }
        if !self.shows_light() || !self.effects.brighten() {
            return 1.0;
        }
        let steps = [-0.8, -0.4, 0.0, 0.4, 0.8];
        let places = steps.into_iter().flat_map(|x| steps.map(|y| DVec2::new(x, y)));
        // From outside, too, it is the light of the eye's own picture.
        let camera = self.outside.map_or(self.camera, |outside| outside.eye);
        let (celerity, bends) = (self.observer.celerity, self.effects.bend());
        let logs = places.map(|place| camera.doppler_at(place, celerity, bends).ln());
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

#[cfg(test)]
mod tests {
    //! Law: a camera outside looks at the eye from wherever it goes, and remembers the eye's own picture.
    #![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

    use super::*;

    #[test]
    fn the_camera_looks_at_the_eye_from_wherever_it_goes() {
        let gaze = Gaze { observer: Observer::default(), observer_from_eye: DQuat::from_rotation_y(0.4) };
        let shot = gaze.shot(60.0, Effects::ALL);
        let mut view = OutsideView::over(DVec3::NEG_Z, 7.0);
        for turn in [[0.0, 0.0], [0.3, 0.2], [2.0, -3.0], [-1.0, 9.0]] {
            view.orbit(turn[0], turn[1], 1.0);
            let outside = shot.from_outside(&view).from_outside(&view);
            let ahead = outside.camera.observer_from_eye * DVec3::NEG_Z;
            assert!((view.place.length() - 7.0).abs() < 1e-12 && (7.0 * ahead + view.place).length() < 1e-9);
            assert_eq!(outside.outside.unwrap().eye, shot.camera);
        }
        // The middle of the four corners is straight ahead of the eye.
        let corners = shot.from_outside(&view).outside.unwrap().corners([640, 360]);
        let middle = corners.iter().sum::<DVec3>().normalize();
        assert!(middle.distance(shot.camera.observer_from_eye * DVec3::NEG_Z) < 1e-12);
        view.orbit(0.0, 0.0, 2.0);
        assert!((view.place.length() - 3.5).abs() < 1e-12);
    }
}
