//! Options for who is in a room with screens, and which room.

use crate::room::{Viewer, room_from_turned};
use crate::walls::Head;
use clap::Args;
use glam::DVec3;
use physics::Celerity;

use super::values;

/// Which surfaces the picture is for, and the head before them.
#[derive(Args, Clone, Debug, Default, PartialEq)]
#[command(next_help_heading = "Room")]
pub struct RoomOptions {
    /// Draw for the surfaces of a room: window, stereo-wall, cave4, cave6, curved, dome6, or a display file (.toml, .mpcdi, .pvx).
    ///
    /// The room rests in the vehicle, its reference point at --position, its −z along --look. Each channel's picture becomes a file in the
    /// folder that --out names; --size and --fov say nothing then.
    #[arg(long, value_name = "DISPLAY")]
    pub display: Option<String>,
    /// Write a picture of the room itself, too, as room.png of --size: its screens with what they show, and the head.
    #[arg(long, requires = "display")]
    pub preview: bool,
    /// From where, room axes, metres [default: outside, behind the head, so that all is in sight].
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = values::vector, requires = "preview")]
    pub preview_from: Option<DVec3>,
    /// Place of the head in the room, metres: right, up, backward [default: the display's].
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = values::vector, requires = "display")]
    head: Option<DVec3>,
    /// Degrees by which the head is turned to the left.
    #[arg(long, value_name = "DEGREES", allow_hyphen_values = true, value_parser = values::within(-360.0, 360.0), requires = "display")]
    head_yaw: Option<f64>,
    /// Degrees by which it is then raised.
    #[arg(long, value_name = "DEGREES", allow_hyphen_values = true, value_parser = values::within(-360.0, 360.0), requires = "display")]
    head_pitch: Option<f64>,
    /// Degrees by which it is then inclined to its left.
    #[arg(long, value_name = "DEGREES", allow_hyphen_values = true, value_parser = values::within(-360.0, 360.0), requires = "display")]
    head_roll: Option<f64>,
    /// Velocity of the head in the room as celerity, gamma times v/c: right, up, backward [default: at rest].
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = values::celerity, requires = "display")]
    head_celerity: Option<Celerity>,
}

impl RoomOptions {
    /// The head that the options describe before a display.
    pub fn head(&self, viewer: &Viewer) -> Head {
        let turn = |degrees: Option<f64>| degrees.unwrap_or(0.0);
        Head {
            place_m: self.head.unwrap_or(viewer.head_m),
            room_from_head: room_from_turned(turn(self.head_yaw), turn(self.head_pitch), turn(self.head_roll)),
            celerity: self.head_celerity.unwrap_or_default(),
        }
    }
}
