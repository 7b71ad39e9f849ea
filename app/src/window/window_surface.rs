//! Window with the surface that is drawn on.

use crate::output::say::tell;
use render::picture::largest_side;
use render::{Gpu, GpuError};
use room::{Monitor, WindowPlace};
use std::sync::Arc;
use winit::dpi::{PhysicalPosition, PhysicalSize};
use winit::event_loop::ActiveEventLoop;
use winit::monitor::MonitorHandle;
use winit::window::{Fullscreen, Window, WindowAttributes};

/// Window together with its drawing surface.
pub struct WindowSurface {
    /// Window of the operating system.
    pub window: Arc<Window>,
    surface: wgpu::Surface<'static>,
    /// Configuration of the window's surface.
    pub configuration: wgpu::SurfaceConfiguration,
}

impl WindowSurface {
    /// Prepares `surface` of `window` for drawing. `waits` is true if each frame waits until the monitor has shown
    /// the one before.
    ///
    /// # Errors
    /// [`GpuError::NoAdapter`] if the device cannot draw on the surface.
    pub fn new(gpu: &Gpu, window: Arc<Window>, surface: wgpu::Surface<'static>, waits: bool) -> Result<Self, GpuError> {
        let size = window.inner_size();
        let mut configuration = surface
            .get_default_config(&gpu.adapter, size.width.max(1), size.height.max(1))
            .ok_or_else(|| GpuError::NoAdapter("the window's surface has no format".to_owned()))?;
        configuration.present_mode = if waits { wgpu::PresentMode::AutoVsync } else { wgpu::PresentMode::AutoNoVsync };
        // The interface mixes encoded colours, so the surface must not encode them once more.
        configuration.format = configuration.format.remove_srgb_suffix();
        [configuration.width, configuration.height] = drawable(gpu, size);
        if [configuration.width, configuration.height] != [size.width.max(1), size.height.max(1)] {
            tell(format_args!(
                "a window of {} × {} pixels is larger than this graphics device can draw; {} × {} of them are drawn",
                size.width, size.height, configuration.width, configuration.height
            ));
        }
        surface.configure(&gpu.device, &configuration);
        Ok(Self { window, surface, configuration })
    }

    /// Width and height of the contents, pixels.
    pub fn size(&self) -> [u32; 2] {
        [self.configuration.width, self.configuration.height]
    }

    /// Takes over the window's new size. Returns false if it has no area to draw in.
    pub fn resize(&mut self, gpu: &Gpu, size: PhysicalSize<u32>) -> bool {
        if size.width == 0 || size.height == 0 {
            return false;
        }
        [self.configuration.width, self.configuration.height] = drawable(gpu, size);
        self.surface.configure(&gpu.device, &self.configuration);
        true
    }

    /// Texture for the next frame, or the reason why there is none at the moment.
    ///
    /// # Errors
    /// [`GpuError::Lost`] for a surface that is lost and cannot be created again.
    pub fn acquire(&mut self, gpu: &Gpu) -> Result<Acquired, GpuError> {
        use wgpu::CurrentSurfaceTexture as Current;
        Ok(match self.surface.get_current_texture() {
            Current::Success(texture) | Current::Suboptimal(texture) => Acquired::Texture(texture),
            Current::Lost => {
                self.surface = gpu
                    .instance
                    .create_surface(Arc::clone(&self.window))
                    .map_err(|error| GpuError::Lost(error.to_string()))?;
                Acquired::Resize(self.window.inner_size())
            }
            Current::Outdated => Acquired::Resize(self.window.inner_size()),
            Current::Timeout | Current::Occluded | Current::Validation => Acquired::Nothing,
        })
    }
}

/// Width and height of a window's contents that the device can draw, pixels.
fn drawable(gpu: &Gpu, size: PhysicalSize<u32>) -> [u32; 2] {
    [size.width, size.height].map(|side| side.clamp(1, largest_side(gpu)))
}

/// Answer of a window that is asked for its next texture.
pub enum Acquired {
    /// The texture of the next frame.
    Texture(wgpu::SurfaceTexture),
    /// A surface that must first be resized to this size.
    Resize(PhysicalSize<u32>),
    /// A surface without a texture at the moment.
    Nothing,
}

/// Attributes with which a display's window is opened.
pub fn attributes(events: &ActiveEventLoop, place: &WindowPlace, title: &str) -> WindowAttributes {
    let monitor = place.monitor.as_ref().and_then(|wanted| find(events, wanted));
    let [width, height] = place.size;
    let mut attributes = Window::default_attributes()
        .with_title(format!("{title}: {}", place.name))
        .with_inner_size(PhysicalSize::new(width, height))
        .with_decorations(!place.fullscreen);
    let from = monitor.as_ref().map_or(PhysicalPosition::new(0, 0), MonitorHandle::position);
    if let Some([x, y]) = place.position {
        attributes = attributes.with_position(PhysicalPosition::new(from.x + x, from.y + y));
    } else if monitor.is_some() {
        attributes = attributes.with_position(from);
    }
    if place.fullscreen {
        attributes = attributes.with_fullscreen(Some(Fullscreen::Borderless(monitor)));
    }
    attributes
}

/// Monitor that a display names, if it is connected.
fn find(events: &ActiveEventLoop, wanted: &Monitor) -> Option<MonitorHandle> {
    let mut monitors = events.available_monitors();
    let found = match wanted {
        Monitor::Index(index) => monitors.nth(*index),
        Monitor::Name(name) => monitors.find(|monitor| monitor.name().as_deref() == Some(name)),
    };
    if found.is_none() {
        let names: Vec<_> = events.available_monitors().filter_map(|monitor| monitor.name()).collect();
        let wanted = match wanted {
            Monitor::Index(index) => format!("number {index}"),
            Monitor::Name(name) => name.clone(),
        };
        tell(format_args!("there is no monitor {wanted}; there are {}", names.join(", ")));
    }
    found
}
