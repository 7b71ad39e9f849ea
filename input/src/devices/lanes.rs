//! All devices that are looked for, each with its thread and its queue.

use std::sync::Arc;
use std::sync::atomic::{AtomicI16, Ordering};
use std::thread::{self, JoinHandle};

use crossbeam_channel::{Receiver, Sender, bounded};
use thiserror::Error;

use super::config::DevicesConfig;
use super::dtrack::DtrackPort;
use super::feed::{DeviceFeed, DevicePort, DeviceStatus, SharedNews, status};
use super::opentrack::OpentrackPort;
use super::openxr::OpenxrPort;
use super::puck::PuckPort;
use super::serial::{BrakeSlot, SerialPort};
use super::trainer::TrainerPort;
use super::vrpn::VrpnPort;
use crate::clock::Clock;
use crate::head::url::TrackerUrl;
use crate::sample::{Sample, SampleSource};
use crate::trainer::RoadLoad;

/// Length of a device's queue, samples: several seconds of the fastest device.
const QUEUE: usize = 4096;
/// Length of a tracker's queue, samples, which are longer.
const TRACKER_QUEUE: usize = 1024;

/// Error that prevents the devices from being read.
#[derive(Debug, Error)]
pub enum DevicesError {
    /// A thread that the system refuses.
    #[error("cannot start the thread that reads the {source_device}: {cause}")]
    Thread {
        /// Device of the thread.
        source_device: SampleSource,
        /// Error of the system.
        cause: std::io::Error,
    },
}

/// Thread of one device, and its queue.
#[derive(Debug)]
struct DeviceLane {
    samples: Receiver<Sample>,
    live: SharedNews,
    thread: JoinHandle<()>,
}

/// All devices that are looked for.
#[derive(Debug)]
pub struct Devices {
    clock: Clock,
    lanes: Vec<DeviceLane>,
    brake: Arc<BrakeSlot>,
    /// Grade that the trainer simulates, in 0.01 %.
    grade: Arc<AtomicI16>,
    /// Share of the slope that the trainer makes felt.
    slope_felt: f64,
    /// Channel that is closed to end the threads.
    stop: Option<Sender<()>>,
}

impl Devices {
    /// Starts to look for the devices.
    ///
    /// # Errors
    /// A thread that cannot be started. A missing device is no error.
    pub fn open(config: &DevicesConfig, clock: Clock) -> Result<Self, DevicesError> {
        let (stop, stopped) = bounded(0);
        let brake = Arc::new(BrakeSlot::default());
        let mut devices = Self {
            clock,
            lanes: Vec::new(),
            brake: brake.clone(),
            grade: Arc::default(),
            slope_felt: f64::from(config.slope_felt_percent) / 100.0,
            stop: Some(stop),
        };
        if let Some(path) = &config.bicycle {
            devices.start(SampleSource::Bicycle, SerialPort::new(path, config.baud, brake), QUEUE, &stopped)?;
        }
        if let Some(url) = &config.trainer {
            let port = TrainerPort::new(url.clone(), devices.grade.clone());
            devices.start(SampleSource::Trainer, port, TRACKER_QUEUE, &stopped)?;
        }
        if config.space_mouse {
            devices.start(SampleSource::SpaceMouse, PuckPort::new(config.spacenavd_socket.clone()), QUEUE, &stopped)?;
        }
        #[cfg(target_os = "linux")]
        if config.gamepad {
            devices.start(SampleSource::Gamepad, super::pad::PadPort, QUEUE, &stopped)?;
        }
        match &config.tracker {
            Some(TrackerUrl::Vrpn { host, port, device }) => {
                devices.start(
                    SampleSource::Vrpn,
                    VrpnPort::new(host, *port, device, &config.wand_devices),
                    TRACKER_QUEUE,
                    &stopped,
                )?;
            }
            Some(TrackerUrl::Dtrack { address, port }) => {
                devices.start(SampleSource::Dtrack, DtrackPort::new(*address, *port), TRACKER_QUEUE, &stopped)?;
            }
            Some(TrackerUrl::Opentrack { address, port }) => {
                devices.start(SampleSource::Opentrack, OpentrackPort::new(*address, *port), TRACKER_QUEUE, &stopped)?;
            }
            Some(TrackerUrl::Openxr) => {
                devices.start(SampleSource::Openxr, OpenxrPort, TRACKER_QUEUE, &stopped)?;
            }
            Some(TrackerUrl::Mouse) | None => {}
        }
        Ok(devices)
    }

    fn start(
        &mut self,
        source: SampleSource,
        port: impl DevicePort + 'static,
        queue: usize,
        stopped: &Receiver<()>,
    ) -> Result<(), DevicesError> {
        let (feed, samples, live) = DeviceFeed::new(source, self.clock, queue, stopped.clone());
        let thread = thread::Builder::new()
            .name(source.name().to_owned())
            .spawn(move || feed.run(port))
            .map_err(|cause| DevicesError::Thread { source_device: source, cause })?;
        self.lanes.push(DeviceLane { samples, live, thread });
        Ok(())
    }

    /// Samples that have arrived since the last call, in the order of arrival.
    pub fn drain(&self) -> Vec<Sample> {
        let mut samples: Vec<Sample> = Vec::new();
        for lane in &self.lanes {
            // No more than the queue holds, or a flood would keep this loop going.
            samples.extend(lane.samples.try_iter().take(QUEUE));
        }
        samples.sort_by_key(|sample| sample.at);
        samples
    }

    /// Sends the bicycle a brake command, 0 to 1. This may be called every frame: only the newest is sent, and at
    /// most fifty a second.
    pub fn brake(&self, brake: f64) {
        self.brake.set(brake);
    }

    /// Tells the trainer the road. This may be called every frame: a grade that changes is sent a few times a second.
    pub fn load(&self, load: RoadLoad) {
        self.grade.store(load.grade(self.slope_felt), Ordering::Relaxed);
    }

    /// Status of each device.
    pub fn status(&self) -> Vec<DeviceStatus> {
        let now = self.clock.now();
        self.lanes.iter().map(|lane| status(&lane.live, now)).collect()
    }
}

impl Drop for Devices {
    /// Ends the threads. Each looks up from its device at least ten times a second, from waiting for a server after a
    /// second or two, and from releasing a trainer that answers late after as long.
    fn drop(&mut self) {
        self.stop = None;
        for lane in self.lanes.drain(..) {
            let _ = lane.thread.join();
        }
    }
}
