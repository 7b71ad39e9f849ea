//! What a picture shows, and how it is developed.

use presentation::Presentation;
use render::display::Development;
use std::sync::Arc;
use view::{Effects, Gaze, OpenShutter, OutsideView, Shot};

/// How a moment is shown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Look {
    /// Effects of relativity.
    pub effects: Effects,
    /// Vertical field of view, degrees.
    pub fov_deg: f64,
    /// Development of radiance into the picture.
    pub development: Development,
    /// Camera outside of the eye.
    pub outside: Option<OutsideView>,
}

/// Observer of one picture, its time by the observer's own clock, and how it is shown. `T`: what is written over it.
#[derive(Debug)]
pub struct Moment<T = ()> {
    /// Observer and direction of view.
    pub gaze: Gaze,
    /// Proper time of the observer, seconds.
    pub own_s: f64,
    /// How it is shown.
    pub look: Look,
    /// Worldline of the eye while the shutter is open.
    pub exposure: OpenShutter,
    /// What is written over it.
    pub told: Option<Arc<T>>,
}

impl<T> Clone for Moment<T> {
    fn clone(&self) -> Self {
        Self { told: self.told.clone(), exposure: self.exposure.clone(), ..*self }
    }
}

impl<T> Moment<T> {
    /// True if a picture of the other moment would be the same. What is told is only the same as itself.
    pub fn is_as(&self, other: &Self) -> bool {
        let untold = self.told.is_none() && other.told.is_none();
        untold && (self.gaze, self.own_s, self.look) == (other.gaze, other.own_s, other.look)
    }

    /// View of the picture. `elapsed_s`: own time since the picture before, seconds; `None` for an eye that adapts at
    /// once.
    pub fn view(&self, elapsed_s: Option<f64>) -> FilmView {
        let Look { effects, fov_deg, development, outside } = self.look;
        let exposure = self.exposure.clone();
        FilmView { gaze: self.gaze, effects, fov_deg, development, outside, exposure, elapsed_s }
    }
}

impl Look {
    /// Look of a presentation, with its camera outside of the eye.
    pub fn of(shown: &Presentation, outside: Option<OutsideView>) -> Self {
        let Presentation { effects, fov_deg, development, .. } = *shown;
        Self { effects, fov_deg, development, outside }
    }
}

/// Eye, direction and look of one picture.
#[derive(Clone, Debug, PartialEq)]
pub struct FilmView {
    /// Point midway between the eyes, and the direction of the picture's middle.
    pub gaze: Gaze,
    /// Effects of relativity.
    pub effects: Effects,
    /// Vertical field of view of a flat picture, degrees.
    pub fov_deg: f64,
    /// Development of radiance into the picture.
    pub development: Development,
    /// Camera outside of the eye.
    pub outside: Option<OutsideView>,
    /// Worldline of the eye while the shutter is open.
    pub exposure: OpenShutter,
    /// Proper time since the picture before, seconds, for an eye that adapts; `None` if it adapts at once.
    pub elapsed_s: Option<f64>,
}

impl FilmView {
    /// Shot straight ahead.
    pub fn shot(&self) -> Shot {
        self.gaze.shot(self.fov_deg, self.effects)
    }

    /// Shot that is drawn: the one straight ahead, or its photo-surface from outside.
    pub fn drawn_shot(&self) -> Shot {
        self.outside.map_or_else(|| self.shot(), |outside| self.shot().from_outside(&outside))
    }
}
