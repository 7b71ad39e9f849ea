//! Headset as a tracker: head and hands of an OpenXR session that shows no pictures.

use std::io;
use std::time::{Duration, Instant};

use super::fault::DeviceFault;
use super::feed::{DeviceConnection, DevicePort, OpenedDevice};
use crate::openxr::{XrFault, XrHands, XrReport, XrRuntime, XrState, XrUse};
use crate::sample::SampleSource;

/// Time between two reports: more often than any headset measures, as often as any shows.
const PERIOD: Duration = Duration::from_millis(8);
/// Time for which a session that does not run is left alone.
const REST: Duration = Duration::from_millis(50);

/// Headset of this machine's runtime.
pub(super) struct OpenxrPort;

impl DevicePort for OpenxrPort {
    fn open(&mut self) -> Result<(OpenedDevice, Box<dyn DeviceConnection>), DeviceFault> {
        let runtime = XrRuntime::new(XrUse::Tracker)?;
        let session = runtime.headless()?;
        let hands = XrHands::new(&runtime, &session)?;
        let place =
            OpenedDevice { source: SampleSource::Openxr, name: runtime.headset(), path: runtime.name().to_owned() };
        let (state, next, last) = (XrState::default(), Instant::now(), None);
        Ok((place, Box::new(HeadsetLink { hands, session, runtime, state, next, last })))
    }
}

/// Session with the headset. Fields are dropped in their order, the runtime last.
struct HeadsetLink {
    hands: XrHands,
    session: openxr::Session<openxr::Headless>,
    runtime: XrRuntime,
    state: XrState,
    /// Time of the next report.
    next: Instant,
    /// Report after which the headset does not rest.
    last: Option<XrReport>,
}

impl HeadsetLink {
    fn report(&mut self) -> Result<Option<Vec<u8>>, XrFault> {
        let news = self.runtime.follow(&self.session, &mut self.state)?;
        self.hands.stage_moves_at(news.stage_moves);
        if self.state == XrState::Idle {
            std::thread::sleep(REST);
            return Ok(self.last.take().map(|last| last.at_rest().to_bytes()));
        }
        std::thread::sleep(self.next.saturating_duration_since(Instant::now()));
        self.next = Instant::now() + PERIOD;
        let now = self.runtime.instance.now().map_err(self.runtime.refused("the time"))?;
        let report = self.hands.report(&self.runtime, &self.session, now)?;
        self.last = Some(report);
        Ok(Some(report.to_bytes()))
    }
}

impl DeviceConnection for HeadsetLink {
    fn read(&mut self, bytes: &mut Vec<u8>) -> io::Result<()> {
        match self.report() {
            Ok(report) => bytes.extend(report.into_iter().flatten()),
            Err(fault) => return Err(DeviceFault::from(fault).io(io::ErrorKind::Other)),
        }
        Ok(())
    }
}
