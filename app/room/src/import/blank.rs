//! Display that an import begins with.

use crate::display::Display;
use crate::viewer::Viewer;
use glam::DVec3;

/// Display without anything in it, for a head at a place of the room, metres.
pub(super) fn blank(head_m: DVec3) -> Display {
    Display {
        name: String::new(),
        viewer: Viewer { head_m, ..Viewer::default() },
        screens: Vec::new(),
        projectors: Vec::new(),
        windows: Vec::new(),
        channels: Vec::new(),
        set_up: toml::Table::new(),
        notices: Vec::new(),
    }
}
