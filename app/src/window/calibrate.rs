//! Moving the corners of a room's channels by keys.

use super::calibrating::Calibrating;
use super::open::Open;
use crate::canvas::Canvas;
use input::{Sample, SampleSource};
use winit::keyboard::KeyCode;
use words::Phrase;

impl Open {
    /// True while corners are being moved.
    pub fn calibrates(&self) -> bool {
        self.calibrating.as_ref().is_some_and(|calibrating| calibrating.active)
    }

    /// Starts or resumes moving the corners of a room's channels.
    pub fn calibrate(&mut self) {
        // The pictures of a headset have no corners that anybody could move.
        let has_corners = self.worn.is_none();
        let (Canvas::Room(walls), true) = (&mut self.canvas, has_corners) else {
            return self.ride.live.tell(self.presentation.language.text(Phrase::CornersNeedRoom));
        };
        let begun = || Calibrating::new(self.room.display_name.clone(), &walls.display);
        let calibrating = self.calibrating.get_or_insert_with(begun);
        calibrating.active = true;
        walls.show_grids(&self.gpu, &calibrating.calibration);
        // The vehicle gets no keys until this is over.
        self.ride.live.say(|at| Sample::closed(at, SampleSource::Keyboard));
    }

    /// Performs the action of a key that is pressed while corners are being moved.
    pub fn calibration_key(&mut self, code: KeyCode, repeated: bool) {
        let language = self.presentation.language;
        let (Canvas::Room(walls), Some(calibrating)) = (&mut self.canvas, &mut self.calibrating) else { return };
        match code {
            KeyCode::F4 | KeyCode::Escape if !repeated => {
                walls.show_light(&self.gpu);
                calibrating.active = false;
            }
            KeyCode::F11 if !repeated => self.fill_monitors(),
            KeyCode::KeyS if !repeated => calibrating.save(language),
            _ => {
                for channel in calibrating.press(code, self.shift, language) {
                    walls.show_grid(&self.gpu, &calibrating.calibration, channel);
                }
            }
        }
    }
}
