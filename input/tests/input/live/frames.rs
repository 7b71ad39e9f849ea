//! A frame loop for the tests of live devices.

use std::collections::BTreeMap;
use std::time::{Duration, Instant};

use input::devices::DeviceState;
use input::recording::{Recorder, Recording, RecordingEntry, RideHeader};
use input::{
    Clock, Controls, Desk, DeskConfig, Devices, DevicesConfig, HeadConfig, HeadState, Nanos, Sample, VehicleKind,
};

/// Longest wait, more than any pause before a device is looked for again, on a busy machine.
const PATIENCE: Duration = Duration::from_secs(8);

/// Frame loop without pictures, which drains the devices into a desk.
pub struct Loop {
    /// Clock of the ride.
    pub clock: Clock,
    /// Devices of the loop.
    pub devices: Devices,
    /// Desk with the decoders.
    pub desk: Desk,
    /// Ride so far: samples, and the controls that were read.
    ridden: Vec<Ridden>,
}

/// Step of a ride.
enum Ridden {
    Sample(Sample),
    Controls(Nanos, Box<Controls>),
}

impl Loop {
    /// Starts the devices.
    pub fn start(config: &DevicesConfig) -> Self {
        let clock = Clock::start();
        let devices = Devices::open(config, clock).unwrap();
        Self { clock, devices, desk: Desk::new(Default::default()).unwrap(), ridden: Vec::new() }
    }

    /// Starts a tracker alone, and a head that it tracks.
    pub fn track(url: &str) -> Self {
        Self::track_head(HeadConfig::new(url.parse().unwrap()))
    }

    /// Starts a tracker alone, and a head with these settings.
    pub fn track_head(head: HeadConfig) -> Self {
        let (tracker, wand_devices) = (Some(head.url.clone()), head.wand_devices());
        let config = DevicesConfig { space_mouse: false, gamepad: false, tracker, wand_devices, ..Default::default() };
        let mut tracking = Self::start(&config);
        tracking.desk = Desk::new(DeskConfig { head: Some(head), ..Default::default() }).unwrap();
        tracking
    }

    /// Head at this moment.
    pub fn head(&mut self) -> HeadState {
        self.controls().head.unwrap()
    }

    /// Controls at this moment.
    pub fn controls(&mut self) -> Controls {
        let now = self.clock.now();
        let controls = self.desk.controls(now);
        self.ridden.push(Ridden::Controls(now, Box::new(controls.clone())));
        controls
    }

    /// Checks that a recording of the ride so far replays to the same bits; returns the number of controls.
    pub fn replays_to_the_bit(&self) -> usize {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("ride.mcap");
        let header = RideHeader {
            build: "0.1.0 (test)".to_owned(),
            scene: "town".to_owned(),
            speed_of_light_m_s: 30.0 / 3.6,
            vehicle: VehicleKind::Bicycle,
            integrator: "rk4".to_owned(),
            step_s: 1.0 / 240.0,
            desk: self.desk.config().clone(),
            settings: BTreeMap::new(),
        };
        let mut recorder = Recorder::create(&path, &header).unwrap();
        let mut frame = 0;
        for ridden in &self.ridden {
            match ridden {
                Ridden::Sample(sample) => recorder.sample(sample).unwrap(),
                Ridden::Controls(at, controls) => {
                    recorder.controls(frame, *at, controls).unwrap();
                    frame += 1;
                }
            }
        }
        recorder.finish().unwrap();

        let recording = Recording::open(&path).unwrap();
        let mut desk = Desk::new(recording.header().desk.clone()).unwrap();
        let mut replayed = 0;
        for entry in recording {
            match entry.unwrap() {
                RecordingEntry::Sample(sample) => desk.feed(&sample),
                RecordingEntry::Controls(record) => {
                    let bits = |controls: &Controls| serde_json::to_string(controls).unwrap();
                    assert_eq!(bits(&desk.controls(record.at)), bits(&record.controls));
                    replayed += 1;
                }
                RecordingEntry::Frame(_) => {}
            }
        }
        assert_eq!(replayed, self.ridden.iter().filter(|it| matches!(it, Ridden::Controls(..))).count());
        replayed
    }

    /// Runs frames until the condition holds.
    pub fn until(&mut self, what: &str, mut holds: impl FnMut(&mut Self) -> bool) {
        let start = Instant::now();
        loop {
            for sample in self.devices.drain() {
                self.desk.feed(&sample);
                self.ridden.push(Ridden::Sample(sample));
            }
            if holds(self) {
                return;
            }
            assert!(start.elapsed() < PATIENCE, "waited too long for: {what}; {:?}", self.devices.status());
            std::thread::sleep(Duration::from_millis(2));
        }
    }

    /// Runs frames until the only device is open, or is not.
    pub fn until_open(&mut self, open: bool) {
        self.until(if open { "opening" } else { "closing" }, |it| {
            (it.devices.status()[0].state == DeviceState::Open) == open
        });
    }
}
