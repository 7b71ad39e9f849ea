//! Frame in the windows: drawn, developed, with the interface over it.

use super::open::Open;
use super::window_surface::Acquired;
use super::{calibrating, hud, panel, photo, readings};
use crate::error::Error;
use input::{Action, Sample};
use std::sync::atomic::Ordering;
use std::time::Duration;

/// Pause between two looks at windows that cannot be drawn in.
const UNSEEN_PAUSE: Duration = Duration::from_millis(10);

impl Open {
    /// Draws one frame. Returns false when the ride is over.
    ///
    /// # Errors
    /// A lost device, or a recording that cannot be replayed.
    pub fn frame(&mut self) -> Result<bool, Error> {
        self.gpu.lost()?;
        if self.stop.load(Ordering::Relaxed) {
            return Ok(false);
        }
        // A window that cannot be drawn in for the moment is left out.
        let mut screens = Vec::new();
        for number in 0..self.windows.len() {
            match self.windows[number].acquire(&self.gpu)? {
                Acquired::Texture(texture) => screens.push((number, texture)),
                Acquired::Resize(size) => self.resize(number, size),
                Acquired::Nothing => {}
            }
        }
        if screens.is_empty() {
            // The ride goes on while no window can be drawn in.
            std::thread::sleep(UNSEEN_PAUSE);
            return Ok(self.ride.live.frame()?.is_some());
        }

        // Devices to light, on one page: frame.rs.
        let look = self.settings.look;
        let Some(actions) = self.ride.frame(&self.gpu, &mut self.canvas, &look)? else { return Ok(false) };
        if self.ride.live.has_turned() {
            self.settings = self.fresh.clone();
        }
        for action in actions {
            match action {
                Action::ToggleRecording | Action::Photo if self.settings.kiosk => {}
                Action::ToggleHelp => self.settings.help = !self.settings.help,
                Action::ToggleRecording => self.ride.live.toggle_recording(),
                Action::Photo => {
                    let taken = photo::take(&self.gpu, &mut self.ride.renderer, &mut self.canvas, &look.development);
                    self.ride.live.tell(taken.unwrap_or_else(|error| error.to_string()));
                }
                _ => {}
            }
        }

        // Light to the windows, and the interface over the first.
        let readings = readings::readings(&self.ride, self.settings.kiosk);
        let panel = readings::panel(&self.ride, &self.gpu);
        let calibrating = self.calibrating.as_ref().filter(|calibrating| calibrating.active);
        let settings = &mut self.settings;
        let mut wanted = Vec::new();
        for (number, texture) in &screens {
            let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
            let screen = texture.texture.create_view(&wgpu::TextureViewDescriptor::default());
            let window = &self.windows[*number].window;
            let first_pixel = window.inner_position().map_or([0, 0], |place| [place.x, place.y]);
            self.canvas.show(&self.gpu, &mut encoder, *number, &look.development, &screen, first_pixel);
            if *number == 0 {
                let size = [texture.texture.width(), texture.texture.height()];
                self.interface.draw(&self.gpu, window, &mut encoder, &screen, size, |ui| {
                    if let Some(calibrating) = calibrating {
                        calibrating::show(ui, calibrating);
                        return;
                    }
                    if settings.readings {
                        hud::show(ui, &readings);
                    }
                    wanted.extend(panel::show(ui, settings, &panel));
                });
            }
            self.gpu.queue.submit([encoder.finish()]);
        }
        for action in wanted {
            self.ride.live.say(|at| Sample::action(at, &action));
        }
        for (_, texture) in screens {
            self.gpu.queue.present(texture);
        }
        self.ride.times.stage("show");
        Ok(true)
    }
}
