//! Window with the surface that is drawn on.

use crate::output::say::tell;
use render::{Gpu, GpuError};
use std::sync::Arc;
use std::time::Instant;
use studio::largest_side;
use walls::{TextureAnswer, TextureWaiter, WaiterGone};
use wgpu::CurrentSurfaceTexture as Current;
use winit::dpi::PhysicalSize;
use winit::window::Window;

/// Window together with its drawing surface.
pub struct WindowSurface {
    // Dropped before the surface: a texture on its way belongs to it.
    waiter: TextureWaiter<Arc<wgpu::Surface<'static>>, Current>,
    surface: Arc<wgpu::Surface<'static>>,
    /// Window of the operating system.
    pub window: Arc<Window>,
    /// Configuration of the window's surface.
    pub configuration: wgpu::SurfaceConfiguration,
    /// Size that is taken over when the surface's texture is no longer on its way.
    new_size: Option<PhysicalSize<u32>>,
    /// True while the surface can be drawn on: it is configured, and the window has an area.
    drawable: bool,
    /// True once a size beyond the device was told of.
    told: bool,
}

impl WindowSurface {
    /// Prepares `surface` of `window` for drawing.
    ///
    /// Every window waits for its monitor (`Fifo`): each frame is shown, whole, for at least one refresh, in all
    /// windows alike. `FifoRelaxed`, which `AutoVsync` prefers, tears where a frame is late; `Mailbox` shows the
    /// newest frame while windows beside it have an older one queued, so that eyes would be frames apart. Windows
    /// are waited for side by side, so several monitors take one refresh and not one each.
    ///
    /// # Errors
    /// [`GpuError::NoAdapter`] if the device cannot draw on the surface.
    pub fn new(gpu: &Gpu, window: Arc<Window>, surface: wgpu::Surface<'static>) -> Result<Self, GpuError> {
        let size = window.inner_size();
        let mut configuration = surface
            .get_default_config(&gpu.adapter, size.width.max(1), size.height.max(1))
            .ok_or_else(|| GpuError::NoAdapter("the window's surface has no format".to_owned()))?;
        let modes = surface.get_capabilities(&gpu.adapter).present_modes;
        let fifo = modes.contains(&wgpu::PresentMode::Fifo);
        configuration.present_mode = if fifo { wgpu::PresentMode::Fifo } else { wgpu::PresentMode::AutoVsync };
        // The interface mixes encoded colours, so the surface must not encode them once more.
        configuration.format = configuration.format.remove_srgb_suffix();
        let waiter = TextureWaiter::new(|surface: Arc<wgpu::Surface<'static>>| surface.get_current_texture())
            .map_err(|error| GpuError::Lost(format!("no thread for a window: {error}")))?;
        let surface = Arc::new(surface);
        let (new_size, drawable, told) = (None, false, false);
        let mut made = Self { waiter, surface, window, configuration, new_size, drawable, told };
        made.resize(gpu, size.max(PhysicalSize::new(1, 1)));
        Ok(made)
    }

    /// Width and height of the contents, pixels.
    pub fn size(&self) -> [u32; 2] {
        [self.configuration.width, self.configuration.height]
    }

    /// Takes over the window's new size, no larger than the device can draw. No texture of the surface may be held.
    pub fn resize(&mut self, gpu: &Gpu, size: PhysicalSize<u32>) {
        if self.waiter.is_out() {
            self.new_size = Some(size);
            return;
        }
        self.new_size = None;
        self.drawable = size.width > 0 && size.height > 0;
        if self.drawable {
            let (drawn, notice) = within([size.width, size.height], largest_side(gpu));
            [self.configuration.width, self.configuration.height] = drawn;
            self.surface.configure(&gpu.device, &self.configuration);
            if let Some(notice) = notice.filter(|_| !std::mem::replace(&mut self.told, true)) {
                tell(notice);
            }
        }
    }

    /// Asks for the texture of the next frame.
    ///
    /// # Errors
    /// [`GpuError::Lost`] if nobody can be asked any more.
    pub fn ask(&mut self) -> Result<(), GpuError> {
        if self.drawable { self.waiter.ask(|| Arc::clone(&self.surface)).map_err(gone) } else { Ok(()) }
    }

    /// Answer to the question for a texture, if it comes before `until`.
    ///
    /// # Errors
    /// [`GpuError::Lost`] for a surface that is lost and cannot be created again.
    pub fn answer(&mut self, gpu: &Gpu, until: Instant) -> Result<TextureAnswer<wgpu::SurfaceTexture>, GpuError> {
        if !self.drawable && !self.waiter.is_out() {
            return Ok(TextureAnswer::Unseen);
        }
        let Some(current) = self.waiter.answer(until).map_err(gone)? else { return Ok(TextureAnswer::NotYet) };
        let remade = match current {
            Current::Success(texture) | Current::Suboptimal(texture) => {
                if self.new_size.is_none() {
                    return Ok(TextureAnswer::Texture(texture));
                }
                // A texture of the size before is dropped ahead of the surface's configuration.
                drop(texture);
                false
            }
            Current::Lost => {
                let surface = gpu.instance.create_surface(Arc::clone(&self.window));
                self.surface = Arc::new(surface.map_err(|error| GpuError::Lost(error.to_string()))?);
                true
            }
            Current::Outdated => true,
            Current::Occluded if self.new_size.is_none() => return Ok(TextureAnswer::Unseen),
            Current::Timeout | Current::Occluded | Current::Validation => false,
        };
        let size = self.new_size.or_else(|| remade.then(|| self.window.inner_size()));
        if let Some(size) = size {
            self.resize(gpu, size);
        }
        Ok(TextureAnswer::NotYet)
    }
}

/// Loss of the device, as which the end of a waiter is reported.
fn gone(gone: WaiterGone) -> GpuError {
    GpuError::Lost(gone.to_string())
}

/// Width and height, pixels, of the part of a window that a device can draw whose largest side is `limit`; and a
/// sentence if that is not all of it.
fn within(size: [u32; 2], limit: u32) -> ([u32; 2], Option<String>) {
    let drawn = size.map(|side| side.clamp(1, limit.max(1)));
    let [[width, height], [drawn_width, drawn_height]] = [size, drawn];
    let notice = (width > drawn_width || height > drawn_height).then(|| {
        format!(
            "a window of {width} × {height} pixels is larger than this graphics device can draw; {drawn_width} × \
             {drawn_height} of them are drawn"
        )
    });
    (drawn, notice)
}

#[cfg(test)]
mod tests {
    //! Law: a window of any size gives a picture that the device can draw, and a sentence if that is not all of it.

    use super::*;

    #[test]
    fn a_window_beyond_the_device_is_drawn_in_part_and_said() {
        let (drawn, notice) = within([20_000, 300], 16_384);
        assert_eq!(drawn, [16_384, 300]);
        let sentence = "a window of 20000 × 300 pixels is larger than this graphics device can draw; 16384 × 300 of \
                        them are drawn";
        assert_eq!(notice.as_deref(), Some(sentence));
        assert_eq!(within([u32::MAX, u32::MAX], 8192).0, [8192, 8192]);
    }

    #[test]
    fn a_window_within_the_device_is_drawn_whole_without_a_word() {
        for size in [[1, 1], [1, 16_384], [16_384, 16_384], [1280, 720]] {
            assert_eq!(within(size, 16_384), (size, None));
        }
    }

    #[test]
    fn a_window_without_area_asks_for_a_pixel() {
        assert_eq!(within([0, 0], 16_384), ([1, 1], None));
        assert_eq!(within([0, 700], 16_384), ([1, 700], None));
    }
}
