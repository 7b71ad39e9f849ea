//! Replay: a recorded ride simulated again from its raw bytes, and the proof that it is the same to the bit.

use std::sync::Arc;

use input::recording::{FrameDifference, Recording, RecordingEntry, RecordingError};
use input::{Controls, Sample};
use thiserror::Error;

use scene::Surroundings;

use crate::frame::RideFrame;
use crate::setup::{Setup, SetupError};
use crate::simulation::Simulation;
use crate::taker::FrameTaker;

/// Recorded ride that is simulated again, frame by frame.
///
/// A recording holds for each frame, in this order: the samples handed to [`Simulation::frame`], the controls, and
/// the [`RideFrame::record`].
pub struct Replay<Entries = Recording> {
    simulation: Simulation,
    entries: Entries,
    frames: u64,
}

impl Replay<Recording> {
    /// Begins a replay of the recorded ride, in the scene that the header names.
    ///
    /// # Errors
    /// [`SetupError`] if the header does not hold a ride of this program.
    pub fn new(recording: Recording, surroundings: Arc<dyn Surroundings>) -> Result<Self, SetupError> {
        let setup = Setup::from_header(recording.header())?;
        Self::of(recording, setup, surroundings)
    }
}

impl Replay<Recording> {
    /// Setting of the recording's header by its key.
    pub fn header_setting(&self, key: &str) -> Option<&str> {
        self.entries.header().settings.get(key).map(String::as_str)
    }

    /// Name of the scene that was ridden in, as on the command line.
    pub fn scene(&self) -> &str {
        &self.entries.header().scene
    }

    /// Place at which another recording begins in the file behind this one, bytes. Asked for after the last frame.
    pub fn another(&self) -> Option<u64> {
        self.entries.another()
    }
}

impl<Entries: Iterator<Item = Result<RecordingEntry, RecordingError>>> Replay<Entries> {
    /// Begins a replay with entries from another source.
    ///
    /// # Errors
    /// [`SetupError`] if the setup cannot be used.
    pub fn of(entries: Entries, setup: Setup, surroundings: Arc<dyn Surroundings>) -> Result<Self, SetupError> {
        Ok(Self { simulation: Simulation::new(setup, surroundings)?, entries, frames: 0 })
    }

    /// Simulation of the ride so far.
    pub fn simulation(&self) -> &Simulation {
        &self.simulation
    }

    /// Next frame; `None` after the last.
    ///
    /// # Errors
    /// [`ReplayError`] if the recording is damaged here. All frames before may be used.
    pub fn next_frame(&mut self) -> Result<Option<Replayed>, ReplayError> {
        self.next_frame_for(None)
    }

    /// Next frame as by [`Replay::next_frame`], to the bit, and on the way to it those that `taker` wants
    /// ([`Simulation::frame_for`]).
    ///
    /// # Errors
    /// Those of [`Replay::next_frame`].
    pub fn next_frame_for(&mut self, mut taker: Option<&mut dyn FrameTaker>) -> Result<Option<Replayed>, ReplayError> {
        let mut samples: Vec<Sample> = Vec::new();
        let mut controls = None;
        for entry in self.entries.by_ref() {
            match entry {
                Ok(RecordingEntry::Sample(sample)) => samples.push(sample),
                Ok(RecordingEntry::Controls(record)) => controls = Some(record),
                Ok(RecordingEntry::Frame(recorded)) => {
                    let frame = self.simulation.frame_for(recorded.at, &samples, taker.take());
                    let difference = controls
                        .filter(|record| record.frame == recorded.frame)
                        .and_then(|record| controls_difference(&record.controls, &frame.controls))
                        .or_else(|| recorded.first_difference(&frame.record));
                    self.frames += 1;
                    return Ok(Some(Replayed { frame, difference }));
                }
                Err(cause) => return Err(ReplayError::Recording { frames: self.frames, cause: Box::new(cause) }),
            }
        }
        Ok(None)
    }

    /// Simulates all remaining frames. Returns the number of frames, all of them equal to the recorded ones.
    ///
    /// # Errors
    /// [`ReplayError`]: the first difference, or the place where the recording is damaged, with the number of frames
    /// before that are equal.
    pub fn verify(&mut self) -> Result<u64, ReplayError> {
        loop {
            match self.next_frame() {
                Ok(Some(Replayed { difference: None, .. })) => {}
                Ok(Some(Replayed { frame, difference: Some(difference) })) => {
                    return Err(ReplayError::Differs { frame: frame.record.frame, difference });
                }
                Ok(None) => return Ok(self.frames),
                Err(ReplayError::Recording { frames: frames @ 1.., cause }) => {
                    return Err(ReplayError::Partial { frames, cause });
                }
                Err(error) => return Err(error),
            }
        }
    }
}

/// Frame that was simulated again, and its difference from the recorded one.
#[derive(Clone, Debug)]
pub struct Replayed {
    /// Simulated frame.
    pub frame: RideFrame,
    /// First difference from the recorded frame, if any.
    pub difference: Option<FrameDifference>,
}

fn controls_difference(recorded: &Controls, replayed: &Controls) -> Option<FrameDifference> {
    (recorded != replayed).then(|| FrameDifference {
        field: "controls".to_owned(),
        recorded: format!("{recorded:?}"),
        replayed: format!("{replayed:?}"),
    })
}

/// Reason why a replay is not the ride that was recorded.
#[derive(Debug, Error)]
pub enum ReplayError {
    /// A number that differs from the recorded one.
    #[error(
        "the replay differs from the recording in frame {frame}: {} was {}, is {}; was it recorded with this version, and is the scene the same?",
        difference.field, difference.recorded, difference.replayed
    )]
    Differs {
        /// Number of the first frame that differs.
        frame: u64,
        /// First field of the frame that differs.
        difference: FrameDifference,
    },
    /// A recording that cannot be read to its end, and equals the replay so far.
    #[error("all {frames} frames that can be read are identical to the bit, but {cause}")]
    Partial {
        /// Number of frames that are equal.
        frames: u64,
        /// Error of the recording.
        cause: Box<RecordingError>,
    },
    /// A recording that cannot be read further.
    #[error("after {frames} frames: {cause}")]
    Recording {
        /// Number of frames simulated before.
        frames: u64,
        /// Error of the recording.
        cause: Box<RecordingError>,
    },
}
