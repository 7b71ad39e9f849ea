//! Log of a ride, so that it can be recorded at any moment from its beginning.
//!
//! A recording that starts in the middle could not be replayed, because later states depend on earlier input. Every
//! entry is therefore kept until a file is wanted, and is written to the file as well from then on. A short past is in
//! memory, a long one in a temporary recording on the disk (`past`), so that memory stays flat and hours can still be
//! recorded.
//!
//! A file is not created before there is a frame to be written: windows take their time to open, and a program that
//! is ended meanwhile would leave a recording of nothing.

use crate::frame::RideFrame;
use crate::past::Past;
use input::recording::{ControlsRecord, Recorder, RecordingEntry, RecordingError, RecordingFollower, RideHeader};
use input::{Nanos, Sample};
use std::path::{Path, PathBuf};
use std::time::{SystemTime, UNIX_EPOCH};
use thiserror::Error;

/// Reason why a ride is not recorded.
#[derive(Debug, Error)]
pub enum LogError {
    /// A file that cannot be written.
    #[error(transparent)]
    Recording(#[from] RecordingError),
    /// A ride whose past is not known.
    #[error(
        "the ride so far is no longer remembered ({why}), so it cannot be recorded; start the program with --record FILE"
    )]
    NotRemembered {
        /// Reason why it is not.
        why: String,
    },
    /// A recording that has failed during the ride.
    #[error("{}: the ride was not recorded to its end", path.display())]
    Incomplete {
        /// Path of the recording.
        path: PathBuf,
    },
}

/// File into which the ride is recorded.
enum WrittenFile {
    /// Recording that gets every entry.
    Entries(Recorder),
    /// Copy of the temporary recording, which follows it.
    Copy(RecordingFollower),
}

/// Log of the ride so far, and of its file if one is wanted.
pub struct RideLog {
    header: RideHeader,
    past: Past,
    /// Folder of the temporary recording of a long past.
    folder: PathBuf,
    /// Beginning of the ride, nanoseconds since 1970, once it has begun.
    began: Option<u64>,
    file: Option<(PathBuf, WrittenFile)>,
    /// Path of a recording that is created with the ride's first frame.
    awaited: Option<PathBuf>,
    /// Copies that are being completed beside the ride.
    ending: Vec<(PathBuf, RecordingFollower)>,
    /// First recording that has failed.
    failed: Option<PathBuf>,
}

impl RideLog {
    /// Creates the log at the beginning of the ride. A long past is kept in the system's folder for temporary files.
    pub fn new(header: RideHeader) -> Self {
        Self {
            header,
            past: Past::new(),
            folder: std::env::temp_dir(),
            began: None,
            file: None,
            awaited: None,
            ending: Vec::new(),
            failed: None,
        }
    }

    /// The same log with a long past in this folder, which is made when it is needed.
    pub fn keep_past_in(mut self, folder: PathBuf) -> Self {
        self.folder = folder;
        self
    }

    /// True if the ride is being recorded, from its first frame on.
    pub fn is_recording(&self) -> bool {
        self.file.is_some() || self.awaited.is_some()
    }

    /// Path of a recording that is created with the ride's first frame; there is no file yet.
    pub fn awaited(&self) -> Option<&Path> {
        self.awaited.as_deref()
    }

    /// Keeps nothing of the past from now on, for rides that nobody records from their beginning later.
    pub fn forget(&mut self) {
        self.past = Past::Gone("it is not kept in a kiosk".to_owned());
    }

    /// Adds the samples of one frame and the frame's result.
    ///
    /// # Errors
    /// [`LogError`] if the file cannot be written any further. Recording has stopped then, and the part already written
    /// is kept.
    pub fn frame(&mut self, samples: &[Sample], frame: &RideFrame) -> Result<(), LogError> {
        let at = frame.record.at;
        let begun = if self.began.is_none() { self.begin(at) } else { Ok(()) };
        let entries = entries(samples, frame);
        let written = begun.and_then(|()| self.write(|file| file.add(&entries)));
        self.past.add(entries, &self.header, self.began, &self.folder);
        written.and_then(|()| self.follows())
    }

    /// Gives up a copy whose past is lost, and takes note of those that are complete.
    fn follows(&mut self) -> Result<(), LogError> {
        let ended = self.ending.iter().position(|(_, copy)| copy.is_ended());
        if let Some((path, copy)) = ended.map(|index| self.ending.swap_remove(index)) {
            copy.finish().map_err(|error| self.fails(path, error))?;
        }
        if let (Past::Gone(why), Some((_, WrittenFile::Copy(_)))) = (&self.past, &self.file) {
            let why = why.clone();
            if let Some((path, WrittenFile::Copy(copy))) = self.file.take() {
                copy.abandon();
                self.failed.get_or_insert(path);
            }
            return Err(LogError::NotRemembered { why });
        }
        Ok(())
    }

    /// Notes a recording that has failed.
    fn fails(&mut self, path: PathBuf, error: RecordingError) -> LogError {
        self.failed.get_or_insert(path);
        error.into()
    }

    /// True while a recording that was ended is still being completed on the disk.
    pub fn is_completing(&self) -> bool {
        !self.ending.is_empty()
    }

    /// Begins the ride, whose clock shows `at`, and the recording that waits for it.
    fn begin(&mut self, at: Nanos) -> Result<(), LogError> {
        let began = unix_now().saturating_sub(at);
        self.began = Some(began);
        if let Some(path) = self.awaited.take() {
            match Recorder::create(&path, &self.header) {
                Ok(recorder) => self.file = Some((path, WrittenFile::Entries(recorder))),
                Err(error) => {
                    self.failed.get_or_insert(path);
                    return Err(error.into());
                }
            }
        }
        self.write(|file| file.begin(began))
    }

    /// Writes into the file, if there is one. The file is given up at the first error.
    fn write(&mut self, write: impl FnOnce(&mut WrittenFile) -> Result<(), RecordingError>) -> Result<(), LogError> {
        let Some((path, mut file)) = self.file.take() else { return Ok(()) };
        match write(&mut file) {
            Ok(()) => {
                self.file = Some((path, file));
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
    /// [`LogError`] if the file cannot be written, or the past of the ride is not known.
    pub fn record(&mut self, path: &Path) -> Result<(), LogError> {
        if self.is_recording() {
            return Ok(());
        }
        let Some(began) = self.began else {
            Recorder::check(path)?;
            self.awaited = Some(path.to_owned());
            return Ok(());
        };
        let file = match &self.past {
            Past::Memory { entries, .. } => {
                let mut recorder = Recorder::create(path, &self.header)?;
                recorder.began(began)?;
                recorder.past(entries.clone())?;
                WrittenFile::Entries(recorder)
            }
            Past::Disk(disk) => WrittenFile::Copy(RecordingFollower::begin(&disk.path, path)?),
            Past::Gone(why) => return Err(LogError::NotRemembered { why: why.clone() }),
        };
        self.file = Some((path.to_owned(), file));
        Ok(())
    }

    /// Completes the file, if one is being written; the ride goes on, and a long file is completed beside it. No file
    /// is left of a ride without a frame.
    ///
    /// # Errors
    /// [`LogError`] if the rest cannot be written.
    pub fn stop(&mut self) -> Result<(), LogError> {
        self.awaited = None;
        let Some((path, file)) = self.file.take() else { return Ok(()) };
        match (file, &mut self.past) {
            (WrittenFile::Entries(recorder), _) => recorder.finish().map_err(|error| self.fails(path, error)),
            (WrittenFile::Copy(copy), Past::Disk(disk)) => {
                match disk.recorder.flush() {
                    Ok(length) => copy.end_at(length),
                    Err(error) => {
                        copy.abandon();
                        return Err(self.fails(path, error));
                    }
                }
                // Gigabytes may be left to copy, while the ride goes on.
                self.ending.push((path, copy));
                Ok(())
            }
            // What was copied until the past was lost can be replayed.
            (WrittenFile::Copy(copy), _) => {
                copy.abandon();
                Err(self.fails(path.clone(), RecordingError::Stopped { path }))
            }
        }
    }

    /// Completes the file at the end of the ride.
    ///
    /// # Errors
    /// [`LogError`] if the rest cannot be written, or if a recording has failed during the ride.
    pub fn finish(&mut self) -> Result<(), LogError> {
        let stopped = self.stop();
        let ending: Vec<_> = self.ending.drain(..).collect();
        let ended = ending.into_iter().try_for_each(|(path, copy)| {
            copy.finish().map_err(|error| {
                self.failed.get_or_insert(path);
                LogError::from(error)
            })
        });
        stopped.and(ended)?;
        self.failed.take().map_or(Ok(()), |path| Err(LogError::Incomplete { path }))
    }
}

impl WrittenFile {
    /// Dates the ride, before its first entry.
    fn begin(&mut self, began: u64) -> Result<(), RecordingError> {
        match self {
            Self::Entries(recorder) => recorder.began(began),
            Self::Copy(_) => Ok(()),
        }
    }

    /// Adds the entries of a frame. A copy follows by itself.
    fn add(&mut self, entries: &[RecordingEntry]) -> Result<(), RecordingError> {
        match self {
            Self::Entries(recorder) => entries.iter().try_for_each(|entry| recorder.entry(entry.clone())),
            Self::Copy(copy) => copy.check(),
        }
    }
}

/// Entries of a frame, in the order of the replay.
fn entries(samples: &[Sample], frame: &RideFrame) -> Vec<RecordingEntry> {
    let (number, at) = (frame.record.frame, frame.record.at);
    let controls = ControlsRecord { frame: number, at, controls: frame.controls.clone() };
    let samples = samples.iter().cloned().map(RecordingEntry::Sample);
    samples.chain([RecordingEntry::Controls(controls), RecordingEntry::Frame(frame.record.clone())]).collect()
}

/// Present moment, nanoseconds since 1970.
fn unix_now() -> u64 {
    let now = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default();
    u64::try_from(now.as_nanos()).unwrap_or(u64::MAX)
}
