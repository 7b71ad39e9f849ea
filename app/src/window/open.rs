//! Open windows, and everything that draws in them.

use super::calibrating::Calibrating;
use super::headset::{Worn, wear};
use super::operator::Operator;
use super::place::{attributes, filling, fit};
use super::server_loss;
use super::surface_interface::SurfaceInterface;
use super::window_surface::WindowSurface;
use crate::canvas::Canvas;
use crate::error::Error;
use crate::frame::RideInProgress;
use crate::output::progress;
use crate::output::say::tell;
use crate::session::interrupt::interruption;
use crate::session::making::Making;
use crate::session::start::RideRoom;
use crate::session::waiting::WaitingRide;
use cabin::{Guide, RoomInterface, UnfeltMotion};
use command::{RideOptions, map_scale_of_windows};
use glam::DVec2;
use hardware::{DESK, WINDOW};
use interface::MenuPage;
use presentation::Presentation;
use render::choice::Choice;
use render::target::{Format, texture};
use render::{Gpu, GpuError, SceneRenderer, descriptor};
use room::WindowPlace;
use scene::Scene;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use studio::largest_side;
use tours::TourPlan;
use view::{Dial, Occasion};
use walls::{FlatPicture, Quality, Walls, WindowsInStep};
use winit::dpi::{PhysicalPosition, PhysicalSize};
use winit::event_loop::ActiveEventLoop;
use winit::window::Window;

/// Open windows, and everything that draws in them.
pub struct Open {
    pub(super) gpu: Gpu,
    // Dropped before the windows: textures belong to their surfaces.
    /// Textures that windows hold for the next frame.
    pub(super) in_step: WindowsInStep<wgpu::SurfaceTexture>,
    /// Window of the operator, if there is one.
    pub(super) operator: Option<Operator>,
    /// Windows; the first has the interface.
    pub(super) windows: Vec<WindowSurface>,
    pub(super) canvas: Canvas,
    pub(super) interface: SurfaceInterface,
    /// How the ride is shown at present.
    pub(super) presentation: Presentation,
    /// How a fresh ride is shown, which a kiosk returns to.
    pub(super) fresh: Presentation,
    /// What explains the ride.
    pub(super) guide: Guide,
    /// Headset in which the ride is shown, if it is.
    pub(super) worn: Option<Worn>,
    /// Motion that whoever wears it does not feel.
    pub(super) unfelt: UnfeltMotion,
    /// Interface in a room of several screens; otherwise it is drawn over the window's picture.
    pub(super) room_interface: Option<RoomInterface>,
    /// Window and pixel of the mouse, and true while its left button is held.
    pub(super) pointed: Option<(usize, DVec2)>,
    pub(super) mouse_pressed: bool,
    /// True if the left button was pressed since the picture drawn last.
    pub(super) mouse_clicked: bool,
    /// Keys of the menu, pressed by actions since the last picture.
    pub(super) menu_keys: Vec<egui::Key>,
    /// True after a press of the enter key, which the panels take by themselves.
    pub(super) entered: bool,
    /// Tours of the program, by their names.
    pub(super) tours: Vec<(&'static str, TourPlan)>,
    /// Page of the menu.
    pub(super) page: MenuPage,
    /// Format in which the renderer draws.
    pub(super) format: Format,
    /// True in a kiosk.
    pub(super) kiosk: bool,
    /// True once the rider has asked for the end.
    pub(super) leaves: bool,
    /// True if the mouse moves the head.
    pub(super) mouse_moves_head: bool,
    /// True if the mouse turns the look.
    pub(super) mouse_looks: bool,
    /// True while a drag turns the look.
    pub(super) dragged: bool,
    /// True while a Shift key is down.
    pub(super) shift: bool,
    /// Options of the present ride.
    pub(super) options: RideOptions,
    /// Room of the ride.
    pub(super) room: RideRoom,
    /// Way of drawing that was asked for, and the one that draws.
    pub(super) dial: Dial,
    pub(super) drawn_by: Dial,
    /// True if a clock drives something in the scene, so that it changes with the speed of light.
    pub(super) has_clockwork: bool,
    /// What is made ready to be shown next.
    pub(super) making: Option<Making>,
    /// Corners of the channels, once they have been moved.
    pub(super) calibrating: Option<Calibrating>,
    /// Place of the mouse, pixels.
    pub(super) cursor: Option<PhysicalPosition<f64>>,
    pub(super) ride: RideInProgress,
    /// Flag that Ctrl-C sets. The recording is completed all the same.
    pub(super) stop: Arc<AtomicBool>,
}

impl Open {
    /// Opens the windows, uploads the scene, and begins the ride.
    ///
    /// # Errors
    /// A missing window or graphics device, or a ride that cannot begin.
    pub fn new(events: &ActiveEventLoop, waiting: WaitingRide) -> Result<Self, Error> {
        let WaitingRide { options, scene, room, presentation, begin } = waiting;
        let mouse_moves_head = options.replay.is_none() && room.mouse_moves_head();
        let turns = room.display.as_ref().is_none_or(|display| display.viewer.turns_pictures && !options.preview);
        let mouse_looks = options.replay.is_none() && room.head.is_none() && turns;
        let kiosk = options.kiosk.kiosk;
        let mut display = room.display.clone();
        let (device, mut worn) = match room.is_headset() {
            false => (None, None),
            true => {
                let (gpu, worn, eyes) = wear(options.frame_rate, room.head.as_ref())?;
                display = Some(eyes);
                (Some(gpu), Some(worn))
            }
        };
        let in_windows = kiosk && worn.is_none();
        if let Some(display) = display.as_mut().filter(|_| in_windows) {
            display.fill_monitors();
        }
        let title = title(&scene.name);
        let attributes = match &display {
            Some(display) if !options.preview && worn.is_none() => {
                display.notices.iter().for_each(|notice| tell(format_args!("{}: {notice}", display.name)));
                let of_place = |place: &WindowPlace| match kiosk && place.fullscreen {
                    true => filling(events, place.monitor.as_ref(), place.size, &format!("{title}: {}", place.name)),
                    false => attributes(events, place, &title),
                };
                display.windows.iter().map(of_place).collect()
            }
            _ if kiosk => vec![filling(events, None, options.picture.size, &title)],
            _ => {
                let [width, height] = options.picture.size;
                let size = PhysicalSize::new(width, height);
                vec![Window::default_attributes().with_title(&title).with_inner_size(size)]
            }
        };
        let mut windows = Vec::new();
        for attributes in attributes {
            let window = events.create_window(attributes).map_err(|error| Error::Window(error.to_string()))?;
            window.set_cursor_visible(!kiosk);
            windows.push(Arc::new(window));
        }
        if let Some(display) = display.as_mut().filter(|_| in_windows) {
            fit(display, &windows, options.display.as_deref().is_none_or(|name| [WINDOW, DESK].contains(&name)));
        }

        server_loss::outlive(&windows[0]);

        // The first surface decides which device can draw in it.
        let surface_of = |instance: &wgpu::Instance, window: &Arc<Window>| {
            instance.create_surface(Arc::clone(window)).map_err(|error| GpuError::NoAdapter(error.to_string()))
        };
        let (gpu, first) = match device {
            Some(gpu) => {
                let first = surface_of(&gpu.instance, &windows[0])?;
                (gpu, first)
            }
            None => {
                let instance = wgpu::Instance::new(descriptor());
                let first = surface_of(&instance, &windows[0])?;
                (Gpu::with_instance(instance, Some(&first))?, first)
            }
        };
        let mut surfaces = vec![WindowSurface::new(&gpu, Arc::clone(&windows[0]), first)?];
        for window in &windows[1..] {
            surfaces.push(WindowSurface::new(&gpu, Arc::clone(window), surface_of(&gpu.instance, window)?)?);
        }
        let screen_format = surfaces[0].configuration.format;

        let format = Format::fast(options.samples(gpu.is_software()));
        let dial = options.dial(gpu.is_software());
        let guide = Guide::new(&scene);
        let has_clockwork = has_clockwork(&scene);
        let spinner = progress::cutting(dial);
        let start = scene.start;
        let choice = Choice::of(scene, dial, Occasion::Ride)?;
        spinner.finish_and_clear();
        tell(format_args!("{}, on {}", choice.because, gpu.description()));
        let drawn_by = choice.dial;
        let spinner = progress::spinner("uploading");
        let mut renderer = upload(&gpu, choice, &options, format)?;
        spinner.finish_and_clear();
        let interface = SurfaceInterface::new(&gpu, &surfaces[0].window, screen_format);
        let mut canvas = match display {
            Some(mut display) => {
                let smaller = display.shrink_to(largest_side(&gpu));
                smaller.iter().for_each(|notice| tell(format_args!("{}: {notice}", display.name)));
                let quality = Quality { format, samples: 1, density: 1.0, smooth: true };
                let written = worn.as_ref().map_or(screen_format, Worn::format);
                let mut walls = Walls::new(&gpu, display, quality, written);
                if let Some(worn) = &mut worn {
                    worn.fit(&gpu, &mut walls);
                }
                if options.preview && worn.is_none() {
                    Canvas::preview(&gpu, walls, screen_format)
                } else {
                    Canvas::Room(Box::new(walls))
                }
            }
            None => {
                let map_scale = map_scale(&gpu, drawn_by);
                let size = surfaces[0].size();
                Canvas::Picture(Box::new(FlatPicture::new(&gpu, size, format, screen_format, map_scale)))
            }
        };
        let fresh = presentation;
        let room_interface = match &canvas {
            Canvas::Room(walls) => Some(&walls.display),
            // The onlooker of a room has one flat window.
            Canvas::Preview(_) | Canvas::Picture(_) => None,
        };
        let room_interface = room_interface.filter(|display| display.channels.len() > 1);
        let room_interface = room_interface.map(|display| RoomInterface::new(&gpu, display));
        let spinner = progress::spinner("drawing the first picture");
        let shown = (fresh.effects, fresh.fov_deg, &fresh.development);
        let unseen = unseen(&gpu, &surfaces, &canvas);
        let took = canvas.warm_up(&gpu, &mut renderer, &start, shown, &unseen)?;
        spinner.finish_and_clear();
        let mut ride = RideInProgress::new(renderer, begin()?, options.frame_rate.unwrap_or_default().governor());
        ride.begin(&mut canvas, took);
        let operator = options.operator.then(|| Operator::open(events, &gpu, fresh.language)).transpose()?;
        Ok(Self {
            operator,
            canvas,
            presentation: fresh,
            fresh,
            guide,
            worn,
            unfelt: UnfeltMotion::default(),
            room_interface,
            pointed: None,
            mouse_pressed: false,
            mouse_clicked: false,
            menu_keys: Vec::new(),
            entered: false,
            tours: tours::built_in_plans(),
            page: MenuPage::default(),
            format,
            kiosk,
            leaves: false,
            mouse_moves_head,
            mouse_looks,
            dragged: false,
            shift: false,
            options,
            room,
            dial,
            drawn_by,
            has_clockwork,
            making: None,
            calibrating: None,
            cursor: None,
            ride,
            stop: interruption(),
            gpu,
            in_step: WindowsInStep::new(surfaces.len()),
            windows: surfaces,
            interface,
        })
    }
}

/// Title of the windows of a ride in a scene of this name.
pub(super) fn title(scene: &str) -> String {
    format!("Rapidity: {scene}")
}

/// True if a clock drives something in a scene.
pub(super) fn has_clockwork(scene: &Scene) -> bool {
    scene.motions.iter().any(|motion| motion.animated().is_some())
}

/// Texels of a map for each pixel of a flat picture.
pub(super) fn map_scale(gpu: &Gpu, dial: Dial) -> f64 {
    dial.map_scale.unwrap_or(map_scale_of_windows(gpu.is_software()))
}

/// Renderer of a chosen scene, on the device.
///
/// # Errors
/// A scene whose origin is not finite, or a lost device.
pub(super) fn upload(gpu: &Gpu, choice: Choice, options: &RideOptions, format: Format) -> Result<SceneRenderer, Error> {
    let Choice { scene, dial, .. } = choice;
    let renderer = SceneRenderer::new(gpu, scene, format, options.picture.background, dial, Occasion::Ride)?;
    gpu.wait()?;
    Ok(renderer)
}

/// Pictures as large as those of the windows, or of a headset's eyes, which nobody sees.
pub(super) fn unseen(gpu: &Gpu, surfaces: &[WindowSurface], canvas: &Canvas) -> Vec<wgpu::TextureView> {
    let usage = wgpu::TextureUsages::RENDER_ATTACHMENT;
    if let Canvas::Room(walls) = canvas
        && walls.headset.is_some()
    {
        let eyes = walls.display.windows.iter();
        return eyes.map(|eye| texture(gpu, "unseen", eye.size, walls.format(), 1, usage)).collect();
    }
    let screen =
        |surface: &WindowSurface| texture(gpu, "unseen", surface.size(), surface.configuration.format, 1, usage);
    surfaces.iter().map(screen).collect()
}
