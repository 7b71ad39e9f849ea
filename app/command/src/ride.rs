//! `rapidity ride`: the interactive environment.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::comfort::ComfortOptions;
use super::dial::{DialOptions, map_scale_of_windows};
use super::frame_rate::FrameRate;
use super::kiosk::KioskOptions;
use super::picture::PictureOptions;
use super::values;
use super::world::{SceneChoice, WorldOptions};
use input::{KeyMap, TrackerUrl, TrainerUrl};
use presentation::{Latency, Presentation};
use ride::{AssistMode, IntegratorKind, Nose};
use scene::Start;
use view::{Dial, Occasion, RendererName};
use words::Language;

/// Name of the display that is the headset of this machine.
pub const HEADSET: &str = "openxr";
/// Samples per pixel in a window drawn by hardware, where they cost little. A software driver draws one.
const HARDWARE_SAMPLES: u32 = 4;

/// Kind of vehicle that carries the observer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum VehicleName {
    /// Bicycle with pedals, handlebar and brake.
    #[default]
    Bicycle,
    /// Vehicle with thrust along the ground.
    Drive,
    /// Vehicle with thrust in three directions, and roll.
    Fly,
}

/// Options of `rapidity ride`.
///
/// If none of --renderer, --tolerance, --edge, --transform and --map-scale is given, their values come from
/// rapidity.toml in the user's configuration directory (~/.config/rapidity on Linux, or rapidity in XDG_CONFIG_HOME),
/// if that file exists. `rapidity measure --budget` and `rapidity measure --tolerance` write it.
#[derive(Args, Clone, Debug, PartialEq)]
#[command(allow_negative_numbers = true)]
pub struct RideOptions {
    /// Options of the world.
    #[command(flatten)]
    pub world: WorldOptions,
    /// Options of the vehicle.
    #[command(flatten)]
    pub vehicle: VehicleOptions,
    /// Options of the devices.
    #[command(flatten)]
    pub devices: DeviceOptions,
    /// File to which the whole ride is recorded, so that it can be replayed.
    #[arg(long, value_name = "R.mcap", value_parser = values::recording(), help_heading = "Recording")]
    pub record: Option<PathBuf>,
    /// Show a recorded ride again.
    ///
    /// World, vehicle and devices come from the recording. --scene is needed only if the file of its scene has moved.
    #[arg(long, value_name = "R.mcap", value_parser = values::recording(), help_heading = "Recording")]
    #[arg(conflicts_with_all = ["record", "speed_of_light", "vehicle", "integrator", "transport", "time_scale"])]
    #[arg(conflicts_with_all = ["assist", "through_walls"])]
    #[arg(conflicts_with_all = ["set_up", "bicycle", "trainer", "slope_felt", "spacemouse", "tracker"])]
    pub replay: Option<PathBuf>,
    /// Compare only: compute the recorded ride again, show nothing, and fail at the first frame that is not equal to
    /// the last bit.
    #[arg(long, conflicts_with_all = ["out", "realtime", "seconds"], help_heading = "Recording")]
    pub verify: bool,
    /// Time after which the ride ends, seconds [default: when the window is closed, or the recording ends].
    #[arg(long, value_name = "N", value_parser = values::positive, help_heading = "Session")]
    pub seconds: Option<f64>,
    /// Film the ride into this file instead of opening a window.
    #[arg(long, value_name = "FILE.mp4", value_parser = values::film(), help_heading = "Session")]
    pub out: Option<PathBuf>,
    /// Follow the clock when there is no window, as live devices need it, instead of running as fast as possible.
    #[arg(long, help_heading = "Session")]
    pub realtime: bool,
    /// Order of transforming and drawing within a frame.
    #[arg(long, value_enum, default_value = "overlap", help_heading = "Picture")]
    pub latency: Latency,
    /// Frames per second that a window or a room holds, by drawing fewer pixels and enlarging them; `off` draws every
    /// pixel however long it takes. At rest the picture is drawn to the full. A headset keeps its own rate, or takes
    /// the nearest to this that it can [default: 30; in a headset its own].
    #[arg(long, value_name = "FPS", value_parser = values::frame_rate, help_heading = "Picture")]
    pub frame_rate: Option<FrameRate>,
    /// Room in whose windows the ride is shown: window, desk, stereo-wall, cave4, cave6, curved, dome6, a display file
    /// (.toml, .mpcdi, .pvx), or openxr: the headset of this machine, with its controllers as wands. F4
    /// shows test grids and moves the corners of the pictures.
    #[arg(long, value_name = "DISPLAY", help_heading = "Room", conflicts_with = "out")]
    pub display: Option<String>,
    /// Show the ride in the headset of this machine: short for `--display openxr`.
    #[arg(long, help_heading = "Room", conflicts_with_all = ["display", "out", "preview"])]
    pub headset: bool,
    /// Show the room itself in one window, with the pictures on its screens. Dragging turns the view, the wheel moves
    /// closer.
    #[arg(long, help_heading = "Room", requires = "display")]
    pub preview: bool,
    /// Guided tour: searchlight, terrell, twins, slow-light, or a tour's file (.toml). Captions say what is seen; Enter
    /// stops the tour and goes on.
    #[arg(long, value_name = "TOUR", help_heading = "Session")]
    #[arg(conflicts_with_all = ["replay", "scene", "speed_of_light", "vehicle", "kiosk", "assist"])]
    pub tour: Option<String>,
    /// Open a window for an operator beside those of the audience: menu, devices, pace, and a copy of the picture.
    #[arg(long, help_heading = "Session")]
    pub operator: bool,
    /// Language of everything that is written in the picture: en or de [default: that of the settings, else that of the
    /// system].
    #[arg(long, value_name = "LANGUAGE", help_heading = "Session")]
    pub language: Option<Language>,
    /// Options of a kiosk.
    #[command(flatten)]
    pub kiosk: KioskOptions,
    /// Options of the method of drawing.
    #[command(flatten)]
    pub dial: DialOptions,
    /// Options of the picture.
    #[command(flatten)]
    pub picture: PictureOptions,
    /// Options of comfort in a headset.
    #[command(flatten)]
    pub comfort: ComfortOptions,
    /// True if the command line has an option for the renderer or one of its dials.
    #[arg(skip)]
    pub drawing_is_given: bool,
    /// Keys that do other work than their own by the user's settings.
    #[arg(skip)]
    pub keys: KeyMap,
}

impl RideOptions {
    /// True if the ride is shown in a headset.
    pub fn is_headset(&self) -> bool {
        self.display.as_deref() == Some(HEADSET)
    }

    /// Checks rules between the options.
    pub(super) fn check(&self) -> Result<(), String> {
        if self.verify && self.replay.is_none() {
            return Err("--verify compares a recorded ride: name the recording with --replay".to_owned());
        }
        if self.dial.renderer == RendererName::Raytrace {
            return Err("a ride cannot wait for the rays of --renderer raytrace: use auto, polygon or image, and render its recording \
                 with raytrace"
                .to_owned());
        }
        let devices = &self.devices;
        if devices.slope_felt.is_some() && devices.trainer.is_none() && devices.set_up.is_none() {
            return Err("--slope-felt is for a trainer: name it with --trainer, or in a set-up file".to_owned());
        }
        if self.picture.exact_light {
            return Err("--exact-light is for --renderer raytrace; leave it out".to_owned());
        }
        Ok(())
    }

    /// Presentation with which a ride begins that starts as `start` says.
    pub fn presentation(&self, start: &Start) -> Presentation {
        Presentation {
            latency: self.latency,
            language: self.language.unwrap_or_default(),
            vignette: self.comfort.vignette,
            cockpit: self.comfort.cockpit.unwrap_or(self.is_headset()),
            ..self.picture.presentation(start)
        }
    }

    /// The same options for a live ride in another scene, seen from its start in its own speed of light. What
    /// `--record` names stays the recording of the ride before.
    #[must_use]
    pub fn in_scene(&self, scene: SceneChoice) -> Self {
        let mut options = Self { record: None, tour: None, ..self.clone() };
        options.world = WorldOptions { scene: Some(scene), camera: None, speed_of_light: None, ..options.world };
        options
    }

    /// The same options for a ride on a tour.
    #[must_use]
    pub fn on_tour(&self, name: &str) -> Self {
        Self { tour: Some(name.to_owned()), ..self.in_scene(SceneChoice::default()) }
    }

    /// Dial by which the frames of the ride are drawn; `software`: on the CPU.
    pub fn dial(&self, software: bool) -> Dial {
        self.dial.dial(Occasion::Ride, map_scale_of_windows(software))
    }

    /// Samples for each pixel of a frame in motion; `software`: on the CPU.
    pub fn samples(&self, software: bool) -> u32 {
        if software || self.picture.samples == 1 { 1 } else { HARDWARE_SAMPLES }
    }
}

/// Options of the vehicle and its clock.
#[derive(Args, Clone, Debug, PartialEq)]
#[command(next_help_heading = "Vehicle")]
pub struct VehicleOptions {
    /// Vehicle that carries the observer [default: bicycle; in a model without a start of its own drive, or fly where
    /// there is no floor].
    #[arg(long, value_enum)]
    pub vehicle: Option<VehicleName>,
    /// Method of integrating the worldline.
    #[arg(long, value_enum, default_value = "rk4")]
    pub integrator: IntegratorKind,
    /// Turning of the nose of a driven or flown vehicle.
    #[arg(long, value_enum, default_value = "facing")]
    pub transport: Nose,
    /// Steering along the street for whoever only pedals or thrusts: along the circuit of the scene, else where walls
    /// leave room. It eases off before bends, and a hand that steers wins at once. auto: as long as keys alone steer,
    /// without a bicycle, and not after a stick or a SpaceMouse was moved.
    #[arg(long, value_enum, default_value = "auto", value_name = "WHEN")]
    pub assist: AssistMode,
    /// Fly through walls, floors and roofs, which hold a flight otherwise.
    #[arg(long)]
    pub through_walls: bool,
    /// Seconds of the rider's own time per second of real time, up to 16.
    #[arg(long, value_name = "FACTOR", default_value = "1", value_parser = values::within(1e-6, 16.0))]
    pub time_scale: f64,
}

/// Options of the devices besides keyboard and gamepads.
#[derive(Args, Clone, Debug, Default, PartialEq, Eq)]
#[command(next_help_heading = "Devices")]
pub struct DeviceOptions {
    /// File that describes the rider's hardware: tables `[bicycle]`, `[trainer]`, `[rider]`, `[axes]`, `[gamepad]`,
    /// `[keys]` and `[tracker]`.
    /// `rapidity devices --calibrate FILE` writes one.
    #[arg(long, value_name = "FILE.toml")]
    pub set_up: Option<PathBuf>,
    /// Serial port of the instrumented bicycle, such as /dev/ttyUSB0.
    #[arg(long, value_name = "PORT")]
    pub bicycle: Option<String>,
    /// Trainer over the network that speaks FTMS by Direct Connect (TCP): tcp://HOST or tcp://HOST:PORT; the port is
    /// 36866 if none is named. Its speed rides, and its brake follows the slope of the road and the brake lever.
    #[arg(long, value_name = "URL")]
    pub trainer: Option<TrainerUrl>,
    /// Share of the road's slope that the trainer makes felt, percent: 0 for a level road everywhere
    /// [default: 100].
    #[arg(long, value_name = "PERCENT", value_parser = clap::value_parser!(u8).range(0..=100))]
    pub slope_felt: Option<u8>,
    /// Read a SpaceMouse, directly or through spacenavd.
    #[arg(long)]
    pub spacemouse: bool,
    /// Tracker of the head: opentrack://:4242 at a desk (opentrack's output "UDP over network"), vrpn://HOST/DEVICE,
    /// dtrack://:5000 (or dtrack://GROUP:5000), openxr:// (the headset of this machine), or mouse, whose drags
    /// turn and move the head. Its turn turns the picture of the displays desk, the usual one with opentrack, and
    /// window. U makes the head's present pose the straight one.
    #[arg(long, value_name = "URL")]
    pub tracker: Option<TrackerUrl>,
}

impl DeviceOptions {
    /// True if a device that is ridden is named, which a film without a window has to follow.
    pub fn are_ridden(&self) -> bool {
        self.bicycle.is_some() || self.trainer.is_some() || self.spacemouse
    }
}
