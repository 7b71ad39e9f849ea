//! Loop that keeps a device open, and the queue from its thread to the frame loop.

use std::io;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use crossbeam_channel::{Receiver, RecvTimeoutError, Sender, TryRecvError, TrySendError, bounded};

use super::fault::{DeviceFault, DeviceNote};
use crate::clock::{Clock, Nanos, SECOND, seconds_between};
use crate::sample::{Sample, SampleSource};

/// First pause before a device is looked for again.
const FIRST_PAUSE: Duration = Duration::from_millis(100);
/// Longest such pause; each is twice the one before.
const LONGEST_PAUSE: Duration = Duration::from_secs(2);

/// Place where a device can be found and opened.
pub(super) trait DevicePort: Send {
    /// Opens the device.
    ///
    /// # Errors
    /// What is missing, with what to do about it.
    fn open(&mut self) -> Result<(OpenedDevice, Box<dyn DeviceConnection>), DeviceFault>;
}

/// Device that has been opened.
#[derive(Clone, Debug)]
pub(super) struct OpenedDevice {
    pub(super) source: SampleSource,
    pub(super) name: String,
    pub(super) path: String,
}

/// Connection to an open device.
pub(super) trait DeviceConnection {
    /// Waits a tenth of a second at most for bytes and appends them to the buffer; nothing if none came.
    ///
    /// # Errors
    /// A device that is gone.
    fn read(&mut self, bytes: &mut Vec<u8>) -> io::Result<()>;

    /// Number of messages that were passed over for newer ones since the last call.
    fn passed_over(&mut self) -> u64 {
        0
    }

    /// Note on a device that is open and yet does not do all that it should.
    fn note(&self) -> Option<DeviceNote> {
        None
    }

    /// Asks for a full report: samples had to be dropped, and this device may report only changes.
    fn report_all(&mut self) {}
}

/// State of a device: open or not.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum DeviceState {
    /// The device is open.
    Open,
    /// The device is not open, for this reason.
    Absent(DeviceFault),
}

/// Status of a device, for a listing.
#[derive(Clone, Debug, PartialEq)]
pub struct DeviceStatus {
    /// Decoder that reads the device.
    pub source: SampleSource,
    /// Name that the device gives itself.
    pub name: String,
    /// Path or address of the device.
    pub path: String,
    /// State of the device: open, or the reason why not.
    pub state: DeviceState,
    /// Note on a device that is open and yet does not do all that it should.
    pub note: Option<DeviceNote>,
    /// Samples a second, over the last second.
    pub rate_hz: f64,
    /// Number of samples so far.
    pub samples: u64,
    /// Number of samples or messages that were dropped, because the queue was full or they came too fast.
    pub dropped: u64,
    /// Bytes of the last sample.
    pub last: Vec<u8>,
}

/// Status that a device's thread keeps up to date.
#[derive(Debug)]
pub(super) struct DeviceNews {
    status: DeviceStatus,
    second_began: Nanos,
    this_second: u32,
}

/// Status of a device, shared by its thread and the listing.
pub(super) type SharedNews = Arc<Mutex<DeviceNews>>;

/// Locks the status. It is whole at all times, even if a thread dies while it holds the lock.
fn lock(live: &SharedNews) -> MutexGuard<'_, DeviceNews> {
    live.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Status of a device at the time `now`.
pub(super) fn status(live: &SharedNews, now: Nanos) -> DeviceStatus {
    let live = lock(live);
    let mut status = live.status.clone();
    if seconds_between(live.second_began, now) > 2.0 {
        status.rate_hz = 0.0;
    }
    status
}

/// The thread's end of a device's queue.
pub(super) struct DeviceFeed {
    clock: Clock,
    queue: Sender<Sample>,
    /// Other end of the queue, to make room.
    oldest: Receiver<Sample>,
    live: SharedNews,
    stopped: Receiver<()>,
}

impl DeviceFeed {
    /// Feed with a queue of this length, the queue's other end, and the shared status.
    pub(super) fn new(
        source: SampleSource,
        clock: Clock,
        length: usize,
        stopped: Receiver<()>,
    ) -> (Self, Receiver<Sample>, SharedNews) {
        let (queue, samples) = bounded(length);
        let status = DeviceStatus {
            source,
            name: source.name().to_owned(),
            path: String::new(),
            state: DeviceState::Absent(DeviceFault::Sought),
            note: None,
            rate_hz: 0.0,
            samples: 0,
            dropped: 0,
            last: Vec::new(),
        };
        let live = Arc::new(Mutex::new(DeviceNews { status, second_began: clock.now(), this_second: 0 }));
        (Self { clock, queue, oldest: samples.clone(), live: live.clone(), stopped }, samples, live)
    }

    /// Keeps the device open until the program ends.
    pub(super) fn run(self, mut port: impl DevicePort) {
        let mut pause = FIRST_PAUSE;
        while !self.is_stopped() {
            match port.open() {
                Ok((place, mut connection)) => {
                    let began = Instant::now();
                    let source = place.source;
                    self.opened(place);
                    let why = self.read(source, connection.as_mut());
                    self.send(Sample::closed(self.clock.now(), source));
                    self.absent(why);
                    // A device that goes as soon as it has come is given time.
                    pause = if began.elapsed() > LONGEST_PAUSE { FIRST_PAUSE } else { (2 * pause).min(LONGEST_PAUSE) };
                }
                Err(why) => {
                    self.absent(why);
                    pause = (2 * pause).min(LONGEST_PAUSE);
                }
            }
            // This wait ends at once when the program ends.
            if self.stopped.recv_timeout(pause) != Err(RecvTimeoutError::Timeout) {
                return;
            }
        }
    }

    /// Reads until the device goes or the program ends; returns the reason.
    fn read(&self, source: SampleSource, connection: &mut dyn DeviceConnection) -> DeviceFault {
        let mut bytes = Vec::new();
        let mut noted = None;
        while !self.is_stopped() {
            bytes.clear();
            if let Err(error) = connection.read(&mut bytes) {
                return DeviceFault::Gone(Box::new(error.into()));
            }
            let passed_over = connection.passed_over();
            if passed_over > 0 {
                lock(&self.live).status.dropped += passed_over;
            }
            if connection.note() != noted {
                noted = connection.note();
                lock(&self.live).status.note = noted;
            }
            if !bytes.is_empty() && self.bytes(source, &bytes) {
                connection.report_all();
            }
        }
        DeviceFault::ProgramEnds
    }

    fn is_stopped(&self) -> bool {
        self.stopped.try_recv() == Err(TryRecvError::Disconnected)
    }

    fn opened(&self, place: OpenedDevice) {
        let mut live = lock(&self.live);
        let OpenedDevice { source, name, path } = place;
        live.status = DeviceStatus { source, name, path, state: DeviceState::Open, ..live.status.clone() };
        drop(live);
        self.send(Sample::opened(self.clock.now(), source));
    }

    fn absent(&self, why: DeviceFault) {
        let mut live = lock(&self.live);
        live.status.state = DeviceState::Absent(why);
        live.status.note = None;
        live.status.rate_hz = 0.0;
    }

    /// Queues bytes; true if others were dropped for them.
    fn bytes(&self, source: SampleSource, bytes: &[u8]) -> bool {
        let now = self.clock.now();
        let dropped = self.send(Sample::bytes(now, source, bytes));
        let mut live = lock(&self.live);
        live.status.samples += 1;
        live.status.last.clear();
        live.status.last.extend_from_slice(bytes);
        live.this_second += 1;
        let elapsed_s = seconds_between(live.second_began, now);
        if now.saturating_sub(live.second_began) >= SECOND {
            live.status.rate_hz = f64::from(live.this_second) / elapsed_s;
            (live.second_began, live.this_second) = (now, 0);
        }
        dropped
    }

    /// Queues a sample, in place of the oldest if the queue is full; true if it was.
    fn send(&self, sample: Sample) -> bool {
        let mut sample = sample;
        let mut dropped = 0;
        // The loop ends, because only this thread fills the queue.
        while let Err(TrySendError::Full(back)) = self.queue.try_send(sample) {
            sample = back;
            dropped += u64::from(self.oldest.try_recv().is_ok());
        }
        lock(&self.live).status.dropped += dropped;
        dropped > 0
    }
}

#[cfg(test)]
mod tests {
    //! A flood that the frame loop does not drain must cost the oldest samples, never the newest, and no memory.
    use super::*;

    fn feed(length: usize) -> (DeviceFeed, Receiver<Sample>, SharedNews, Sender<()>) {
        let (stop, stopped) = bounded(0);
        let (feed, samples, live) = DeviceFeed::new(SampleSource::Bicycle, Clock::start(), length, stopped);
        (feed, samples, live, stop)
    }

    #[test]
    fn a_flood_drops_the_oldest_and_says_so() {
        let (feed, samples, live, _stop) = feed(4);
        let dropped: Vec<bool> = (0..10_u8).map(|n| feed.bytes(SampleSource::Bicycle, &[n])).collect();
        assert_eq!(dropped, [[false; 4].as_slice(), &[true; 6]].concat());
        let kept: Vec<_> = samples.try_iter().map(|sample| sample.signal).collect();
        let expected: Vec<_> = (6..10_u8).map(|n| Sample::bytes(0, SampleSource::Bicycle, [n]).signal).collect();
        assert_eq!(kept, expected);
        let status = status(&live, 0);
        assert_eq!((status.samples, status.dropped, status.last), (10, 6, vec![9]));
    }

    /// Device that sends one byte and goes, a number of times; then it cannot be opened.
    struct Flaky {
        lives: u8,
    }

    impl DevicePort for Flaky {
        fn open(&mut self) -> Result<(OpenedDevice, Box<dyn DeviceConnection>), DeviceFault> {
            self.lives = self.lives.checked_sub(1).ok_or(DeviceFault::NothingThere)?;
            let place = OpenedDevice { source: SampleSource::Bicycle, name: "flaky".into(), path: "nowhere".into() };
            Ok((place, Box::new(SaysOnce(Some(self.lives)))))
        }
    }

    struct SaysOnce(Option<u8>);

    impl DeviceConnection for SaysOnce {
        fn read(&mut self, bytes: &mut Vec<u8>) -> io::Result<()> {
            bytes.push(self.0.take().ok_or(io::ErrorKind::BrokenPipe)?);
            Ok(())
        }
    }

    #[test]
    fn a_device_that_comes_and_goes_is_opened_again_and_closed_each_time() {
        let (feed, samples, live, stop) = feed(64);
        let thread = std::thread::spawn(move || feed.run(Flaky { lives: 2 }));
        let seen: Vec<_> = samples.iter().take(6).map(|sample| sample.signal).collect();
        let bytes = |byte: u8| Sample::bytes(0, SampleSource::Bicycle, [byte]).signal;
        use crate::sample::Signal::{Closed, Opened};
        assert_eq!(seen, [Opened, bytes(1), Closed, Opened, bytes(0), Closed]);
        while status(&live, 0).state != DeviceState::Absent(DeviceFault::NothingThere) {
            std::thread::sleep(Duration::from_millis(5));
        }
        drop(stop);
        thread.join().unwrap();
    }

    #[test]
    fn a_device_that_goes_as_soon_as_it_has_come_is_given_time() {
        let (feed, samples, _live, stop) = feed(4096);
        let thread = std::thread::spawn(move || feed.run(Flaky { lives: 200 }));
        std::thread::sleep(Duration::from_secs(1));
        drop(stop);
        thread.join().unwrap();
        // Openings at 0, 0.2, 0.6 and 1.4 s.
        let lives = samples.try_iter().filter(|sample| sample.signal == crate::sample::Signal::Opened).count();
        assert!((2..=3).contains(&lives), "{lives}");
    }
}
