//! The room around the viewer: which surfaces show which part of the world, for which eye, in which window.
//!
//! A [`Display`] is plain data, made from a TOML file ([`mod@file`]), from a built-in one ([`built_in`]), or imported (MPCDI, ParaView's `.pvx`: [`Display::load`]).
//! It lists *screens* (surfaces in the room), *windows* (pixels of a monitor), *projectors* and *channels*. A channel shows one screen to
//! one eye in a rectangle of a window. It is at heart a map
//!
//! ```text
//! pixel ─ warp ─► place in the picture ─ lens, ray ─► point on the surface ─ minus the eye ─► direction that the eye sees
//! ```
//!
//! (B eq. 4.1–4.3). Only the last step depends on the eye, so [`Channel::point`] can be tabled once. A flat screen whose pixels lie on it
//! in even rows needs no table: [`Channel::flat`] says so, and [`frustum()`] gives its off-axis frustum for any eye.
//!
//! *Frame.* The room's axes are those of the vehicle: metres, x right, y up, −z ahead. Angles in files are degrees: yaw turns about +y
//! (to the left), pitch about +x (up), roll about +z (counter-clockwise as seen by who looks along −z), applied in this order
//! to axes that turn along. Places in a picture run from 0 to 1, x to the right and y *down* from its upper left; places on a surface (uv)
//! run from 0 to 1, u to the right and v *up* from its lower left, both as seen by the viewer.

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

/// All that a room shows, and how.
#[derive(Clone, Debug, PartialEq)]
pub struct Display {
    /// What to call it in titles and messages: the built-in's name, or the file's without its ending.
    pub name: String,
    /// Who looks.
    pub viewer: Viewer,
    /// Surfaces in the room.
    pub screens: Vec<Screen>,
    /// What throws light on them, where that matters.
    pub projectors: Vec<Projector>,
    /// Windows on monitors.
    pub windows: Vec<WindowPlace>,
    /// What each shows: indices in it are good, viewports lie in their windows.
    pub channels: Vec<Channel>,
    /// The file's `[tracker]` table as it stands there: how the head is tracked is not this module's business.
    pub tracker: Option<toml::Value>,
    /// What the file asks for and is not done, or what its user should know; one sentence each.
    pub notices: Vec<String>,
}

/// A surface with a name.
#[derive(Clone, Debug, PartialEq)]
pub struct Screen {
    /// Unique among the screens.
    pub name: String,
    /// Where it is.
    pub surface: Surface,
    /// How it sends back projectors' light.
    pub reflection: Reflection,
}

impl Display {
    /// Reads a display file: `.toml`, or one of another program: `.pvx`, `.mpcdi`, `.mpcdi.xml`.
    ///
    /// # Errors
    /// [`DisplayError`] with file, line, key and reason.
    pub fn load(path: &Path) -> Result<Self, DisplayError> {
        if import::is_imported(path) { import::load(path) } else { file::load(path) }
    }

    /// The channel that has the same pixels for the other eye, in a window that [combines](WindowPlace::combine) eyes.
    pub fn partner(&self, channel: usize) -> Option<usize> {
        let own = &self.channels[channel];
        let shares = |other: &Channel| {
            other.window == own.window && other.viewport == own.viewport && other.eye.side() == -own.eye.side()
        };
        let combines = self.windows[own.window].combine != Combine::None && own.eye != Eye::Centre;
        self.channels.iter().position(shares).filter(|_| combines)
    }

    /// A display that comes with the program, by one of [`built_in::NAMES`].
    pub fn built_in(name: &str) -> Option<Self> {
        built_in::display(name)
    }

    /// The built-in display of that name, or else the file at that path.
    ///
    /// # Errors
    /// [`DisplayError`]; [`DisplayError::NoSuch`] names the built-in ones, where there is no such file either.
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

/// Whether a file is a display, by its ending.
pub fn is_display(path: &Path) -> bool {
    path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("toml")) || import::is_imported(path)
}

impl std::fmt::Display for Display {
    /// What `rapidity check` says of it.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        report::write(self, f)
    }
}

/// The rotation that takes −z, x, y to what is ahead, right and above after a turn by yaw, pitch and roll (degrees; see the [module](self)).
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
