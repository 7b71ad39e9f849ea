//! Log of a ride, so that it can be recorded at any moment from its beginning.
//!
//! A recording that starts in the middle could not be replayed, because later states depend on earlier input. Every
//! entry is therefore kept in memory until a file is wanted, and is written to the file as well from then on.
//!
//! A file is not created before there is a frame to be written: windows take their time to open, and a program that
//! is ended meanwhile would leave a recording of nothing.

use crate::frame::RideFrame;
use input::recording::{ControlsRecord, Recorder, RecordingEntry, RecordingError, RideHeader};
use input::{Nanos, Sample};
use std::path::{Path, PathBuf};
use std::time::{SystemTime, UNIX_EPOCH};
use thiserror::Error;

/// Largest memory of the entries that are kept, bytes: about an hour at sixty frames per second.
const MOST_REMEMBERED: usize = 256 << 20;

/// Reason why a ride is not recorded.
#[derive(Debug, Error)]
pub enum LogError {
    /// A file that cannot be written.
    #[error(transparent)]
    Recording(#[from] RecordingError),
    /// A ride too long to be recorded from its beginning.
    #[error("the ride so far is no longer remembered, so it cannot be recorded; start the program with --record FILE")]
    NotRemembered,
    /// A recording that has failed during the ride.
    #[error("{}: the ride was not recorded to its end", path.display())]
    Incomplete {
        /// Path of the recording.
        path: PathBuf,
    },
}

/// Log of the ride so far: in memory as long as it is short enough, and in a file if one is wanted.
pub struct RideLog {
    header: RideHeader,
    /// Entries since the beginning; `None` once there were too many.
    kept: Option<Vec<RecordingEntry>>,
    /// Memory of the kept entries, bytes.
    remembered: usize,
    /// Beginning of the ride, nanoseconds since 1970, once it has begun.
    began: Option<u64>,
    file: Option<(PathBuf, Recorder)>,
    /// Path of a recording that is created with the ride's first frame.
    awaited: Option<PathBuf>,
    /// First recording that has failed.
    failed: Option<PathBuf>,
}

impl RideLog {
    /// Creates the log at the beginning of the ride.
    pub fn new(header: RideHeader) -> Self {
        Self { header, kept: Some(Vec::new()), remembered: 0, began: None, file: None, awaited: None, failed: None }
    }

    /// True if the ride is being recorded, from its first frame on.
    pub fn is_recording(&self) -> bool {
        self.file.is_some() || self.awaited.is_some()
    }

    /// Path of a recording that is created with the ride's first frame; there is no file yet.
    pub fn awaited(&self) -> Option<&Path> {
        self.awaited.as_deref()
    }

    /// Keeps nothing of the past in memory from now on, for rides that nobody records from their beginning later.
    pub fn forget(&mut self) {
        self.kept = None;
    }

    /// Adds the samples of one frame and the frame's result.
    ///
    /// # Errors
    /// [`LogError`] if the file cannot be written any further. Recording has stopped then, and the part already written
    /// is kept.
    pub fn frame(&mut self, samples: &[Sample], frame: &RideFrame) -> Result<(), LogError> {
        let (number, at) = (frame.record.frame, frame.record.at);
        let begun = if self.began.is_none() { self.begin(at) } else { Ok(()) };
        self.remember(samples, frame);
        begun?;
        self.write(|recorder| {
            samples.iter().try_for_each(|sample| recorder.sample(sample))?;
            recorder.controls(number, at, &frame.controls)?;
            recorder.frame(&frame.record)
        })
    }

    /// Begins the ride, whose clock shows `at`, and the recording that waits for it.
    fn begin(&mut self, at: Nanos) -> Result<(), LogError> {
        let began = unix_now().saturating_sub(at);
        self.began = Some(began);
        if let Some(path) = self.awaited.take() {
            match Recorder::create(&path, &self.header) {
                Ok(recorder) => self.file = Some((path, recorder)),
                Err(error) => {
                    self.failed.get_or_insert(path);
                    return Err(error.into());
                }
            }
        }
        self.write(|recorder| recorder.began(began))
    }

    /// Keeps the entries of a frame in memory, as long as there is room.
    fn remember(&mut self, samples: &[Sample], frame: &RideFrame) {
        let Some(kept) = &mut self.kept else { return };
        let (number, at) = (frame.record.frame, frame.record.at);
        let first = kept.len();
        kept.extend(samples.iter().cloned().map(RecordingEntry::Sample));
        let controls = frame.controls.clone();
        kept.push(RecordingEntry::Controls(ControlsRecord { frame: number, at, controls }));
        kept.push(RecordingEntry::Frame(frame.record.clone()));
        self.remembered += kept[first..].iter().map(RecordingEntry::memory).sum::<usize>();
        if self.remembered > MOST_REMEMBERED {
            self.kept = None;
        }
    }

    /// Writes into the file, if there is one. The file is given up at the first error.
    fn write(&mut self, write: impl FnOnce(&mut Recorder) -> Result<(), RecordingError>) -> Result<(), LogError> {
        let Some((path, mut recorder)) = self.file.take() else { return Ok(()) };
        match write(&mut recorder) {
            Ok(()) => {
                self.file = Some((path, recorder));
                Ok(())
            }
            Err(error) => {
                self.failed.get_or_insert(path);
                Err(error.into())
            }
        }
    }

    /// Writes the ride so far into a new file, and from now on everything that follows. Before the first frame the
    /// file is only made sure of.
    ///
    /// # Errors
    /// [`LogError`] if the file cannot be written, or the ride has become too long to be kept in memory.
    pub fn record(&mut self, path: &Path) -> Result<(), LogError> {
        if self.is_recording() {
            return Ok(());
        }
        let Some(began) = self.began else {
            Recorder::check(path)?;
            self.awaited = Some(path.to_owned());
            return Ok(());
        };
        let entries = self.kept.as_ref().ok_or(LogError::NotRemembered)?;
        let mut recorder = Recorder::create(path, &self.header)?;
        recorder.began(began)?;
        recorder.past(entries.clone())?;
        self.file = Some((path.to_owned(), recorder));
        Ok(())
    }

    /// Completes the file, if one is being written; the ride goes on. No file is left of a ride without a frame.
    ///
    /// # Errors
    /// [`LogError`] if the rest cannot be written.
    pub fn stop(&mut self) -> Result<(), LogError> {
        self.awaited = None;
        let Some((path, recorder)) = self.file.take() else { return Ok(()) };
        recorder.finish().map_err(|error| {
            self.failed.get_or_insert(path);
            error.into()
        })
    }

    /// Completes the file at the end of the ride.
    ///
    /// # Errors
    /// [`LogError`] if the rest cannot be written, or if a recording has failed during the ride.
    pub fn finish(&mut self) -> Result<(), LogError> {
        self.stop()?;
        self.failed.take().map_or(Ok(()), |path| Err(LogError::Incomplete { path }))
    }
}

/// Present moment, nanoseconds since 1970.
fn unix_now() -> u64 {
    let now = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default();
    u64::try_from(now.as_nanos()).unwrap_or(u64::MAX)
}
