//! The operator's window beside the audience's: the whole menu, devices with live values, the pace, and a small copy of
//! the audience's picture.

use super::surface_interface::SurfaceInterface;
use super::window_surface::WindowSurface;
use crate::canvas::Canvas;
use crate::error::Error;
use egui::load::SizedTexture;
use egui::{CentralPanel, Image, Panel, RichText, ScrollArea, Ui};
use input::Action;
use interface::{MenuPage, MenuRide, Readings};
use presentation::Presentation;
use render::target::texture;
use render::{Gpu, GpuError};
use std::sync::Arc;
use std::time::{Duration, Instant};
use walls::TextureAnswer;
use winit::dpi::PhysicalSize;
use winit::event::WindowEvent;
use winit::event_loop::ActiveEventLoop;
use winit::window::{Window, WindowId};
use words::{Language, Phrase};

/// Size of the window, pixels.
const SIZE: (u32, u32) = (980, 620);
/// Width of the copy of the audience's picture, points.
const COPY_WIDTH: f32 = 380.0;
/// Time between two copies, and between two pictures of this window: the audience's come first.
const COPY_PAUSE: Duration = Duration::from_millis(500);
const PAUSE: Duration = Duration::from_millis(100);

/// Window of the operator.
pub struct Operator {
    // Dropped before the window's surface.
    held: Option<wgpu::SurfaceTexture>,
    surface: WindowSurface,
    interface: SurfaceInterface,
    copy: Option<(wgpu::TextureView, egui::TextureId)>,
    copied: Instant,
    drawn: Instant,
    page: MenuPage,
}

/// What the operator sees.
pub struct Operated<'a> {
    /// How the ride is shown.
    pub presentation: &'a Presentation,
    /// Values of the head-up display.
    pub readings: &'a Readings,
    /// State that the menu shows.
    pub menu: &'a MenuRide,
}

impl Operator {
    /// Opens the window.
    ///
    /// # Errors
    /// A window or a surface that cannot be made.
    pub fn open(events: &ActiveEventLoop, gpu: &Gpu, language: Language) -> Result<Self, Error> {
        let size = PhysicalSize::new(SIZE.0, SIZE.1);
        let attributes =
            Window::default_attributes().with_title(language.text(Phrase::OperatorTitle)).with_inner_size(size);
        let window = events.create_window(attributes).map_err(|error| Error::Window(error.to_string()))?;
        let window = Arc::new(window);
        let surface = gpu.instance.create_surface(Arc::clone(&window));
        let surface = surface.map_err(|error| GpuError::NoAdapter(error.to_string()))?;
        let surface = WindowSurface::new(gpu, Arc::clone(&window), surface)?;
        let interface = SurfaceInterface::new(gpu, &window, surface.configuration.format);
        let now = Instant::now();
        Ok(Self { held: None, surface, interface, copy: None, copied: now, drawn: now, page: MenuPage::default() })
    }

    /// True for the operator's window.
    pub fn is(&self, window: WindowId) -> bool {
        self.surface.window.id() == window
    }

    /// Takes an event of the window. True once it is closed.
    pub fn event(&mut self, gpu: &Gpu, event: &WindowEvent) -> bool {
        self.interface.event(&self.surface.window, event);
        if let WindowEvent::Resized(size) = event {
            self.held = None;
            self.surface.resize(gpu, *size);
        }
        matches!(event, WindowEvent::CloseRequested)
    }

    /// Draws the window, if its monitor is ready and it is time. Returns the actions that the operator has chosen.
    ///
    /// # Errors
    /// A lost device.
    pub fn draw(&mut self, gpu: &Gpu, canvas: &mut Canvas, shown: &Operated<'_>) -> Result<Vec<Action>, Error> {
        let mut actions = Vec::new();
        if self.drawn.elapsed() < PAUSE {
            return Ok(actions);
        }
        if self.held.is_none() {
            self.surface.ask()?;
            if let TextureAnswer::Texture(texture) = self.surface.answer(gpu, Instant::now())? {
                self.held = Some(texture);
            }
        }
        let Some(target) = self.held.take() else { return Ok(actions) };
        self.drawn = Instant::now();
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        self.copy(gpu, &mut encoder, canvas, shown);
        let screen = target.texture.create_view(&wgpu::TextureViewDescriptor::default());
        drop(render::display::clear(&mut encoder, &screen));
        let size = [target.texture.width(), target.texture.height()];
        let (page, copy) = (&mut self.page, self.copy.as_ref());
        self.interface.draw(gpu, &self.surface.window, &mut encoder, &screen, size, |ui| {
            Panel::right("audience").exact_size(COPY_WIDTH + 20.0).show(ui, |ui| audience(ui, copy, shown));
            CentralPanel::default().show(ui, |ui| {
                ScrollArea::vertical().show(ui, |ui| {
                    actions.extend(interface::menu_contents(ui, page, shown.presentation, shown.menu));
                });
            });
        });
        gpu.queue.submit([encoder.finish()]);
        gpu.queue.present(target);
        Ok(actions)
    }

    /// Copies the audience's picture now and then.
    fn copy(&mut self, gpu: &Gpu, encoder: &mut wgpu::CommandEncoder, canvas: &mut Canvas, shown: &Operated<'_>) {
        if self.copy.is_some() && self.copied.elapsed() < COPY_PAUSE {
            return;
        }
        self.copied = Instant::now();
        let Some(size) = canvas.first_window_size() else { return };
        let fits = self.copy.take_if(|(view, _)| [view.texture().width(), view.texture().height()] != size);
        if let Some((_, id)) = fits {
            self.interface.forget(id);
        }
        let format = self.surface.configuration.format;
        let interface = &mut self.interface;
        let (view, _) = self.copy.get_or_insert_with(|| {
            let usage = wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING;
            let view = texture(gpu, "copy for the operator", size, format, 1, usage);
            let id = interface.register(gpu, &view);
            (view, id)
        });
        canvas.show(gpu, encoder, 0, &shown.presentation.development, view, [0, 0]);
    }
}

/// The audience's side: its picture, its speed, the pace, and what it is told.
fn audience(ui: &mut Ui, copy: Option<&(wgpu::TextureView, egui::TextureId)>, shown: &Operated<'_>) {
    if let Some((view, id)) = copy {
        let (width, height) = (view.texture().width() as f32, view.texture().height() as f32);
        let size = egui::vec2(COPY_WIDTH, COPY_WIDTH * height / width);
        ui.add(Image::from_texture(SizedTexture::new(*id, size)));
    }
    let readings = shown.readings;
    ui.separator();
    let language = shown.presentation.language;
    ui.label(RichText::new(interface::speed_line(readings, language)).heading());
    ui.label(interface::pace_line(readings, language));
    ui.label(RichText::new(&readings.certainty).small());
    for (name, ms) in &readings.stages_ms {
        ui.label(RichText::new(format!("{name}: {ms:.1} ms")).small());
    }
    ui.separator();
    for notice in &readings.notices {
        ui.label(notice);
    }
}
