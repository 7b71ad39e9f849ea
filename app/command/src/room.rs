//! Options of a room with screens, and of the head in it.

use clap::Args;
use glam::DVec3;
use physics::Celerity;
use room::{Viewer, room_from_turned};
use walls::RoomHead;

use super::values;

/// Options of the room and of the head in front of its screens.
#[derive(Args, Clone, Debug, Default, PartialEq)]
#[command(next_help_heading = "Room")]
pub struct RoomOptions {
    /// Room for whose surfaces the pictures are drawn: window, desk, stereo-wall, cave4, cave6, curved, dome6, or a
    /// display file (.toml, .mpcdi, .mpcdi.xml, .pvx, .ndisplay).
    ///
    /// The room rests in the vehicle: its reference point is at --position, and its −z points along --look. Each
    /// channel's picture becomes a file in the folder that --out names. --size and --fov do not apply to these
    /// pictures.
    #[arg(long, value_name = "DISPLAY")]
    pub display: Option<String>,
    /// Write also a picture of the room itself, room.png of --size: its screens with their pictures, and the head.
    #[arg(long, requires = "display")]
    pub preview: bool,
    /// Place from which the room is seen, room axes, metres [default: outside, behind the head, with everything in
    /// sight].
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = values::vector, requires = "preview")]
    pub preview_from: Option<DVec3>,
    /// Place of the head in the room, metres: right, up, backward [default: the display's].
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = values::vector, requires = "display")]
    head: Option<DVec3>,
    /// Angle by which the head is turned to its left, degrees. It turns the picture of the displays window and desk; in
    /// rooms, whose screens stand still, it moves the eyes alone.
    #[arg(long, value_name = "DEGREES", allow_hyphen_values = true, value_parser = values::within(-360.0, 360.0), requires = "display")]
    head_yaw: Option<f64>,
    /// Angle by which the head is then raised, degrees.
    #[arg(long, value_name = "DEGREES", allow_hyphen_values = true, value_parser = values::within(-360.0, 360.0), requires = "display")]
    head_pitch: Option<f64>,
    /// Angle by which the head is then inclined to its left, degrees.
    #[arg(long, value_name = "DEGREES", allow_hyphen_values = true, value_parser = values::within(-360.0, 360.0), requires = "display")]
    head_roll: Option<f64>,
    /// Velocity of the head in the room as celerity, gamma times v/c: right, up, backward [default: at rest].
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = values::celerity, requires = "display")]
    head_celerity: Option<Celerity>,
}

impl RoomOptions {
    /// Head that the options describe, in front of a display with this viewer.
    pub fn head(&self, viewer: &Viewer) -> RoomHead {
        let turn = |degrees: Option<f64>| degrees.unwrap_or(0.0);
        RoomHead {
            place_m: self.head.unwrap_or(viewer.head_m),
            room_from_head: room_from_turned(turn(self.head_yaw), turn(self.head_pitch), turn(self.head_roll)),
            celerity: self.head_celerity.unwrap_or_default(),
            turn_rate: glam::DVec3::ZERO,
        }
    }
}
