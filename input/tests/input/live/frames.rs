//! A frame loop for the tests of live devices.

use std::time::{Duration, Instant};

use input::devices::DeviceState;
use input::{Clock, Desk, DeskConfig, Devices, DevicesConfig, HeadConfig, HeadState};

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
}

impl Loop {
    /// Starts the devices.
    pub fn start(config: &DevicesConfig) -> Self {
        let clock = Clock::start();
        let devices = Devices::open(config, clock).unwrap();
        Self { clock, devices, desk: Desk::new(Default::default()).unwrap() }
    }

    /// Starts a tracker alone, and a head that it tracks.
    pub fn track(url: &str) -> Self {
        let head = HeadConfig::new(url.parse().unwrap());
        let tracker = Some(head.url.clone());
        let mut tracking =
            Self::start(&DevicesConfig { space_mouse: false, gamepad: false, tracker, ..Default::default() });
        tracking.desk = Desk::new(DeskConfig { head: Some(head), ..Default::default() }).unwrap();
        tracking
    }

    /// Head at this moment.
    pub fn head(&mut self) -> HeadState {
        let now = self.clock.now();
        self.desk.controls(now).head.unwrap()
    }

    /// Runs frames until the condition holds.
    pub fn until(&mut self, what: &str, mut holds: impl FnMut(&mut Self) -> bool) {
        let start = Instant::now();
        loop {
            for sample in self.devices.drain() {
                self.desk.feed(&sample);
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
