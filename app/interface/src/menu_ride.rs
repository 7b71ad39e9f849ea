//! State of the ride that the menu shows.

use hardware::heard::DeviceReport;
use input::{Place, TrackingMode, VehicleKind};

/// State of the ride that the menu shows.
#[derive(Clone, Debug, Default)]
pub struct MenuRide {
    /// Kind of vehicle that is ridden.
    pub vehicle: VehicleKind,
    /// Ratio of proper time to real time.
    pub time_scale: f64,
    /// Speed of light, m/s.
    pub speed_of_light: f64,
    /// True if the ride is held.
    pub paused: bool,
    /// True if a recording is being written.
    pub recording: bool,
    /// Use of the tracked head, if one is tracked.
    pub tracking: Option<TrackingMode>,
    /// Places to jump to, with their names.
    pub places: Vec<(String, Place)>,
    /// Reports on the devices.
    pub devices: Vec<DeviceReport>,
    /// Sentences about the renderer, the amount that it draws, and the windows.
    pub drawing: Vec<String>,
    /// True if frames may overlap, so that their order can be chosen.
    pub overlaps: bool,
    /// True if the picture is flat, so that its field of view can be chosen.
    pub is_flat: bool,
}
