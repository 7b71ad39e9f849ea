//! Log of a ride, so that it can be recorded at any moment from its beginning.
//!
//! A recording that starts in the middle could not be replayed, because later states depend on earlier input. Every
//! entry is therefore kept in memory until a file is wanted, and is written to the file as well from then on.

use crate::frame::RideFrame;
use input::Sample;
use input::recording::{ControlsRecord, Recorder, RecordingEntry, RecordingError, RideHeader};
use std::path::Path;
use thiserror::Error;

/// Largest number of entries kept in memory: about three quarters of an hour at sixty frames per second.
const MOST_ENTRIES: usize = 500_000;

/// Reason why a ride is not recorded.
#[derive(Debug, Error)]
pub enum LogError {
    /// A file that cannot be written.
    #[error(transparent)]
    Recording(#[from] RecordingError),
    /// A ride too long to be recorded from its beginning.
    #[error("the ride so far is no longer remembered, so it cannot be recorded; start the program with --record FILE")]
    NotRemembered,
}

/// Log of the ride so far: in memory as long as it is short enough, and in a file if one is wanted.
pub struct RideLog {
    header: RideHeader,
    /// Entries since the beginning; `None` once there were too many.
    kept: Option<Vec<RecordingEntry>>,
    file: Option<Recorder>,
}

impl RideLog {
    /// Creates the log at the beginning of the ride.
    pub fn new(header: RideHeader) -> Self {
        Self { header, kept: Some(Vec::new()), file: None }
    }

    /// True if a file is being written.
    pub fn is_recording(&self) -> bool {
        self.file.is_some()
    }

    /// Adds the samples of one frame and the frame's result.
    ///
    /// # Errors
    /// [`LogError`] if the file cannot be written any further. Recording has stopped then, and the part already written
    /// is kept.
    pub fn frame(&mut self, samples: &[Sample], frame: &RideFrame) -> Result<(), LogError> {
        let (number, at) = (frame.record.frame, frame.record.at);
        if let Some(entries) = &mut self.kept {
            entries.extend(samples.iter().cloned().map(RecordingEntry::Sample));
            entries.push(RecordingEntry::Controls(ControlsRecord {
                frame: number,
                at,
                controls: frame.controls.clone(),
            }));
            entries.push(RecordingEntry::Frame(frame.record.clone()));
            if entries.len() >= MOST_ENTRIES {
                self.kept = None;
            }
        }
        let Some(recorder) = &mut self.file else { return Ok(()) };
        let mut write = || {
            samples.iter().try_for_each(|sample| recorder.sample(sample))?;
            recorder.controls(number, at, &frame.controls)?;
            recorder.frame(&frame.record)
        };
        let written = write();
        written.map_err(|error| {
            self.file = None;
            error.into()
        })
    }

    /// Writes the ride so far into a new file, and from now on everything that follows.
    ///
    /// # Errors
    /// [`LogError`] if the file cannot be written, or the ride has become too long to be kept in memory.
    pub fn record(&mut self, path: &Path) -> Result<(), LogError> {
        if self.file.is_some() {
            return Ok(());
        }
        let entries = self.kept.as_ref().ok_or(LogError::NotRemembered)?;
        let mut recorder = Recorder::create(path, &self.header)?;
        recorder.past(entries.clone())?;
        self.file = Some(recorder);
        Ok(())
    }

    /// Completes the file, if one is being written.
    ///
    /// # Errors
    /// [`LogError`] if the rest cannot be written.
    pub fn finish(&mut self) -> Result<(), LogError> {
        self.file.take().map_or(Ok(()), |recorder| Ok(recorder.finish()?))
    }
}
