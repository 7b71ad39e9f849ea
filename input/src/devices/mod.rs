//! Live devices, each read by a thread of its own.
//!
//! A thread looks for its device, opens it, reads it until it goes, and looks again, at first
//! quickly and then every two seconds; so devices may be plugged and unplugged at any time. What it
//! reads goes, stamped with the ride's clock, into a bounded queue that the frame loop drains
//! ([`Devices::drain`]). Should the loop stall, a full queue drops its *oldest* sample: no thread
//! ever waits, the newest state is never lost, and what was dropped is counted. Each device has its
//! own queue, so one that floods hurts only itself.
//!
//! A device that is missing or may not be read is no error: [`Devices::status`] says in a sentence
//! what to do about it. A keyboard's and a mouse's samples come from the window, not from here.

mod dtrack;
mod feed;
#[cfg(target_os = "linux")]
mod pad;
mod plugged;
mod puck;
mod serial;
#[cfg(unix)]
mod socket;
mod vrpn;

use std::path::PathBuf;
use std::sync::Arc;
use std::thread::{self, JoinHandle};

use crossbeam_channel::{Receiver, Sender, bounded};
use thiserror::Error;

pub use feed::{State, Status};
pub use plugged::{Plugged, plugged_in};

use crate::head::TrackerUrl;
use crate::sample::{Clock, Sample, Source};
use dtrack::DtrackPort;
use feed::{Feed, Port};
use puck::PuckPort;
use serial::{BrakeSlot, SerialPort};
use vrpn::VrpnPort;

/// Samples of one device that wait for the frame loop: several seconds of the fastest.
const QUEUE: usize = 4096;
/// Samples of a tracker that wait: they are longer.
const TRACKER_QUEUE: usize = 1024;

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

/// Why devices cannot be read at all.
#[derive(Debug, Error)]
pub enum DevicesError {
    /// The system gives us no thread.
    #[error("cannot start the thread that reads the {source_device}: {cause}")]
    Thread {
        /// Which device.
        source_device: Source,
        /// Why not.
        cause: std::io::Error,
    },
}

/// One device's thread and its queue.
#[derive(Debug)]
struct Lane {
    samples: Receiver<Sample>,
    live: feed::Shared,
    thread: JoinHandle<()>,
}

/// All devices that are looked for.
#[derive(Debug)]
pub struct Devices {
    clock: Clock,
    lanes: Vec<Lane>,
    brake: Arc<BrakeSlot>,
    /// Closed to end the threads.
    stop: Option<Sender<()>>,
}

impl Devices {
    /// Starts to look for the devices.
    ///
    /// # Errors
    /// If a thread cannot be started. A device that is missing is no error.
    pub fn open(config: &DevicesConfig, clock: Clock) -> Result<Self, DevicesError> {
        let (stop, stopped) = bounded(0);
        let brake = Arc::new(BrakeSlot::default());
        let mut devices = Self { clock, lanes: Vec::new(), brake: brake.clone(), stop: Some(stop) };
        if let Some(path) = &config.bicycle {
            devices.start(Source::Bicycle, SerialPort::new(path, config.baud, brake), QUEUE, &stopped)?;
        }
        if config.space_mouse {
            devices.start(Source::SpaceMouse, PuckPort::new(config.spacenavd_socket.clone()), QUEUE, &stopped)?;
        }
        #[cfg(target_os = "linux")]
        if config.gamepad {
            devices.start(Source::Gamepad, pad::PadPort, QUEUE, &stopped)?;
        }
        match &config.tracker {
            Some(TrackerUrl::Vrpn { host, port, device }) => {
                devices.start(Source::Vrpn, VrpnPort::new(host, *port, device), TRACKER_QUEUE, &stopped)?;
            }
            Some(TrackerUrl::Dtrack { address, port }) => {
                devices.start(Source::Dtrack, DtrackPort::new(*address, *port), TRACKER_QUEUE, &stopped)?;
            }
            Some(TrackerUrl::Mouse) | None => {}
        }
        Ok(devices)
    }

    fn start(
        &mut self,
        source: Source,
        port: impl Port + 'static,
        queue: usize,
        stopped: &Receiver<()>,
    ) -> Result<(), DevicesError> {
        let (feed, samples, live) = Feed::new(source, self.clock, queue, stopped.clone());
        let thread = thread::Builder::new()
            .name(source.name().to_owned())
            .spawn(move || feed.run(port))
            .map_err(|cause| DevicesError::Thread { source_device: source, cause })?;
        self.lanes.push(Lane { samples, live, thread });
        Ok(())
    }

    /// Everything that has arrived since the last call, in the order of arrival.
    pub fn drain(&self) -> Vec<Sample> {
        let mut samples: Vec<Sample> = Vec::new();
        for lane in &self.lanes {
            // No more than fit at once, or a flood would keep us here.
            samples.extend(lane.samples.try_iter().take(QUEUE));
        }
        samples.sort_by_key(|sample| sample.at);
        samples
    }

    /// Tells the bicycle how strongly to brake, 0 to 1. May be called every frame: only the newest
    /// is sent, and at most fifty a second.
    pub fn brake(&self, brake: f64) {
        self.brake.set(brake);
    }

    /// How the devices are.
    pub fn status(&self) -> Vec<Status> {
        let now = self.clock.now();
        self.lanes.iter().map(|lane| feed::status(&lane.live, now)).collect()
    }
}

impl Drop for Devices {
    /// Ends the threads; each looks up from its device at least ten times a second, and from waiting for a server
    /// after a second.
    fn drop(&mut self) {
        self.stop = None;
        for lane in self.lanes.drain(..) {
            let _ = lane.thread.join();
        }
    }
}
