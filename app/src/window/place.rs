//! Place at which a window is opened: where its display says, or over all of its monitor.

use crate::output::say::tell;
use room::{Display, Monitor, WindowPlace};
use std::sync::Arc;
use winit::dpi::{PhysicalPosition, PhysicalSize};
use winit::event_loop::ActiveEventLoop;
use winit::monitor::MonitorHandle;
use winit::window::{Fullscreen, Window, WindowAttributes};

/// Largest side of a window, pixels: that of 16-bit coordinates, which display servers count in.
const LARGEST_SIDE: u32 = i16::MAX as u32;

/// Attributes with which a display's window is opened.
pub fn attributes(events: &ActiveEventLoop, place: &WindowPlace, title: &str) -> WindowAttributes {
    let monitor = place.monitor.as_ref().and_then(|wanted| find(events, wanted));
    let [width, height] = place.size.map(|side| side.min(LARGEST_SIDE));
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

/// Attributes of a window that fills its monitor, of a kiosk. They say all of it, because a kiosk often runs without a
/// window manager that would see to full screens. `size` is that of the window where no monitor is known.
pub fn filling(events: &ActiveEventLoop, wanted: Option<&Monitor>, size: [u32; 2], title: &str) -> WindowAttributes {
    let monitor = wanted.and_then(|wanted| find(events, wanted));
    let monitor = monitor.or_else(|| events.primary_monitor()).or_else(|| events.available_monitors().next());
    let mut attributes = Window::default_attributes().with_title(title).with_decorations(false);
    let [width, height] = size.map(|side| side.min(LARGEST_SIDE));
    attributes = attributes.with_inner_size(PhysicalSize::new(width, height));
    // A monitor that the system makes up has a pixel.
    if let Some(monitor) = monitor.as_ref().filter(|monitor| monitor.size().width > 1 && monitor.size().height > 1) {
        attributes = attributes.with_inner_size(monitor.size()).with_position(monitor.position());
    }
    attributes.with_fullscreen(Some(Fullscreen::Borderless(monitor)))
}

/// Fits what a kiosk shows into the windows that fill their monitors. Screens that nobody has measured take their
/// shape.
pub fn fit(display: &mut Display, windows: &[Arc<Window>], unmeasured: bool) {
    for (index, window) in windows.iter().enumerate() {
        if display.windows[index].fullscreen {
            display.resize_window(index, window.inner_size().into());
        }
    }
    if unmeasured {
        display.shape_screens_as_windows();
    }
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
