//! Room around the viewer: which surface shows which part of the world, for which eye, in which window.
//!
//! A [`Display`] is plain data. It comes from a TOML file ([`mod@file`]), is built in ([`built_in`]), or is imported
//! (MPCDI, ParaView's `.pvx`, Unreal's `.ndisplay`: [`Display::load`]). It lists *screens* (surfaces in the room),
//! *windows* (pixels of a monitor), *projectors* and *channels*. A channel shows one screen to one eye in a rectangle
//! of a window. In essence it is a map
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
mod check;
mod display;
mod display_file;
mod error;
pub mod file;
mod format;
mod frustum;
mod gain_map;
mod gains;
mod grid_file;
mod headset;
mod import;
mod lens;
mod load;
mod maps;
mod net;
mod overlaps;
mod pfm;
mod picture_plane;
mod pixels;
mod projector;
mod read;
mod reflection;
mod report;
pub mod surface;
mod turning;
mod unit_square;
mod viewer;
mod warp;
mod window;
mod window_sizes;

pub use channel::{Channel, ChannelPart};
pub use display::{Display, Screen};
pub use error::{DisplayError, FilePlace};
pub use format::FILE_ENDINGS;
pub use frustum::{EyeBehind, Frustum, frustum};
pub use gain_map::GainMap;
pub use gains::Gains;
pub use headset::HeadsetEye;
pub use lens::{LensTable, ProjectorLens};
pub use load::is_display;
pub use projector::Projector;
pub use reflection::Reflection;
pub use surface::{CylinderSurface, FlatSurface, MeshSurface, ScreenSurface, SphereSurface, SurfaceHit};
pub use turning::room_from_turned;
pub use viewer::{EYE_SEPARATION_M, EyeSide, Viewer};
pub use warp::{CornerWarp, MeasuredWarp, NotConvex, Warp};
pub use window::{Combine, Monitor, WindowPlace};
