//! The window: events in, frames out.
//!
//! winit calls us for each event; a redraw advances the ride by one frame ([`Ride::frame`]) and asks for the next. Keys
//! go to the ride as samples, so that they are recorded like any device's; what only changes the picture (field of
//! view, effects, panels) stays here. A window that cannot be drawn in for the moment (occluded, being resized) is
//! skipped; a surface that was lost is made again. A room with screens has a window, or several, for its channels; they are drawn together,
//! and the first has the interface.

mod calibrating;
mod hud;
mod interface;
mod keys;
mod pane;
mod panel;

use crate::command::RideOptions;
use crate::error::Error;
use crate::frame::{Canvas, Pictured, Ride};
use crate::gpu::{Gpu, GpuError, descriptor};
use crate::live::Live;
use crate::photo;
use crate::progress;
use crate::render::interrupted;
use crate::renderers::SceneRenderer;
use crate::renderers::choice::Choice;
use crate::renderers::display::{Adaptation, Display, Seen, development};
use crate::renderers::polygon::Pace;
use crate::renderers::target::{Format, Radiance};
use crate::ride;
use crate::scene::Scene;
use crate::walls::preview::{Onlooker, Preview};
use crate::walls::{Quality, Walls};
use calibrating::Calibrating;
pub use hud::Readings;
use input::{Action, MouseButton, MouseEvent, Sample, Source};
use interface::Interface;
use pane::{Acquired, Pane};
pub use panel::Ride as RidePanel;
use panel::Settings;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;
use winit::application::ApplicationHandler;
use winit::dpi::{PhysicalPosition, PhysicalSize};
use winit::event::{ElementState, MouseScrollDelta, WindowEvent};
use winit::event_loop::{ActiveEventLoop, ControlFlow, EventLoop};
use winit::keyboard::{KeyCode, PhysicalKey};
use winit::window::{Fullscreen, Window, WindowId};

/// Samples a pixel in a window drawn by hardware, where they cost little; software draws one.
const HARDWARE_SAMPLES: u32 = 4;

/// What a press of an exposure key adds or takes.
const STOPS_PER_PRESS: f32 = 0.5;

/// Between two looks at a window that cannot be drawn in.
const UNSEEN_PAUSE: Duration = Duration::from_millis(10);

/// Whether there is a display to open a window on.
pub fn has_display() -> bool {
    !cfg!(all(unix, not(target_os = "macos")))
        || ["DISPLAY", "WAYLAND_DISPLAY"]
            .iter()
            .any(|name| std::env::var_os(name).is_some_and(|value| !value.is_empty()))
}

/// Opens the window and rides until it is closed.
///
/// # Errors
/// No display after all, no graphics device, or a fault while riding.
pub fn run(options: &RideOptions, scene: Scene, live: Begin) -> Result<(), Error> {
    let events = EventLoop::new().map_err(|error| Error::Window(error.to_string()))?;
    events.set_control_flow(ControlFlow::Wait);
    let mut application =
        Application { options: options.clone(), waiting: Some((scene, live)), open: None, failed: None };
    events.run_app(&mut application).map_err(|error| Error::Window(error.to_string()))?;
    let finished = application.open.map_or(Ok(()), |mut open| open.ride.live.finish());
    application.failed.map_or(finished, Err)
}

/// Begins the ride: called when everything else is ready, since the ride's clock starts with it.
pub type Begin = Box<dyn FnOnce() -> Result<Live, Error>>;

/// What winit calls.
struct Application {
    options: RideOptions,
    waiting: Option<(Scene, Begin)>,
    open: Option<Open>,
    failed: Option<Error>,
}

/// What the windows show.
enum Scenery {
    /// One picture, in the only window.
    Picture(Box<Single>),
    /// A room's channels, in as many windows as it names.
    Room(Box<Walls>),
    /// The room itself, in one window.
    Preview(Box<Previewed>),
}

/// One picture, and the eye that is adapted to it.
struct Single {
    radiance: Radiance,
    display: Display,
    adaptation: Adaptation,
}

/// A room that is looked at from outside.
struct Previewed {
    walls: Walls,
    preview: Preview,
    onlooker: Onlooker,
    /// Whether a button holds it.
    held: bool,
}

/// Open windows and all that draws in them.
struct Open {
    gpu: Gpu,
    /// The first one has the interface.
    panes: Vec<Pane>,
    scenery: Scenery,
    format: Format,
    interface: Interface,
    settings: Settings,
    /// Whether the mouse moves the head, and where it was last.
    mouse_moves_head: bool,
    /// A Shift key is down.
    shift: bool,
    /// What the display was named, and where its corners have been moved to.
    display_name: Option<String>,
    calibrating: Option<Calibrating>,
    cursor: Option<PhysicalPosition<f64>>,
    ride: Ride,
    /// Set by Ctrl-C: the recording is completed all the same.
    stop: Arc<AtomicBool>,
}

impl ApplicationHandler for Application {
    fn resumed(&mut self, events: &ActiveEventLoop) {
        if let Some((scene, live)) = self.waiting.take() {
            match Open::new(events, &self.options, scene, live) {
                Ok(open) => {
                    open.panes[0].window.request_redraw();
                    self.open = Some(open);
                }
                Err(error) => self.fail(events, error),
            }
        }
    }

    fn window_event(&mut self, events: &ActiveEventLoop, window: WindowId, event: WindowEvent) {
        let Some(open) = &mut self.open else { return };
        match open.event(events, window, event) {
            Ok(()) => {}
            Err(error) => self.fail(events, error),
        }
    }
}

impl Application {
    fn fail(&mut self, events: &ActiveEventLoop, error: Error) {
        self.failed.get_or_insert(error);
        events.exit();
    }
}

impl Open {
    fn new(events: &ActiveEventLoop, options: &RideOptions, scene: Scene, live: Begin) -> Result<Self, Error> {
        let display = ride::display(options)?;
        let title = format!("Rapidity: {}", scene.name);
        let attributes = match &display {
            Some(display) if !options.preview => {
                display.notices.iter().for_each(|notice| eprintln!("{}: {notice}", display.name));
                display.windows.iter().map(|place| pane::attributes(events, place, &title)).collect()
            }
            _ => {
                let [width, height] = options.picture.size;
                let size = PhysicalSize::new(width, height);
                vec![Window::default_attributes().with_title(&title).with_inner_size(size)]
            }
        };
        let mut windows = Vec::new();
        for attributes in attributes {
            let window = events.create_window(attributes).map_err(|error| Error::Window(error.to_string()))?;
            windows.push(Arc::new(window));
        }

        // The first surface decides which device can draw in it.
        let instance = wgpu::Instance::new(descriptor());
        let surface_of = |instance: &wgpu::Instance, window: &Arc<Window>| {
            instance.create_surface(Arc::clone(window)).map_err(|error| GpuError::NoAdapter(error.to_string()))
        };
        let first = surface_of(&instance, &windows[0])?;
        let gpu = Gpu::with_instance(instance, Some(&first))?;
        let mut panes = vec![Pane::new(&gpu, Arc::clone(&windows[0]), first, true)?];
        for window in &windows[1..] {
            // One wait a frame is enough.
            panes.push(Pane::new(&gpu, Arc::clone(window), surface_of(&gpu.instance, window)?, false)?);
        }
        let screen_format = panes[0].configuration.format;

        let samples = if gpu.is_software() || options.picture.samples == 1 { 1 } else { HARDWARE_SAMPLES };
        let format = Format::fast(samples);
        let picture = &options.picture;
        let bending = options.world.bending(Pace::Ride);
        let choice = Choice::of(scene, picture.renderer, bending, picture.map_of_windows(gpu.is_software()))?;
        let Choice { scene, method, because } = choice;
        eprintln!("{because}, on {}", gpu.description());
        let spinner = progress::spinner("uploading");
        let renderer = SceneRenderer::new(&gpu, &scene, format, options.picture.background, method)?;
        gpu.wait()?;
        spinner.finish_and_clear();
        let interface = Interface::new(&gpu, &panes[0].window, screen_format);
        let scenery = match display {
            Some(display) => {
                let quality = Quality { format, samples: 1, density: 1.0, smooth: true };
                let walls = Walls::new(&gpu, display, quality, screen_format);
                if options.preview {
                    let preview = Preview::new(&gpu, &walls, screen_format);
                    let onlooker = Onlooker::outside(&walls);
                    Scenery::Preview(Box::new(Previewed { walls, preview, onlooker, held: false }))
                } else {
                    Scenery::Room(Box::new(walls))
                }
            }
            None => Scenery::Picture(Box::new(Single {
                radiance: Radiance::new(&gpu, panes[0].size(), format),
                display: Display::new(&gpu, format.colour, screen_format),
                adaptation: Adaptation::new(&gpu),
            })),
        };
        Ok(Self {
            scenery,
            settings: Settings {
                open: false,
                help: false,
                readings: true,
                effects: options.picture.effects,
                latency: options.latency,
                fov: options.picture.fov,
                development: options.picture.development(),
            },
            mouse_moves_head: ride::mouse_moves_head(options)?,
            shift: false,
            display_name: options.display.clone(),
            calibrating: None,
            cursor: None,
            ride: Ride::new(renderer, live()?),
            stop: interrupted(),
            gpu,
            panes,
            format,
            interface,
        })
    }

    fn event(&mut self, events: &ActiveEventLoop, window: WindowId, event: WindowEvent) -> Result<(), Error> {
        let Some(pane) = self.panes.iter().position(|pane| pane.window.id() == window) else { return Ok(()) };
        // While corners are moved, no slider takes the keys.
        let offered = pane == 0 && !(self.calibrates() && matches!(event, WindowEvent::KeyboardInput { .. }));
        let taken = offered && self.interface.event(&self.panes[0].window, &event);
        match event {
            WindowEvent::CloseRequested => events.exit(),
            WindowEvent::Resized(size) => self.resize(pane, size),
            WindowEvent::Focused(false) => {
                self.ride.live.say(|at| Sample::closed(at, Source::Keyboard));
                if self.mouse_moves_head {
                    self.ride.live.say(|at| Sample::closed(at, Source::Mouse));
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
                        self.window_key(events, code);
                    }
                    // A slider that was clicked takes the arrows; a key that is let go is let go for everybody.
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
            WindowEvent::CursorLeft { .. } => self.cursor = None,
            WindowEvent::MouseInput { state, button, .. } => {
                let pressed = state == ElementState::Pressed;
                let button = match button {
                    winit::event::MouseButton::Left => Some(MouseButton::Left),
                    winit::event::MouseButton::Right => Some(MouseButton::Right),
                    winit::event::MouseButton::Middle => Some(MouseButton::Middle),
                    _ => None,
                };
                // A panel takes what is pressed on it; a button that is let go is let go for everybody.
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
            WindowEvent::RedrawRequested if pane == 0 => {
                if self.frame()? {
                    self.panes[0].window.request_redraw();
                } else {
                    events.exit();
                }
            }
            _ => {}
        }
        Ok(())
    }

    /// Keys that mean something to the ride.
    fn ride_key(&mut self, code: KeyCode, pressed: bool) {
        if let Some(key) = keys::key(code) {
            self.ride.live.say(|at| Sample::key(at, key, pressed));
        }
    }

    /// What the mouse does: it moves the head, or turns the room that is looked at.
    fn mouse(&mut self, event: MouseEvent) {
        /// Radians a pixel.
        const TURN_RAD: f64 = 0.005;
        /// Times a notch.
        const CLOSER: f64 = 1.1;
        if self.mouse_moves_head {
            self.ride.live.say(|at| Sample::mouse(at, event));
        } else if let Scenery::Preview(room) = &mut self.scenery {
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

    /// Keys that mean something to the window alone.
    fn window_key(&mut self, events: &ActiveEventLoop, code: KeyCode) {
        match code {
            KeyCode::Escape => events.exit(),
            KeyCode::F3 => self.settings.open = !self.settings.open,
            KeyCode::F4 => self.calibrate(),
            KeyCode::F2 => self.settings.readings = !self.settings.readings,
            KeyCode::KeyG => self.settings.effects.geometry = !self.settings.effects.geometry,
            KeyCode::KeyB => self.settings.effects.doppler = !self.settings.effects.doppler,
            KeyCode::KeyN => self.settings.effects.searchlight = !self.settings.effects.searchlight,
            KeyCode::KeyT => {
                let tone = development::next(self.settings.development.tone);
                self.settings.development.tone = tone;
                self.ride.live.tell(format!("tone curve: {}", development::name(&tone)));
            }
            KeyCode::BracketLeft => self.expose(-STOPS_PER_PRESS),
            KeyCode::BracketRight => self.expose(STOPS_PER_PRESS),
            KeyCode::F11 => self.fill_monitors(),
            _ => {}
        }
    }

    /// All windows over their whole monitors, or back.
    fn fill_monitors(&self) {
        for Pane { window, .. } in &self.panes {
            window.set_fullscreen(window.fullscreen().is_none().then_some(Fullscreen::Borderless(None)));
        }
    }

    /// Makes the picture brighter by `stops`, and says so.
    fn expose(&mut self, stops: f32) {
        let exposure = self.settings.development.exposure.changed(stops);
        self.settings.development.exposure = exposure;
        self.ride.live.tell(format!("exposure: {exposure}"));
    }

    fn resize(&mut self, pane: usize, size: PhysicalSize<u32>) {
        if self.panes[pane].resize(&self.gpu, size)
            && let Scenery::Picture(single) = &mut self.scenery
        {
            single.radiance = Radiance::new(&self.gpu, [size.width, size.height], self.format);
        }
    }

    /// One frame that nobody sees: the ride goes on all the same.
    fn unseen(&mut self) -> Result<bool, Error> {
        std::thread::sleep(UNSEEN_PAUSE);
        Ok(self.ride.live.frame()?.is_some())
    }

    /// One frame. Returns false when the ride is over.
    fn frame(&mut self) -> Result<bool, Error> {
        self.gpu.lost()?;
        if self.stop.load(Ordering::Relaxed) {
            return Ok(false);
        }
        // A window that cannot be drawn in for the moment is left out.
        let mut screens = Vec::new();
        for pane in 0..self.panes.len() {
            match self.panes[pane].acquire(&self.gpu)? {
                Acquired::Texture(texture) => screens.push((pane, texture)),
                Acquired::Resize(size) => self.resize(pane, size),
                Acquired::Nothing => {}
            }
        }
        if screens.is_empty() {
            return self.unseen();
        }

        // Devices to light, on one page: frame.rs.
        let canvas = match &mut self.scenery {
            Scenery::Picture(single) => Canvas::Picture { target: &single.radiance, fov: self.settings.fov },
            Scenery::Room(walls) => Canvas::Room(walls),
            Scenery::Preview(room) => Canvas::Room(&mut room.walls),
        };
        let look = Pictured { canvas, effects: self.settings.effects, latency: self.settings.latency };
        let Some(events) = self.ride.frame(&self.gpu, look)? else { return Ok(false) };

        // The eye adapts to it.
        let development = self.settings.development;
        let elapsed_s = self.ride.elapsed_s;
        match &mut self.scenery {
            Scenery::Picture(single) => {
                let Single { radiance, display, adaptation } = &mut **single;
                let seen = Seen { radiance: radiance.result(), stored: self.ride.stored, elapsed_s };
                let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
                display.adapt(&self.gpu, &mut encoder, adaptation, &seen, &development);
                self.gpu.queue.submit([encoder.finish()]);
            }
            Scenery::Room(walls) => walls.adapt(&self.gpu, &development, elapsed_s),
            Scenery::Preview(room) => room.walls.adapt(&self.gpu, &development, elapsed_s),
        }

        for action in events {
            match action {
                Action::ToggleHelp => self.settings.help = !self.settings.help,
                Action::ToggleRecording => self.ride.live.toggle_recording(),
                Action::Photo => {
                    let taken = match &mut self.scenery {
                        Scenery::Picture(single) => {
                            photo::take(&self.gpu, &single.radiance, &single.adaptation, &development)
                        }
                        Scenery::Room(walls) => photo::take_room(&self.gpu, walls, &development),
                        Scenery::Preview(room) => photo::take_room(&self.gpu, &mut room.walls, &development),
                    };
                    self.ride.live.tell(taken.unwrap_or_else(|error| error.to_string()));
                }
                _ => {}
            }
        }

        // Light to the windows, and the interface over the first.
        let readings = self.ride.readings();
        let panel = self.ride.panel(&self.gpu);
        let calibrating = self.calibrating.as_ref().filter(|calibrating| calibrating.active);
        let settings = &mut self.settings;
        let mut wanted = Vec::new();
        for (pane, texture) in &screens {
            let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
            let screen = texture.texture.create_view(&wgpu::TextureViewDescriptor::default());
            let window = &self.panes[*pane].window;
            match &mut self.scenery {
                Scenery::Picture(single) => {
                    let Single { radiance, display, adaptation } = &mut **single;
                    display.show(&self.gpu, &mut encoder, radiance.result(), adaptation, &development, &screen);
                }
                Scenery::Room(walls) => {
                    let first_pixel = window.inner_position().map_or([0, 0], |place| [place.x, place.y]);
                    walls.show_window(&self.gpu, &mut encoder, *pane, &development, &screen, first_pixel);
                }
                Scenery::Preview(_) => {}
            }
            if let (Scenery::Preview(room), Some(occupant)) = (&mut self.scenery, &self.ride.occupant) {
                let Previewed { walls, preview, onlooker, .. } = &mut **room;
                preview.draw(&self.gpu, &mut encoder, walls, (occupant, onlooker), &development, &screen);
            }
            if *pane == 0 {
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
        self.ride.pace.stage("show");
        Ok(true)
    }
}
