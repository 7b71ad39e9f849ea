//! Which devices are looked for, and where.

use std::path::PathBuf;

use crate::head::url::TrackerUrl;

/// Which devices to look for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DevicesConfig {
    /// Serial port of the bicycle, as `/dev/ttyACM0` or `COM3`.
    pub bicycle: Option<String>,
    /// Its speed, baud.
    pub baud: u32,
    /// Look for a SpaceMouse.
    pub space_mouse: bool,
    /// Where spacenavd listens, for a SpaceMouse that may not be read directly.
    pub spacenavd_socket: PathBuf,
    /// Look for a gamepad or joystick.
    pub gamepad: bool,
    /// The tracker of the head.
    pub tracker: Option<TrackerUrl>,
}

impl Default for DevicesConfig {
    fn default() -> Self {
        Self {
            bicycle: None,
            baud: 115_200,
            space_mouse: true,
            spacenavd_socket: PathBuf::from("/run/spnav.sock"),
            gamepad: true,
            tracker: None,
        }
    }
}
