//! Recorder of a ride while it goes on.
//!
//! The frame loop only puts entries into a queue; a thread named `recorder` turns them into messages and writes them
//! (`writer.rs`). A full queue means that the disk has stalled for many seconds, or that a device floods the ride. A
//! recording with a gap would not replay, so recording then stops with an error, rather than losing entries or stopping
//! the ride.

use std::fs::{File, OpenOptions};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread::{self, JoinHandle};

use crossbeam_channel::{Receiver, RecvTimeoutError, Sender, TrySendError, bounded};
use mcap::McapError;

use super::error::RecordingError;
use super::header::RideHeader;
use super::record::{ControlsRecord, FrameRecord, RecordingEntry};
use super::writer::RecordingWriter;
use crate::clock::Nanos;
use crate::controls::Controls;
use crate::sample::Sample;

/// Length of the queue, entries: half a minute of a ride with all devices.
const QUEUE: usize = 32_768;
/// Largest memory of the entries in the queue, bytes.
const MOST_QUEUED: usize = 256 << 20;

/// Item of the queue.
enum Queued {
    One(Box<RecordingEntry>),
    Many(Vec<RecordingEntry>),
    /// Beginning of the ride, nanoseconds since 1970.
    Began(u64),
    /// Request for the length of the file once everything before is in it.
    Flush(Sender<u64>),
}

/// Recording that is being made.
///
/// The order of the calls is the order of the replay: samples as they are fed to the desk, then the controls and the
/// observer of the frame.
#[derive(Debug)]
pub struct Recorder {
    path: PathBuf,
    queue: Option<Sender<Queued>>,
    /// Memory of the single entries in the queue, bytes.
    queued: Arc<AtomicUsize>,
    thread: Option<JoinHandle<Result<(), McapError>>>,
}

impl Recorder {
    /// Checks that a recording could be created at this place, and leaves nothing there.
    ///
    /// # Errors
    /// Errors of [`create`](Self::create).
    pub fn check(path: &Path) -> Result<(), RecordingError> {
        drop(new_file(path)?);
        std::fs::remove_file(path).map_err(|cause| RecordingError::io(path, "remove", cause))
    }

    /// Creates the file and writes the header.
    ///
    /// # Errors
    /// A file that exists already, or that the system does not allow to create or write.
    pub fn create(path: &Path, header: &RideHeader) -> Result<Self, RecordingError> {
        let header = text(header).map_err(|error| failure(path, McapError::Io(error.into())))?;
        let file = new_file(path)?;
        let mut writer = RecordingWriter::new(file, path, header).map_err(|error| failure(path, error))?;
        let (queue, messages) = bounded(QUEUE);
        let queued = Arc::new(AtomicUsize::new(0));
        let memory = Arc::clone(&queued);
        let thread = thread::Builder::new()
            .name("recorder".to_owned())
            .spawn(move || write_until_closed(&messages, &memory, &mut writer))
            .map_err(|cause| RecordingError::io(path, "start the thread that writes", cause))?;
        Ok(Self { path: path.to_owned(), queue: Some(queue), queued, thread: Some(thread) })
    }

    /// Sets the moment at which the ride's clock was zero, nanoseconds since 1970; called first. It dates the messages
    /// for other programs, and no replay reads it. Without it, the first entry counts as made when it is written.
    ///
    /// # Errors
    /// Errors of [`sample`](Self::sample).
    pub fn began(&mut self, unix_ns: u64) -> Result<(), RecordingError> {
        self.push(Queued::Began(unix_ns))
    }

    /// Records a sample.
    ///
    /// # Errors
    /// A failed write, or a disk that does not keep up. The recording has then stopped.
    pub fn sample(&mut self, sample: &Sample) -> Result<(), RecordingError> {
        self.entry(RecordingEntry::Sample(sample.clone()))
    }

    /// Records the controls of a frame.
    ///
    /// # Errors
    /// Errors of [`sample`](Self::sample).
    pub fn controls(&mut self, frame: u64, at: Nanos, controls: &Controls) -> Result<(), RecordingError> {
        self.entry(RecordingEntry::Controls(ControlsRecord { frame, at, controls: controls.clone() }))
    }

    /// Records the observer after a frame.
    ///
    /// # Errors
    /// A number that is not finite, and errors of [`sample`](Self::sample).
    pub fn frame(&mut self, record: &FrameRecord) -> Result<(), RecordingError> {
        self.entry(RecordingEntry::Frame(record.clone()))
    }

    /// Records an entry of any kind.
    ///
    /// # Errors
    /// Errors of [`frame`](Self::frame).
    pub fn entry(&mut self, entry: RecordingEntry) -> Result<(), RecordingError> {
        if let RecordingEntry::Frame(record) = &entry {
            check(record)?;
        }
        self.push(Queued::One(Box::new(entry)))
    }

    /// Records all entries from before the file was created, however many; called first.
    ///
    /// # Errors
    /// Errors of [`frame`](Self::frame).
    pub fn past(&mut self, entries: Vec<RecordingEntry>) -> Result<(), RecordingError> {
        for entry in &entries {
            if let RecordingEntry::Frame(record) = entry {
                check(record)?;
            }
        }
        self.push(Queued::Many(entries))
    }

    /// Length of the file, bytes, once everything so far is in it. Waits for the disk.
    ///
    /// # Errors
    /// Errors of [`sample`](Self::sample).
    pub fn flush(&mut self) -> Result<u64, RecordingError> {
        let (told, length) = bounded(1);
        self.push(Queued::Flush(told))?;
        length.recv().or_else(|_| {
            self.close()?;
            Err(RecordingError::Stopped { path: self.path.clone() })
        })
    }

    /// Writes the waiting entries, the index and the end of the file.
    ///
    /// # Errors
    /// A part of the recording that could not be written.
    pub fn finish(mut self) -> Result<(), RecordingError> {
        self.close()
    }

    fn push(&mut self, message: Queued) -> Result<(), RecordingError> {
        let Some(queue) = &self.queue else {
            return Err(RecordingError::Stopped { path: self.path.clone() });
        };
        // Entries of the past are in memory in any case.
        let memory = if let Queued::One(entry) = &message { entry.memory() } else { 0 };
        let sent = if self.queued.fetch_add(memory, Ordering::Relaxed) < MOST_QUEUED {
            queue.try_send(message)
        } else {
            Err(TrySendError::Full(message))
        };
        match sent {
            Ok(()) => Ok(()),
            Err(TrySendError::Full(_)) => {
                // Leave the thread to its disk.
                self.queue = None;
                self.thread = None;
                Err(RecordingError::TooSlow { path: self.path.clone() })
            }
            Err(TrySendError::Disconnected(_)) => {
                self.close()?;
                Err(RecordingError::Stopped { path: self.path.clone() })
            }
        }
    }

    /// Closes the queue and waits until everything is written.
    fn close(&mut self) -> Result<(), RecordingError> {
        self.queue = None;
        let Some(thread) = self.thread.take() else {
            return Ok(());
        };
        match thread.join() {
            Ok(outcome) => outcome.map_err(|error| broken(&self.path, error)),
            Err(_) => Err(broken(&self.path, McapError::Io(io::Error::other("the thread that writes has died")))),
        }
    }
}

impl Drop for Recorder {
    /// Finishes the file. Call [`finish`](Recorder::finish) to learn of errors.
    fn drop(&mut self) {
        let _ = self.close();
    }
}

/// File that was not there before.
pub(super) fn new_file(path: &Path) -> Result<File, RecordingError> {
    OpenOptions::new().write(true).create_new(true).open(path).map_err(|cause| match cause.kind() {
        io::ErrorKind::AlreadyExists if path.is_dir() => RecordingError::Directory { path: path.to_owned() },
        io::ErrorKind::AlreadyExists => RecordingError::Exists { path: path.to_owned() },
        _ => RecordingError::io(path, "create", cause),
    })
}

/// Header as JSON. A number that is not finite is written as null, so the text is read back to check it.
fn text(header: &RideHeader) -> Result<String, serde_json::Error> {
    let text = serde_json::to_string(header)?;
    serde_json::from_str::<RideHeader>(&text)?;
    Ok(text)
}

/// Checks that every number can be read back.
fn check(record: &FrameRecord) -> Result<(), RecordingError> {
    match record.not_finite() {
        Some((field, value)) => Err(RecordingError::NotFinite { frame: record.frame, field, value }),
        None => Ok(()),
    }
}

/// Error of a recording that cannot begin.
fn failure(path: &Path, error: McapError) -> RecordingError {
    RecordingError::io(path, "write", cause(error))
}

/// Error of a recording that cannot go on.
fn broken(path: &Path, error: McapError) -> RecordingError {
    let (path, cause) = (path.to_owned(), cause(error));
    // The file is open, so what is not found is its name.
    if cause.kind() == io::ErrorKind::NotFound {
        RecordingError::Removed { path }
    } else {
        RecordingError::Broken { path, cause }
    }
}

fn cause(error: McapError) -> io::Error {
    match error {
        McapError::Io(cause) => cause,
        other => io::Error::other(other),
    }
}

/// Writes entries until the queue is closed, and flushes at intervals.
fn write_until_closed(
    messages: &Receiver<Queued>,
    queued: &AtomicUsize,
    writer: &mut RecordingWriter,
) -> Result<(), McapError> {
    loop {
        match messages.recv_timeout(writer.time_to_flush()) {
            Ok(Queued::Began(unix_ns)) => writer.began(unix_ns),
            Ok(Queued::One(entry)) => {
                queued.fetch_sub(entry.memory(), Ordering::Relaxed);
                writer.write(&entry)?;
            }
            Ok(Queued::Flush(told)) => {
                // A recorder that no longer waits needs no answer.
                let _ = told.send(writer.settled()?);
            }
            Ok(Queued::Many(entries)) => entries.iter().try_for_each(|entry| writer.write(entry))?,
            Err(RecvTimeoutError::Timeout) => writer.flush()?,
            Err(RecvTimeoutError::Disconnected) => return writer.finish(),
        }
    }
}

#[cfg(test)]
mod tests {
    //! A recorder that cannot write must report it once, with the cause, and must never stop the ride.
    use super::*;
    use crate::sample::SampleSource;

    fn recorder(queue: Sender<Queued>, thread: Option<JoinHandle<Result<(), McapError>>>) -> Recorder {
        Recorder { path: PathBuf::from("ride.mcap"), queue: Some(queue), queued: Arc::default(), thread }
    }

    #[test]
    fn a_stalled_disk_ends_the_recording_not_the_ride() {
        let (queue, _never_read) = bounded(1);
        let mut recorder = recorder(queue, None);
        let sample = Sample::opened(0, SampleSource::Bicycle);
        recorder.sample(&sample).unwrap();
        assert!(matches!(recorder.sample(&sample), Err(RecordingError::TooSlow { .. })));
        assert!(matches!(recorder.sample(&sample), Err(RecordingError::Stopped { .. })));
    }

    /// A device that sends more than the disk takes must not fill the memory.
    #[test]
    fn a_flood_ends_the_recording_before_it_fills_the_memory() {
        let (queue, never_read) = bounded(QUEUE);
        let mut recorder = recorder(queue, None);
        let flood = Sample::bytes(0, SampleSource::Vrpn, vec![0; MOST_QUEUED / 8]);
        let taken = (0..20).take_while(|_| recorder.sample(&flood).is_ok()).count();
        assert!((7..=9).contains(&taken), "{taken}");
        assert!(matches!(recorder.sample(&flood), Err(RecordingError::Stopped { .. })));
        assert!(never_read.len() <= 9);
    }

    #[test]
    fn a_failed_write_is_told_with_its_cause() {
        let (queue, messages) = bounded(1);
        drop(messages);
        let thread = thread::spawn(|| Err(McapError::Io(io::Error::other("no space left"))));
        let mut recorder = recorder(queue, Some(thread));
        let error = recorder.sample(&Sample::opened(0, SampleSource::Bicycle)).unwrap_err();
        assert_eq!(
            error.to_string(),
            "cannot write ride.mcap any further: no space left; what was recorded until then can be replayed"
        );
        assert!(recorder.finish().is_ok());
    }

    #[test]
    fn a_number_that_json_cannot_carry_is_named() {
        let (queue, _messages) = bounded(1);
        let mut record = FrameRecord { frame: 7, ..Default::default() };
        record.celerity[1] = f64::NAN;
        let error = recorder(queue, None).frame(&record).unwrap_err();
        assert_eq!(error.to_string(), "frame 7 cannot be recorded: celerity[1] is NaN");
    }
}
