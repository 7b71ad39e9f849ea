//! Live devices, each read by a thread of its own.
//!
//! A thread looks for its device, opens it, reads it until it goes, and looks again, at first quickly and then every
//! two seconds; so devices may be plugged and unplugged at any time. The bytes go, stamped with the ride's clock,
//! into a bounded queue that the frame loop drains ([`Devices::drain`]). Of a tracker that sends too fast, the newest
//! messages alone pass (`flood_gate`). If the loop stalls, a full queue drops its
//! *oldest* sample: no thread ever waits, the newest state is never lost, and dropped samples are counted. Each
//! device has its own queue, so a flood of one harms no other.
//!
//! A device that is missing or may not be read is no error: [`Devices::status`] says what to do about it
//! ([`DeviceFault`]). Samples of keyboard and mouse come from the window, not from here.

mod config;
mod datagrams;
mod dtrack;
mod fault;
mod feed;
mod flood_gate;
mod lanes;
mod multicast;
mod opentrack;
mod openxr;
#[cfg(target_os = "linux")]
mod pad;
mod plugged;
mod puck;
mod serial;
#[cfg(unix)]
mod socket;
#[cfg(unix)]
mod spnav_places;
mod trainer;
mod trainer_error;
mod vrpn;

pub use config::DevicesConfig;
pub use fault::{DeviceFault, DeviceNote, UDEV_RULE};
pub use feed::{DeviceState, DeviceStatus};
pub use lanes::{Devices, DevicesError};
pub use plugged::{PluggedDevice, plugged_in};
pub use trainer_error::{TrainerError, TrainerRequest, short_numbers};
