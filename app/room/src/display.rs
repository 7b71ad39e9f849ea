//! Display: viewer, screens, projectors, windows and channels, as plain data.

use crate::channel::Channel;
use crate::projector::Projector;
use crate::reflection::Reflection;
use crate::surface::shape::ScreenSurface;
use crate::viewer::{EyeSide, Viewer};
use crate::window::{Combine, WindowPlace};

/// Complete description of a display: viewer, screens, projectors, windows and channels.
#[derive(Clone, Debug, PartialEq)]
pub struct Display {
    /// Name for titles and messages: the file's `name`, or the name of the built-in display or of the file without
    /// its ending.
    pub name: String,
    /// Viewer in front of the screens.
    pub viewer: Viewer,
    /// Surfaces in the room.
    pub screens: Vec<Screen>,
    /// Projectors that light the screens, where the display describes them.
    pub projectors: Vec<Projector>,
    /// Windows that the display opens on monitors.
    pub windows: Vec<WindowPlace>,
    /// Views of the screens. Their indices are valid, and their viewports lie inside their windows.
    pub channels: Vec<Channel>,
    /// Tables of the file about the rider's hardware, such as `[tracker]`, unchanged; this crate does not interpret
    /// them.
    pub set_up: toml::Table,
    /// Requests of the file that are not fulfilled and other notes for the user, one sentence each.
    pub notices: Vec<String>,
}

/// Surface with a name and a reflection.
#[derive(Clone, Debug, PartialEq)]
pub struct Screen {
    /// Name, unique among the screens.
    pub name: String,
    /// Shape and place of the screen.
    pub surface: ScreenSurface,
    /// Reflection of the projectors' light by the screen.
    pub reflection: Reflection,
}

impl Display {
    /// Index of the channel that has the same pixels for the other eye, in a window that
    /// [combines](WindowPlace::combine) eyes.
    pub fn partner(&self, channel: usize) -> Option<usize> {
        let own = &self.channels[channel];
        let shares = |other: &Channel| {
            other.window == own.window && other.viewport == own.viewport && other.eye.side() == -own.eye.side()
        };
        let combines = self.windows[own.window].combine != Combine::None && own.eye != EyeSide::Centre;
        self.channels.iter().position(shares).filter(|_| combines)
    }
}
