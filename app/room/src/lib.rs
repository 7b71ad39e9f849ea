//! Room around the viewer: which surface shows which part of the world, for which eye, in which window.
//!
//! A [`Display`] is plain data. It comes from a TOML file ([`mod@file`]), is built in ([`built_in`]), or is imported
//! (MPCDI, ParaView's `.pvx`: [`Display::load`]). It lists *screens* (surfaces in the room), *windows* (pixels of a
//! monitor), *projectors* and *channels*. A channel shows one screen to one eye in a rectangle of a window. In
//! essence it is a map
//!
//! ```text
//! pixel ─ warp ─► place in the picture ─ lens, ray ─► point on the surface
//!       ─ minus the eye ─► direction that the eye sees
//! ```
//!
//! (B eq. 4.1–4.3). Only the last step depends on the eye, so [`Channel::point`] can be tabulated once. A flat screen
//! on which the pixels lie in even rows needs no table: [`Channel::flat`] returns its rectangle, and [`frustum()`]
//! gives the off-axis frustum for any eye.
//!
//! *Frame.* The room's axes are those of the vehicle: metres, x right, y up, −z ahead. Angles in files are degrees:
//! yaw turns about +y (to the left), pitch about +x (up), roll about +z (counter-clockwise when looking along −z).
//! They are applied in this order, each about the axes turned by the ones before. Places in a picture run from 0 to
//! 1, x to the right and y *down* from the upper left. Places on a surface (uv) run from 0 to 1, u to the right and v
//! *up* from the lower left, both as seen by the viewer.

pub mod built_in;
mod channel;
mod error;
pub mod file;
mod frustum;
mod gains;
mod grid_file;
mod import;
mod maps;
mod net;
mod pfm;
pub mod projector;
mod read;
mod report;
pub mod surface;
mod viewer;
mod warp;
mod window;

pub use channel::{Channel, Part};
pub use error::{At, DisplayError};
pub use frustum::{EyeBehind, Frustum, frustum};
pub use gains::{Gains, Map, Reflection};
pub use projector::{Lens, Projector};
pub use surface::{Cylinder, Flat, Hit, Mesh, Sphere, Surface};
pub use viewer::{Eye, Viewer};
pub use warp::{Corners, Measured, NotConvex, Warp};
pub use window::{Combine, Monitor, WindowPlace};

use glam::{DMat3, DVec3};
use std::path::Path;

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
    /// Table `[tracker]` of the file, unchanged; this module does not interpret it.
    pub tracker: Option<toml::Value>,
    /// Requests of the file that are not fulfilled and other notes for the user, one sentence each.
    pub notices: Vec<String>,
}

/// Surface with a name and a reflection.
#[derive(Clone, Debug, PartialEq)]
pub struct Screen {
    /// Name, unique among the screens.
    pub name: String,
    /// Shape and place of the screen.
    pub surface: Surface,
    /// Reflection of the projectors' light by the screen.
    pub reflection: Reflection,
}

impl Display {
    /// Reads a display file: `.toml`, or a file of another program: `.pvx`, `.mpcdi`, `.mpcdi.xml`.
    ///
    /// # Errors
    /// [`DisplayError`] with file, line, key and reason.
    pub fn load(path: &Path) -> Result<Self, DisplayError> {
        if import::is_imported(path) { import::load(path) } else { file::load(path) }
    }

    /// Index of the channel that has the same pixels for the other eye, in a window that
    /// [combines](WindowPlace::combine) eyes.
    pub fn partner(&self, channel: usize) -> Option<usize> {
        let own = &self.channels[channel];
        let shares = |other: &Channel| {
            other.window == own.window && other.viewport == own.viewport && other.eye.side() == -own.eye.side()
        };
        let combines = self.windows[own.window].combine != Combine::None && own.eye != Eye::Centre;
        self.channels.iter().position(shares).filter(|_| combines)
    }

    /// Built-in display, by one of [`built_in::NAMES`].
    pub fn built_in(name: &str) -> Option<Self> {
        built_in::display(name)
    }

    /// Built-in display called `name`, or else the display in the file at that path.
    ///
    /// # Errors
    /// [`DisplayError`]. [`DisplayError::NoSuch`] lists the built-in displays if there is no such file either.
    pub fn named_or_file(name: &str) -> Result<Self, DisplayError> {
        if let Some(display) = Self::built_in(name) {
            return Ok(display);
        }
        let path = Path::new(name);
        if path.exists() || path.extension().is_some() {
            return Self::load(path);
        }
        Err(DisplayError::NoSuch { name: name.to_owned() })
    }
}

/// True for a display file, judged by its ending.
pub fn is_display(path: &Path) -> bool {
    path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("toml")) || import::is_imported(path)
}

impl std::fmt::Display for Display {
    /// Writes the report of `rapidity check`.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        report::write(self, f)
    }
}

/// Rotation of the axes x (right), y (above) and −z (ahead) by yaw, pitch and roll (degrees; see the [module](self)).
pub fn room_from_turned(yaw_deg: f64, pitch_deg: f64, roll_deg: f64) -> DMat3 {
    // Whole quarter turns are exact, so that the walls of a cube close without a gap.
    let turn = |angle_deg: f64| {
        let quarter = (angle_deg / 90.0).round();
        let (sin, cos) = (angle_deg - 90.0 * quarter).to_radians().sin_cos();
        match quarter.rem_euclid(4.0) as u8 {
            0 => (sin, cos),
            1 => (cos, -sin),
            2 => (-sin, -cos),
            _ => (-cos, sin),
        }
    };
    let ((sy, cy), (sp, cp), (sr, cr)) = (turn(yaw_deg), turn(pitch_deg), turn(roll_deg));
    let yaw = DMat3::from_cols(DVec3::new(cy, 0.0, -sy), DVec3::Y, DVec3::new(sy, 0.0, cy));
    let pitch = DMat3::from_cols(DVec3::X, DVec3::new(0.0, cp, sp), DVec3::new(0.0, -sp, cp));
    let roll = DMat3::from_cols(DVec3::new(cr, sr, 0.0), DVec3::new(-sr, cr, 0.0), DVec3::Z);
    yaw * pitch * roll
}
