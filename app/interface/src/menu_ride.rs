//! State of the ride that the menu shows.

use hardware::heard::DeviceReport;
use input::head::Stance;
use input::{Place, TrackingMode, VehicleKind};
use view::{Dial, RendererName};

/// Comfort of a rider in a headset that is no part of the presentation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MenuComfort {
    /// Step by which the rider turns in the vehicle, degrees; 0 for none.
    pub snap_turn_deg: f64,
    /// Stance of the rider.
    pub stance: Stance,
}

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
    /// Comfort of whoever wears the headset, if the ride is shown in one.
    pub comfort: Option<MenuComfort>,
    /// Name of the scene on the command line.
    pub scene: String,
    /// Tours, by their titles and their names on the command line.
    pub tours: Vec<(String, &'static str)>,
    /// Places to jump to, with their names.
    pub places: Vec<(String, Place)>,
    /// True if a recorded ride is shown.
    pub is_recorded: bool,
    /// Way of drawing that was asked for.
    pub dial: Dial,
    /// Method that draws.
    pub drawn_by: RendererName,
    /// Reports on the devices.
    pub devices: Vec<DeviceReport>,
    /// Sentences about the renderer, the amount that it draws, and the windows.
    pub drawing: Vec<String>,
    /// True if frames may overlap, so that their order can be chosen.
    pub overlaps: bool,
    /// True if lines of the vehicle can be shown about the rider.
    pub has_lines: bool,
    /// True if the picture is flat, so that its field of view can be chosen.
    pub is_flat: bool,
}
