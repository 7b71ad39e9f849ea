//! The window: events in, frames out.
//!
//! winit calls us for each event; a redraw advances the ride by one frame ([`Ride::frame`]) and asks for the next. Keys
//! go to the ride as samples, so that they are recorded like any device's; what only changes the picture (field of
//! view, effects, panels) stays here. A window that cannot be drawn in for the moment (occluded, being resized) is
//! skipped; a surface that was lost is made again.

mod hud;
mod interface;
mod keys;
mod panel;

use crate::command::RideOptions;
use crate::error::Error;
use crate::frame::{Pictured, Ride};
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
use crate::scene::Scene;
pub use hud::Readings;
use input::{Action, Sample, Source};
use interface::Interface;
pub use panel::Ride as RidePanel;
use panel::Settings;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;
use winit::application::ApplicationHandler;
use winit::dpi::PhysicalSize;
use winit::event::{ElementState, WindowEvent};
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

/// An open window and all that draws in it.
struct Open {
    gpu: Gpu,
    window: Arc<Window>,
    surface: wgpu::Surface<'static>,
    configuration: wgpu::SurfaceConfiguration,
    radiance: Radiance,
    format: Format,
    display: Display,
    adaptation: Adaptation,
    interface: Interface,
    settings: Settings,
    ride: Ride,
    /// Set by Ctrl-C: the recording is completed all the same.
    stop: Arc<AtomicBool>,
}

impl ApplicationHandler for Application {
    fn resumed(&mut self, events: &ActiveEventLoop) {
        if let Some((scene, live)) = self.waiting.take() {
            match Open::new(events, &self.options, scene, live) {
                Ok(open) => {
                    open.window.request_redraw();
                    self.open = Some(open);
                }
                Err(error) => self.fail(events, error),
            }
        }
    }

    fn window_event(&mut self, events: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        let Some(open) = &mut self.open else { return };
        match open.event(events, event) {
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
        let [width, height] = options.picture.size;
        let attributes = Window::default_attributes()
            .with_title(format!("Rapidity: {}", scene.name))
            .with_inner_size(PhysicalSize::new(width, height));
        let window = Arc::new(events.create_window(attributes).map_err(|error| Error::Window(error.to_string()))?);

        // The surface decides which device can draw in it.
        let instance = wgpu::Instance::new(descriptor());
        let surface =
            instance.create_surface(Arc::clone(&window)).map_err(|error| GpuError::NoAdapter(error.to_string()))?;
        let gpu = Gpu::with_instance(instance, Some(&surface))?;
        let size = window.inner_size();
        let mut configuration = surface
            .get_default_config(&gpu.adapter, size.width.max(1), size.height.max(1))
            .ok_or_else(|| GpuError::NoAdapter("the window's surface has no format".to_owned()))?;
        configuration.present_mode = wgpu::PresentMode::AutoVsync;
        // The interface mixes colours as they are encoded, so the surface must not encode once more.
        configuration.format = configuration.format.remove_srgb_suffix();
        surface.configure(&gpu.device, &configuration);

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
        let interface = Interface::new(&gpu, &window, configuration.format);
        Ok(Self {
            radiance: Radiance::new(&gpu, [configuration.width, configuration.height], format),
            display: Display::new(&gpu, format.colour, configuration.format),
            adaptation: Adaptation::new(&gpu),
            settings: Settings {
                open: false,
                help: false,
                readings: true,
                effects: options.picture.effects,
                latency: options.latency,
                fov: options.picture.fov,
                development: options.picture.development(),
            },
            ride: Ride::new(renderer, live()?),
            stop: interrupted(),
            gpu,
            window,
            surface,
            configuration,
            format,
            interface,
        })
    }

    fn event(&mut self, events: &ActiveEventLoop, event: WindowEvent) -> Result<(), Error> {
        let taken = self.interface.event(&self.window, &event);
        match event {
            WindowEvent::CloseRequested => events.exit(),
            WindowEvent::Resized(size) => self.resize(size),
            WindowEvent::Focused(false) => self.ride.live.say(|at| Sample::closed(at, Source::Keyboard)),
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
            WindowEvent::RedrawRequested => {
                if self.frame()? {
                    self.window.request_redraw();
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

    /// Keys that mean something to the window alone.
    fn window_key(&mut self, events: &ActiveEventLoop, code: KeyCode) {
        match code {
            KeyCode::Escape => events.exit(),
            KeyCode::F3 => self.settings.open = !self.settings.open,
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
            KeyCode::F11 => {
                let full = self.window.fullscreen().is_none().then_some(Fullscreen::Borderless(None));
                self.window.set_fullscreen(full);
            }
            _ => {}
        }
    }

    /// Makes the picture brighter by `stops`, and says so.
    fn expose(&mut self, stops: f32) {
        let exposure = self.settings.development.exposure.changed(stops);
        self.settings.development.exposure = exposure;
        self.ride.live.tell(format!("exposure: {exposure}"));
    }

    fn resize(&mut self, size: PhysicalSize<u32>) {
        if size.width == 0 || size.height == 0 {
            return;
        }
        (self.configuration.width, self.configuration.height) = (size.width, size.height);
        self.surface.configure(&self.gpu.device, &self.configuration);
        self.radiance = Radiance::new(&self.gpu, [size.width, size.height], self.format);
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
        use wgpu::CurrentSurfaceTexture as Current;
        let texture = match self.surface.get_current_texture() {
            Current::Success(texture) | Current::Suboptimal(texture) => texture,
            Current::Lost => {
                self.surface = self
                    .gpu
                    .instance
                    .create_surface(Arc::clone(&self.window))
                    .map_err(|error| GpuError::Lost(error.to_string()))?;
                self.resize(self.window.inner_size());
                return self.unseen();
            }
            Current::Outdated => {
                self.resize(self.window.inner_size());
                return self.unseen();
            }
            Current::Timeout | Current::Occluded | Current::Validation => return self.unseen(),
        };
        let screen = texture.texture.create_view(&wgpu::TextureViewDescriptor::default());

        // Devices to light, on one page: frame.rs.
        let look = Pictured {
            target: &self.radiance,
            fov: self.settings.fov,
            effects: self.settings.effects,
            latency: self.settings.latency,
        };
        let Some(events) = self.ride.frame(&self.gpu, &look)? else { return Ok(false) };

        // The eye adapts to it.
        let development = self.settings.development;
        let seen = Seen { radiance: self.radiance.result(), stored: self.ride.stored, elapsed_s: self.ride.elapsed_s };
        let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
        self.display.adapt(&self.gpu, &mut encoder, &mut self.adaptation, &seen, &development);
        self.gpu.queue.submit([encoder.finish()]);

        for action in events {
            match action {
                Action::ToggleHelp => self.settings.help = !self.settings.help,
                Action::ToggleRecording => self.ride.live.toggle_recording(),
                Action::Photo => {
                    let taken = photo::take(&self.gpu, &self.radiance, &self.adaptation, &development);
                    self.ride.live.tell(taken.unwrap_or_else(|error| error.to_string()));
                }
                _ => {}
            }
        }

        // Light to the window, and the display over it.
        let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
        let radiance = self.radiance.result();
        self.display.show(&self.gpu, &mut encoder, radiance, &self.adaptation, &development, &screen);
        let readings = self.ride.readings();
        let panel = self.ride.panel(&self.gpu);
        let settings = &mut self.settings;
        let mut wanted = Vec::new();
        let size = [texture.texture.width(), texture.texture.height()];
        self.interface.draw(&self.gpu, &self.window, &mut encoder, &screen, size, |ui| {
            if settings.readings {
                hud::show(ui, &readings);
            }
            wanted.extend(panel::show(ui, settings, &panel));
        });
        for action in wanted {
            self.ride.live.say(|at| Sample::action(at, &action));
        }
        self.gpu.queue.submit([encoder.finish()]);
        self.gpu.queue.present(texture);
        self.ride.pace.stage("show");
        Ok(true)
    }
}
