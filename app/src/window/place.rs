//! Place at which a display's window is opened.

use crate::output::say::tell;
use room::{Monitor, WindowPlace};
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
