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

/// The ride so far, in memory or in a file.
pub struct Log {
    header: Header,
    state: State,
}

enum State {
    Kept(Vec<Entry>),
    Written(Recorder),
    TooLong,
}

impl Log {
    /// Begins with the ride.
    pub fn new(header: Header) -> Self {
        Self { header, state: State::Kept(Vec::new()) }
    }

    /// Whether a file is being written.
    pub fn is_recording(&self) -> bool {
        matches!(self.state, State::Written(_))
    }

    /// Takes what one frame was made from, and what came of it.
    ///
    /// # Errors
    /// The file cannot be written any further; recording has stopped, and what was written is kept.
    pub fn frame(&mut self, samples: &[Sample], frame: &Frame) -> Result<(), Error> {
        let number = frame.record.frame;
        match &mut self.state {
            State::TooLong => Ok(()),
            State::Kept(entries) if entries.len() >= MOST_ENTRIES => {
                self.state = State::TooLong;
                Ok(())
            }
            State::Kept(entries) => {
                entries.extend(samples.iter().cloned().map(Entry::Sample));
                let controls = frame.controls.clone();
                entries.push(Entry::Controls(ControlsRecord { frame: number, at: frame.record.at, controls }));
                entries.push(Entry::Frame(frame.record.clone()));
                Ok(())
            }
            State::Written(recorder) => {
                let written = (|| {
                    for sample in samples {
                        recorder.sample(sample)?;
                    }
                    recorder.controls(number, frame.record.at, &frame.controls)?;
                    recorder.frame(&frame.record)
                })();
                written.map_err(|error| {
                    self.state = State::TooLong;
                    error.into()
                })
            }
        }
    }

    /// Writes the ride so far into a new file, and all that follows.
    ///
    /// # Errors
    /// The file cannot be written, or the ride has become too long to be remembered.
    pub fn record(&mut self, path: &Path) -> Result<(), Error> {
        match &self.state {
            State::Written(_) => return Ok(()),
            State::TooLong => return Err(Error::NotRemembered),
            State::Kept(_) => {}
        }
        let mut recorder = Recorder::create(path, &self.header)?;
        if let State::Kept(entries) = std::mem::replace(&mut self.state, State::TooLong) {
            recorder.past(entries)?;
        }
        self.state = State::Written(recorder);
        Ok(())
    }

    /// Completes the file, if one is being written. What follows is not remembered.
    ///
    /// # Errors
    /// The rest cannot be written.
    pub fn finish(&mut self) -> Result<(), Error> {
        match std::mem::replace(&mut self.state, State::TooLong) {
            State::Written(recorder) => Ok(recorder.finish()?),
            State::Kept(_) | State::TooLong => Ok(()),
        }
    }
}
