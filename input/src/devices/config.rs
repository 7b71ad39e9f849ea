//! Settings of the devices to look for.

use std::path::PathBuf;

use crate::head::url::TrackerUrl;
use crate::trainer::url::TrainerUrl;

/// Devices to look for, and their places.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DevicesConfig {
    /// Serial port of the bicycle, as `/dev/ttyACM0` or `COM3`.
    pub bicycle: Option<String>,
    /// Speed of the serial port, baud.
    pub baud: u32,
    /// Trainer over the network.
    pub trainer: Option<TrainerUrl>,
    /// Share of the road's slope that the trainer makes felt, percent.
    pub slope_felt_percent: u8,
    /// True if a SpaceMouse is looked for.
    pub space_mouse: bool,
    /// Socket of spacenavd, for a SpaceMouse that may not be read directly. `None` for the usual places: the variable
    /// `SPNAV_SOCKET`, the line `socket` in `/etc/spnavrc`, `/run/spnav.sock`, `/var/run/spnav.sock`.
    pub spacenavd_socket: Option<PathBuf>,
    /// True if a gamepad or joystick is looked for.
    pub gamepad: bool,
    /// Tracker of the head.
    pub tracker: Option<TrackerUrl>,
    /// VRPN devices of the wand: [`HeadConfig::wand_devices`](crate::HeadConfig::wand_devices).
    pub wand_devices: Vec<String>,
}

impl Default for DevicesConfig {
    fn default() -> Self {
        Self {
            bicycle: None,
            baud: 115_200,
            trainer: None,
            slope_felt_percent: 100,
            space_mouse: true,
            spacenavd_socket: None,
            gamepad: true,
            tracker: None,
            wand_devices: Vec::new(),
        }
    }
}
