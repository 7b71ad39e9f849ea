//! View from outside during a ride: its camera, and what is frozen in it.

use glam::DVec3;
use presentation::Presentation;
use view::{Gaze, OutsideView};

/// Distance at which the camera begins, metres.
const BEGIN_M: f64 = 30.0;

/// View from outside during a ride.
#[derive(Clone, Copy, Debug, Default)]
pub struct OutsideLook {
    /// Camera; `None` unless the view is from outside.
    camera: Option<OutsideView>,
    /// Gaze that is shown while the view is frozen.
    frozen: Option<Gaze>,
}

impl OutsideLook {
    /// Gaze that is shown in place of `gaze`, and the camera, if the view is from outside. What is frozen stays the
    /// gaze of its first moment.
    pub fn follow(&mut self, gaze: &Gaze, shown: &Presentation) -> (Gaze, Option<OutsideView>) {
        self.frozen = (shown.outside && shown.frozen).then(|| self.frozen.unwrap_or(*gaze));
        let ahead = gaze.observer_from_eye * DVec3::NEG_Z;
        let camera = self.camera.take().unwrap_or_else(|| OutsideView::over(ahead, BEGIN_M));
        self.camera = shown.outside.then_some(OutsideView { colouring: shown.colouring, ..camera });
        (self.frozen.unwrap_or(*gaze), self.camera)
    }

    /// Leads the camera about the eye: turns to the right and up, radians, and the factor by which it comes closer.
    pub fn orbit(&mut self, [right_rad, up_rad]: [f64; 2], closer: f64) {
        if let Some(camera) = &mut self.camera {
            camera.orbit(right_rad, up_rad, closer);
        }
    }
}
