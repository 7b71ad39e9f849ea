//! The headset in which a ride is shown: its head and hands come into the ride, its pictures go to its runtime, and the
//! left one to the window.

use super::open::Open;
use super::surface_interface::SurfaceInterface;
use crate::canvas::Canvas;
use crate::error::Error;
use crate::output::say::tell;
use crate::session::start::HEADSET;
use egui::load::SizedTexture;
use egui::{Color32, LayerId, Pos2, Rect, Ui, Vec2};
use hardware::heard;
use headset::{Headset, HeadsetDevice, HeadsetError, HeadsetTurn};
use input::openxr::{XrRuntime, XrUse};
use input::{Sample, SampleSource};
use render::Gpu;
use render::display::Development;
use render::target::texture;
use room::{Display, HeadsetEye};
use words::{Language, Phrase};

/// Headset that is worn, or was.
pub(super) struct Worn {
    /// Session of the headset; `None` once it has ended.
    session: Option<Headset>,
    /// Copy of the left eye's picture, for the window.
    mirror: Option<(wgpu::TextureView, egui::TextureId)>,
    format: wgpu::TextureFormat,
}

/// Reaches the headset. Returns the device that its runtime wants, and the display of its eyes.
///
/// # Errors
/// What is missing, with what to do about it.
pub(super) fn wear() -> Result<(Gpu, Worn, Display), Error> {
    let runtime = XrRuntime::new(XrUse::Pictures).map_err(HeadsetError::from)?;
    let device = HeadsetDevice::open(&runtime)?;
    let session = Headset::new(runtime, &device)?;
    let (headset, runtime) = session.names();
    tell(format_args!("headset: {headset}, by {runtime}"));
    let display = Display::headset(HEADSET, &HeadsetEye::USUAL, session.sizes());
    let format = session.format();
    Ok((device.gpu, Worn { session: Some(session), mirror: None, format }, display))
}

impl Worn {
    /// Format in which its pictures are written.
    pub(super) fn format(&self) -> wgpu::TextureFormat {
        self.format
    }

    /// Copies the left eye's picture for the window.
    pub(super) fn copy(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        (canvas, development): (&mut Canvas, &Development),
        interface: &mut SurfaceInterface,
    ) -> Option<SizedTexture> {
        let size = canvas.first_window_size()?;
        let (view, id) = self.mirror.get_or_insert_with(|| {
            let usage = wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING;
            let view = texture(gpu, "mirror", size, self.format, 1, usage);
            let id = interface.register(gpu, &view);
            (view, id)
        });
        canvas.show(gpu, encoder, 0, development, view, [0, 0]);
        Some(SizedTexture::new(*id, size.map(|side| side as f32)))
    }
}

/// Shows the left eye's picture in the window, whole.
pub(super) fn mirror(ui: &Ui, picture: SizedTexture) {
    let screen = ui.ctx().content_rect();
    let scale = (screen.size() / picture.size).min_elem();
    let place = Rect::from_center_size(screen.center(), picture.size * scale);
    let whole = Rect::from_min_size(Pos2::ZERO, Vec2::splat(1.0));
    ui.ctx().layer_painter(LayerId::background()).image(picture.id, place, whole, Color32::WHITE);
}

impl Open {
    /// Waits until the headset wants a frame, and brings its head and hands into the ride; `None` without a headset, or
    /// while it rests.
    pub(super) fn headset_turn(&mut self) -> Option<HeadsetTurn> {
        let session = self.worn.as_mut()?.session.as_mut()?;
        match session.wait() {
            Ok(None) => None,
            Ok(Some(turn)) => {
                if !self.ride.live.is_recorded() {
                    let report = turn.report.to_bytes();
                    self.ride.live.say(|at| Sample::bytes(at, SampleSource::Openxr, report));
                }
                if let Some(walls) = self.canvas.walls_mut() {
                    walls.headset = Some(turn.eyes);
                }
                Some(turn)
            }
            Err(error) => {
                self.lose_headset(&error);
                None
            }
        }
    }

    /// Hands the pictures of a turn over.
    ///
    /// # Errors
    /// A lost graphics device.
    pub(super) fn show_in_headset(&mut self, turn: &HeadsetTurn, development: &Development) -> Result<(), Error> {
        let Some(session) = self.worn.as_mut().and_then(|worn| worn.session.as_mut()) else { return Ok(()) };
        let (gpu, canvas) = (&self.gpu, &mut self.canvas);
        let shown = session.show(turn, |eye, view| {
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            canvas.show(gpu, &mut encoder, eye, development, view, [0, 0]);
            gpu.queue.submit([encoder.finish()]);
        });
        if let Err(error) = shown {
            self.lose_headset(&error);
        }
        Ok(self.gpu.lost()?)
    }

    /// Ends the session with the headset. The ride goes on in the window.
    fn lose_headset(&mut self, error: &HeadsetError) {
        if let Some(worn) = &mut self.worn {
            worn.session = None;
        }
        self.ride.live.say(|at| Sample::closed(at, SampleSource::Openxr));
        tell(Language::English.fill(Phrase::HeadsetLost, &[&sentence(error, Language::English)]));
        let language = self.presentation.language;
        let told = language.fill(Phrase::HeadsetLost, &[&sentence(error, language)]);
        self.ride.live.tell(told);
    }
}

/// Sentence on a headset that cannot be used.
fn sentence(error: &HeadsetError, language: Language) -> String {
    match error {
        HeadsetError::Runtime(fault) => heard::fault(&fault.clone().into(), language),
        HeadsetError::Device(_) | HeadsetError::Format => error.to_string(),
    }
}
