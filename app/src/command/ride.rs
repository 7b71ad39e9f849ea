//! `rapidity ride`: the interactive environment.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::{PictureOptions, Renderer, WorldOptions, values};
use crate::vehicle::{IntegratorKind, Nose};
use input::TrackerUrl;

/// What drives the observer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum VehicleName {
    /// Pedals, handlebar and brake.
    #[default]
    Bicycle,
    /// Thrust along the ground.
    Drive,
    /// Thrust in three directions, and roll.
    Fly,
}

/// How transforming and drawing share the time of a frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum Latency {
    /// One after the other: the picture is as fresh as can be.
    Low,
    /// The next frame is transformed while this one is drawn: more frames a second.
    #[default]
    Overlap,
}

/// What to ride through, in what, and for how long.
///
/// Where none of --renderer, --tolerance, --edge, --transform and --map-scale is given, they are those that rapidity.toml in the user's configuration directory
/// names (on Linux ~/.config/rapidity, or rapidity in XDG_CONFIG_HOME), if there is one; `rapidity measure --budget` and `--tolerance` write it.
#[derive(Args, Clone, Debug, PartialEq)]
#[command(allow_negative_numbers = true)]
pub struct RideOptions {
    /// The world.
    #[command(flatten)]
    pub world: WorldOptions,
    /// The vehicle.
    #[command(flatten)]
    pub vehicle: VehicleOptions,
    /// The devices.
    #[command(flatten)]
    pub devices: DeviceOptions,
    /// Write all that happens to this file, from which the ride can be replayed.
    #[arg(long, value_name = "R.mcap", value_parser = values::recording(), help_heading = "Recording")]
    pub record: Option<PathBuf>,
    /// Ride a recorded ride again.
    ///
    /// World, vehicle and devices come from the recording; --scene is needed only if its scene's file has moved.
    #[arg(long, value_name = "R.mcap", value_parser = values::recording(), help_heading = "Recording")]
    #[arg(conflicts_with_all = ["record", "speed_of_light", "vehicle", "integrator", "transport", "time_scale"])]
    #[arg(conflicts_with_all = ["bicycle", "spacemouse", "tracker"])]
    pub replay: Option<PathBuf>,
    /// Only compare: compute the recorded ride again, show nothing, and fail at the first frame that is not the
    /// same to the bit.
    #[arg(long, conflicts_with_all = ["out", "realtime", "seconds"], help_heading = "Recording")]
    pub verify: bool,
    /// End after this many seconds [default: when the window is closed, or the recording ends].
    #[arg(long, value_name = "N", value_parser = values::positive, help_heading = "Session")]
    pub seconds: Option<f64>,
    /// Film the ride into this file instead of opening a window.
    #[arg(long, value_name = "FILE.mp4", value_parser = values::film(), help_heading = "Session")]
    pub out: Option<PathBuf>,
    /// Without a window, keep to the clock, as live devices need it, instead of being as fast as possible.
    #[arg(long, help_heading = "Session")]
    pub realtime: bool,
    /// How transforming and drawing share the time of a frame.
    #[arg(long, value_enum, default_value = "overlap", help_heading = "Picture")]
    pub latency: Latency,
    /// Show it on the surfaces of a room, in as many windows as that names: window, stereo-wall, cave4, cave6, curved, dome6, or a display
    /// file (.toml, .mpcdi, .pvx). F4 shows test grids, and moves the corners of the pictures.
    #[arg(long, value_name = "DISPLAY", help_heading = "Room", conflicts_with = "out")]
    pub display: Option<String>,
    /// Show that room itself in one window instead, with what its screens show: drag turns it, the wheel comes closer.
    #[arg(long, help_heading = "Room", requires = "display")]
    pub preview: bool,
    /// How the picture is drawn.
    #[command(flatten)]
    pub picture: PictureOptions,
    /// Whether the command line says anything of the renderer or its dials.
    #[arg(skip)]
    pub drawing_is_given: bool,
}

impl RideOptions {
    /// Checks what the options say together.
    pub(super) fn check(&self) -> Result<(), String> {
        if self.verify && self.replay.is_none() {
            return Err("--verify compares a recorded ride: name the recording with --replay".to_owned());
        }
        if self.picture.renderer == Renderer::Raytrace {
            return Err("a ride cannot wait for the rays of --renderer raytrace: use auto, polygon or image, and render its recording \
                 with raytrace"
                .to_owned());
        }
        self.picture.check()
    }
}

/// What is ridden, and on which clock.
#[derive(Args, Clone, Debug, PartialEq)]
#[command(next_help_heading = "Vehicle")]
pub struct VehicleOptions {
    /// What drives the observer.
    #[arg(long, value_enum, default_value = "bicycle")]
    pub vehicle: VehicleName,
    /// How the worldline is integrated.
    #[arg(long, value_enum, default_value = "rk4")]
    pub integrator: IntegratorKind,
    /// How the axes of a flying vehicle are carried along.
    #[arg(long, value_enum, default_value = "facing")]
    pub transport: Nose,
    /// Seconds of the rider's own time for each second of real time.
    #[arg(long, value_name = "FACTOR", default_value = "1", value_parser = values::positive)]
    pub time_scale: f64,
}

/// Which devices are read, besides keyboard and gamepads.
#[derive(Args, Clone, Debug, Default, PartialEq, Eq)]
#[command(next_help_heading = "Devices")]
pub struct DeviceOptions {
    /// The serial port of the instrumented bicycle, such as /dev/ttyUSB0.
    #[arg(long, value_name = "PORT")]
    pub bicycle: Option<String>,
    /// Read a SpaceMouse, by itself or through spacenavd.
    #[arg(long)]
    pub spacemouse: bool,
    /// What tracks the head: vrpn://HOST/DEVICE, dtrack://:5000 (or dtrack://GROUP:5000), or mouse.
    #[arg(long, value_name = "URL")]
    pub tracker: Option<TrackerUrl>,
}
