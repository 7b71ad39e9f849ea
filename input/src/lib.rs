//! Devices to controls, and recordings of both.
//!
//! Every device ends as a stream of [`Sample`]s: raw bytes, a time stamp, the device's name. A [`Desk`] decodes them
//! into the rider's [`Controls`], once a frame. Decoding is a pure function, so a [`recording`] of samples and frame
//! times replays to the same bits. Live samples come from [`devices`], where each device has a thread of its own;
//! tests and replays make them without any hardware.
//!
//! ```
//! use input::{Desk, DeskConfig, KeyboardKey, SECOND, Sample};
//!
//! let mut desk = Desk::new(DeskConfig::default())?;
//! desk.feed(&Sample::key(0, KeyboardKey::W, true));
//! assert_eq!(desk.controls(SECOND).wheel_speed, Some(2.0));
//! # Ok::<(), input::ConfigError>(())
//! ```
//!
//! This crate knows nothing of relativity: speeds are those of a wheel, times those of a clock on the wall.

pub mod action;
mod axis_table;
pub mod bicycle;
pub mod brake;
mod clock;
pub mod config;
mod config_error;
mod controls;
pub mod decoder;
mod desk;
pub mod devices;
pub mod dtrack;
mod faults;
pub mod filters;
pub mod gamepad;
pub mod gamepad_codes;
pub mod gamepad_map;
mod glide;
pub mod head;
mod key;
pub mod key_map;
pub mod keyboard;
pub mod line;
mod look;
pub mod opentrack;
pub mod openxr;
pub mod pulses;
mod ramp;
pub mod recording;
mod rider_config;
mod sample;
pub mod settings;
pub mod spacemouse;
pub mod spacenavd;
pub mod trainer;
pub mod vrpn;
pub mod wand;

pub use action::{Action, FocusStep, Place, Setting, Switch, VehicleKind};
pub use axis_table::AxisTable;
pub use bicycle::config::{BareNumber, BicycleConfig, SpeedSource};
pub use brake::BrakeCommand;
pub use clock::{Clock, Nanos, SECOND, seconds_between};
pub use config::DeskConfig;
pub use config_error::ConfigError;
pub use controls::Controls;
pub use desk::Desk;
pub use devices::{Devices, DevicesConfig};
pub use faults::Faults;
pub use gamepad_map::GamepadMap;
pub use head::{
    HeadConfig, HeadState, HeardKind, HeardSensor, MouseButton, MouseEvent, TrackedPose, TrackerUrl, TrackingMode,
};
pub use key::KeyboardKey;
pub use key_map::KeyMap;
pub use look::{FreeLook, LookDecoder, STEEPEST_LOOK_RAD};
pub use rider_config::RiderConfig;
pub use sample::{Sample, SampleSource, Signal};
pub use trainer::{RoadLoad, TrainerConfig, TrainerUrl};
pub use wand::{HeldButtons, WandButtons, WandConfig, WandState};
