//! The headset in which a ride is shown, and its left picture in the window.

use super::surface_interface::SurfaceInterface;
use crate::canvas::Canvas;
use crate::error::Error;
use crate::output::say::tell;
use crate::session::start::HEADSET;
use egui::load::SizedTexture;
use egui::{Color32, LayerId, Pos2, Rect, Ui, Vec2};
use headset::{Headset, HeadsetDevice, HeadsetError};
use input::openxr::{XrRuntime, XrUse};
use render::Gpu;
use render::display::Development;
use render::target::texture;
use room::{Display, HeadsetEye};

/// Headset that is worn, or was.
pub(super) struct Worn {
    /// Session of the headset; `None` once it has ended.
    pub(super) session: Option<Headset>,
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
