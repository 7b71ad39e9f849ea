//! Events of the windows: keys, mouse, sizes.

use super::keys;
use super::open::Open;
use super::window_surface::WindowSurface;
use crate::canvas::Canvas;
use crate::error::Error;
use input::{MouseButton, MouseEvent, Sample, SampleSource};
use render::display::development;
use winit::dpi::PhysicalSize;
use winit::event::{ElementState, MouseScrollDelta, WindowEvent};
use winit::event_loop::ActiveEventLoop;
use winit::keyboard::{KeyCode, PhysicalKey};
use winit::window::{Fullscreen, WindowId};

/// Stops by which an exposure key changes the exposure.
const STOPS_PER_PRESS: f32 = 0.5;

impl Open {
    /// Carries out an event of one of the windows.
    ///
    /// # Errors
    /// A fault while riding.
    pub fn event(&mut self, events: &ActiveEventLoop, window: WindowId, event: WindowEvent) -> Result<(), Error> {
        let Some(number) = self.windows.iter().position(|surface| surface.window.id() == window) else { return Ok(()) };
        // While corners are moved, no slider takes the keys.
        let offered = number == 0 && !(self.calibrates() && matches!(event, WindowEvent::KeyboardInput { .. }));
        let taken = offered && self.interface.event(&self.windows[0].window, &event);
        match event {
            WindowEvent::CloseRequested if self.settings.kiosk => {}
            WindowEvent::CloseRequested => events.exit(),
            WindowEvent::Resized(size) => self.resize(number, size),
            WindowEvent::Focused(false) => {
                self.ride.live.say(|at| Sample::closed(at, SampleSource::Keyboard));
                self.dragged = false;
                if self.mouse_moves_head || self.mouse_looks {
                    self.ride.live.say(|at| Sample::closed(at, SampleSource::Mouse));
                }
            }
            WindowEvent::KeyboardInput { event, is_synthetic: false, .. }
                if self.calibrates() && event.state == ElementState::Pressed =>
            {
                if let PhysicalKey::Code(code) = event.physical_key {
                    self.calibration_key(code, event.repeat);
                }
            }
            WindowEvent::KeyboardInput { event, is_synthetic: false, .. } if !event.repeat => {
                if let PhysicalKey::Code(code) = event.physical_key {
                    let pressed = event.state == ElementState::Pressed;
                    if pressed {
                        self.ride.live.touch();
                        self.window_key(events, code);
                    }
                    // A slider that was clicked takes the arrows. The release of a key is passed on to everyone.
                    if !(taken && pressed) {
                        self.ride_key(code, pressed);
                    }
                }
            }
            WindowEvent::CursorMoved { position, .. } => {
                let moved = self.cursor.replace(position).map(|before| (position.x - before.x, position.y - before.y));
                if let Some((right, down)) = moved {
                    self.mouse(MouseEvent::Moved { right: right as f32, down: down as f32 });
                }
            }
            WindowEvent::Touch(_) => self.ride.live.touch(),
            WindowEvent::CursorLeft { .. } => self.cursor = None,
            WindowEvent::MouseInput { state, button, .. } => {
                let pressed = state == ElementState::Pressed;
                if pressed {
                    self.ride.live.touch();
                }
                let button = match button {
                    winit::event::MouseButton::Left => Some(MouseButton::Left),
                    winit::event::MouseButton::Right => Some(MouseButton::Right),
                    winit::event::MouseButton::Middle => Some(MouseButton::Middle),
                    _ => None,
                };
                // A panel takes the buttons that are pressed on it. The release of a button is passed on to everyone.
                if let Some(button) = button.filter(|_| !(taken && pressed)) {
                    self.mouse(MouseEvent::Button { button, pressed });
                }
            }
            WindowEvent::MouseWheel { delta, .. } if !taken => {
                const PIXELS_PER_NOTCH: f64 = 40.0;
                let notches = match delta {
                    MouseScrollDelta::LineDelta(_, lines) => lines,
                    MouseScrollDelta::PixelDelta(pixels) => (pixels.y / PIXELS_PER_NOTCH) as f32,
                };
                self.mouse(MouseEvent::Wheel(notches));
            }
            WindowEvent::ModifiersChanged(modifiers) => {
                self.shift = modifiers.state().shift_key();
                self.mouse(MouseEvent::Shift(modifiers.state().shift_key()));
            }
            // All windows are drawn together.
            WindowEvent::RedrawRequested if number == 0 => {
                if self.frame()? {
                    self.windows[0].window.request_redraw();
                } else {
                    events.exit();
                }
            }
            _ => {}
        }
        Ok(())
    }

    /// Passes a key on to the ride.
    fn ride_key(&mut self, code: KeyCode, pressed: bool) {
        if let Some(key) = keys::key(code) {
            self.ride.live.say(|at| Sample::key(at, key, pressed));
        }
    }

    /// Moves the head with the mouse, turns the look, or turns the room in the preview.
    fn mouse(&mut self, event: MouseEvent) {
        /// Turn of the room, radians for each pixel.
        const TURN_RAD: f64 = 0.005;
        /// Factor of the distance for each notch of the wheel.
        const CLOSER: f64 = 1.1;
        if self.mouse_moves_head {
            self.ride.live.say(|at| Sample::mouse(at, event));
        } else if self.mouse_looks {
            self.look(event);
        } else if let Canvas::Preview(room) = &mut self.canvas {
            match event {
                MouseEvent::Button { pressed, .. } => room.held = pressed,
                MouseEvent::Moved { right, down } if room.held => {
                    room.onlooker.orbit(-TURN_RAD * f64::from(right), TURN_RAD * f64::from(down), 1.0);
                }
                MouseEvent::Wheel(notches) => room.onlooker.orbit(0.0, 0.0, CLOSER.powf(f64::from(notches))),
                _ => {}
            }
        }
    }

    /// Turns the look by a drag. Other motions of the mouse mean nothing, and are not recorded.
    fn look(&mut self, event: MouseEvent) {
        let means = match event {
            MouseEvent::Moved { .. } => self.dragged,
            MouseEvent::Button { button: MouseButton::Left, pressed } => {
                std::mem::replace(&mut self.dragged, pressed) != pressed
            }
            MouseEvent::Button { button: MouseButton::Middle, pressed } => pressed,
            _ => false,
        };
        if means {
            self.ride.live.say(|at| Sample::mouse(at, event));
        }
    }

    /// Carries out a key that concerns the window alone.
    fn window_key(&mut self, events: &ActiveEventLoop, code: KeyCode) {
        match code {
            KeyCode::Escape | KeyCode::F3 | KeyCode::F4 | KeyCode::F11 if self.settings.kiosk => {}
            KeyCode::Escape => events.exit(),
            KeyCode::F3 => self.settings.open = !self.settings.open,
            KeyCode::F4 => self.calibrate(),
            KeyCode::F2 => self.settings.readings = !self.settings.readings,
            KeyCode::KeyG => {
                let places = self.settings.look.effects.places.next();
                self.settings.look.effects.places = places;
                self.ride.live.tell(format!("places: {}", places.name()));
            }
            KeyCode::KeyB => self.settings.look.effects.doppler = !self.settings.look.effects.doppler,
            KeyCode::KeyN => self.settings.look.effects.searchlight = !self.settings.look.effects.searchlight,
            KeyCode::KeyT => {
                let tone = development::next(self.settings.look.development.tone);
                self.settings.look.development.tone = tone;
                self.ride.live.tell(format!("tone curve: {}", development::name(&tone)));
            }
            KeyCode::BracketLeft => self.expose(-STOPS_PER_PRESS),
            KeyCode::BracketRight => self.expose(STOPS_PER_PRESS),
            KeyCode::F11 => self.fill_monitors(),
            _ => {}
        }
    }

    /// Switches between full screen and windows.
    pub(super) fn fill_monitors(&self) {
        for WindowSurface { window, .. } in &self.windows {
            window.set_fullscreen(window.fullscreen().is_none().then_some(Fullscreen::Borderless(None)));
        }
    }

    /// Brightens the picture by `stops`, and tells the rider.
    fn expose(&mut self, stops: f32) {
        let exposure = self.settings.look.development.exposure.changed(stops);
        self.settings.look.development.exposure = exposure;
        self.ride.live.tell(format!("exposure: {exposure}"));
    }

    /// Takes over a window's new size. The texture that it holds has the size before.
    fn resize(&mut self, window: usize, size: PhysicalSize<u32>) {
        self.in_step.release(window);
        self.windows[window].resize(&self.gpu, size);
    }
}
