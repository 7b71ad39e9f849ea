//! What a picture shows, and how it is developed.

use render::display::Development;
use view::{Effects, Gaze, OutsideView, Shot};

/// Eye, direction and look of one picture.
#[derive(Clone, Copy, Debug, PartialEq)]
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
