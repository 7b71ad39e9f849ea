//! Events of the windows: keys, mouse, sizes.

use super::open::Open;
use super::window_surface::WindowSurface;
use crate::canvas::Canvas;
use crate::error::Error;
use glam::DVec2;
use input::{Action, MouseButton, MouseEvent, Sample, SampleSource};
use winit::dpi::PhysicalSize;
use winit::event::{ElementState, MouseScrollDelta, WindowEvent};
use winit::event_loop::ActiveEventLoop;
use winit::keyboard::{KeyCode, PhysicalKey};
use winit::window::{Fullscreen, WindowId};

impl Open {
    /// Carries out an event of one of the windows.
    ///
    /// # Errors
    /// A fault while riding.
    pub fn event(&mut self, events: &ActiveEventLoop, window: WindowId, event: WindowEvent) -> Result<(), Error> {
        if let Some(operator) = self.operator.as_mut().filter(|operator| operator.is(window)) {
            if operator.event(&self.gpu, &event) {
                self.operator = None;
            }
            return Ok(());
        }
        let Some(number) = self.windows.iter().position(|surface| surface.window.id() == window) else { return Ok(()) };
        // While corners are moved, no slider takes the keys.
        let offered = number == 0 && !(self.calibrates() && matches!(event, WindowEvent::KeyboardInput { .. }));
        // The tabulator key shows the map; it does not walk through panels.
        let is_tab = matches!(&event, WindowEvent::KeyboardInput { event, .. }
            if event.physical_key == PhysicalKey::Code(KeyCode::Tab));
        let taken = offered && !is_tab && self.interface.event(&self.windows[0].window, &event);
        match event {
            WindowEvent::CloseRequested if self.kiosk => {}
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
                        self.entered |= code == KeyCode::Enter && self.room_interface.is_none();
                    }
                    // A slider that was clicked takes the arrows. The release of a key is passed on to everyone.
                    if !(taken && pressed) {
                        self.ride_key(code, pressed);
                    }
                }
            }
            WindowEvent::CursorMoved { position, .. } => {
                self.pointed = Some((number, DVec2::new(position.x, position.y)));
                let moved = self.cursor.replace(position).map(|before| (position.x - before.x, position.y - before.y));
                if let Some((right, down)) = moved {
                    self.mouse(MouseEvent::Moved { right: right as f32, down: down as f32 });
                }
            }
            WindowEvent::Touch(_) => self.ride.live.touch(),
            WindowEvent::CursorLeft { .. } => (self.cursor, self.pointed) = (None, None),
            WindowEvent::MouseInput { state, button, .. } => {
                let pressed = state == ElementState::Pressed;
                if pressed {
                    self.ride.live.touch();
                }
                if button == winit::event::MouseButton::Left {
                    self.mouse_pressed = pressed;
                    self.mouse_clicked |= pressed;
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
        if let Some(key) = cabin::key(code) {
            self.ride.live.say(|at| Sample::key(at, key, pressed));
        }
    }

    /// Moves the head with the mouse, turns the look, or turns the room in the preview.
    fn mouse(&mut self, event: MouseEvent) {
        /// Turn of the room, radians for each pixel.
        const TURN_RAD: f64 = 0.005;
        /// Factor of the distance for each notch of the wheel.
        const CLOSER: f64 = 1.1;
        let releases = matches!(event, MouseEvent::Button { pressed: false, .. });
        if self.room_interface.is_some() && self.presentation.menu && !releases {
            // The mouse points in the menu.
        } else if self.presentation.outside && !releases {
            let turn_rad = |right: f32, down: f32| [-TURN_RAD * f64::from(right), TURN_RAD * f64::from(down)];
            let (turn_rad, closer) = match event {
                MouseEvent::Button { button: MouseButton::Left, .. } => {
                    self.dragged = true;
                    return;
                }
                MouseEvent::Moved { right, down } if self.dragged => (turn_rad(right, down), 1.0),
                MouseEvent::Wheel(notches) => ([0.0; 2], CLOSER.powf(f64::from(notches))),
                _ => return,
            };
            self.ride.live.say(|at| Sample::action(at, &Action::Orbit { turn_rad, closer }));
        } else if self.mouse_moves_head {
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

    /// Switches between full screen and windows.
    pub(super) fn fill_monitors(&self) {
        for WindowSurface { window, .. } in &self.windows {
            window.set_fullscreen(window.fullscreen().is_none().then_some(Fullscreen::Borderless(None)));
        }
    }

    /// Takes over a window's new size. The texture that it holds has the size before.
    fn resize(&mut self, window: usize, size: PhysicalSize<u32>) {
        self.in_step.release(window);
        self.windows[window].resize(&self.gpu, size);
    }
}
