//! What is remembered of a ride, so that it can be recorded at any moment from its beginning.
//!
//! A recording that starts in the middle could not be replayed: what came before decides what comes after. So every
//! entry is kept in memory until somebody wants a file, and goes straight to the file from then on.

use crate::error::Error;
use crate::simulation::Frame;
use input::Sample;
use input::recording::{ControlsRecord, Entry, Header, Recorder};
use std::path::Path;

/// Entries kept in memory: about three quarters of an hour at sixty frames a second.
const MOST_ENTRIES: usize = 500_000;

/// The ride so far: in memory as long as it is short enough, and in a file if one is wanted.
pub struct Log {
    header: Header,
    /// All entries; none once there were too many.
    kept: Option<Vec<Entry>>,
    file: Option<Recorder>,
}

impl Log {
    /// Begins with the ride.
    pub fn new(header: Header) -> Self {
        Self { header, kept: Some(Vec::new()), file: None }
    }

    /// Whether a file is being written.
    pub fn is_recording(&self) -> bool {
        self.file.is_some()
    }

    /// Takes what one frame was made from, and what came of it.
    ///
    /// # Errors
    /// The file cannot be written any further; recording has stopped, and what was written is kept.
    pub fn frame(&mut self, samples: &[Sample], frame: &Frame) -> Result<(), Error> {
        let (number, at) = (frame.record.frame, frame.record.at);
        if let Some(entries) = &mut self.kept {
            entries.extend(samples.iter().cloned().map(Entry::Sample));
            entries.push(Entry::Controls(ControlsRecord { frame: number, at, controls: frame.controls.clone() }));
            entries.push(Entry::Frame(frame.record.clone()));
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

    /// Writes the ride so far into a new file, and all that follows.
    ///
    /// # Errors
    /// The file cannot be written, or the ride has become too long to be remembered.
    pub fn record(&mut self, path: &Path) -> Result<(), Error> {
        if self.file.is_some() {
            return Ok(());
        }
        let entries = self.kept.as_ref().ok_or(Error::NotRemembered)?;
        let mut recorder = Recorder::create(path, &self.header)?;
        recorder.past(entries.clone())?;
        self.file = Some(recorder);
        Ok(())
    }

    /// Completes the file, if one is being written.
    ///
    /// # Errors
    /// The rest cannot be written.
    pub fn finish(&mut self) -> Result<(), Error> {
        self.file.take().map_or(Ok(()), |recorder| Ok(recorder.finish()?))
    }
}
