//! Writer of a recording while the ride goes on.
//!
//! The frame loop only puts entries into a queue; a thread named `recorder` turns them into JSON and writes them.
//! Every half second it closes the chunk and hands it to the disk. A full queue means that the disk has stalled for
//! many seconds. A recording with a gap would not replay, so recording then stops with an error, rather than losing
//! entries or stopping the ride.
//!
//! The bytes are written by the `mcap` crate's writer, which puts a chunk together in memory and writes it whole.
//! Only the end of a chunk is decided here ([`FLUSH_EVERY`]), because it decides how much a crash costs.

use std::collections::BTreeMap;
use std::fs::{File, OpenOptions};
use std::io::{self, BufWriter};
use std::path::{Path, PathBuf};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use crossbeam_channel::{Receiver, RecvTimeoutError, Sender, TrySendError, bounded};
use mcap::records::{MessageHeader, Metadata};
use mcap::write::NoSeek;
use mcap::{McapError, WriteOptions};
use serde::Serialize;

use super::error::RecordingError;
use super::header::{KEY_CHECKSUM, KEY_HEADER, KEY_VERSION, METADATA, PROFILE, RideHeader, VERSION};
use super::record::{ControlsRecord, FrameRecord, RecordingEntry, RecordingTopic, SampleRecord};
use crate::clock::Nanos;
use crate::controls::Controls;
use crate::sample::Sample;

/// Time after which a chunk is closed and handed to the disk.
const FLUSH_EVERY: Duration = Duration::from_millis(500);
/// Length of the queue, entries: half a minute of a ride with all devices.
const QUEUE: usize = 32_768;

/// Item of the queue.
enum Queued {
    One(RecordingEntry),
    Many(Vec<RecordingEntry>),
}

/// Recording that is being made.
///
/// The order of the calls is the order of the replay: samples as they are fed to the desk, then the controls and the
/// observer of the frame.
#[derive(Debug)]
pub struct Recorder {
    path: PathBuf,
    queue: Option<Sender<Queued>>,
    thread: Option<JoinHandle<Result<(), McapError>>>,
}

impl Recorder {
    /// Creates the file and writes the header.
    ///
    /// # Errors
    /// A file that exists already, or that the system does not allow to create or write.
    pub fn create(path: &Path, header: &RideHeader) -> Result<Self, RecordingError> {
        let header = text(header).map_err(|error| failure(path, McapError::Io(error.into())))?;
        let file = OpenOptions::new().write(true).create_new(true).open(path).map_err(|cause| match cause.kind() {
            io::ErrorKind::AlreadyExists if path.is_dir() => RecordingError::Directory { path: path.to_owned() },
            io::ErrorKind::AlreadyExists => RecordingError::Exists { path: path.to_owned() },
            _ => RecordingError::io(path, "create", cause),
        })?;
        let mut writer = RecordingWriter::new(file, header).map_err(|error| failure(path, error))?;
        let (queue, messages) = bounded(QUEUE);
        let thread = thread::Builder::new()
            .name("recorder".to_owned())
            .spawn(move || write_until_closed(&messages, &mut writer))
            .map_err(|cause| RecordingError::io(path, "start the thread that writes", cause))?;
        Ok(Self { path: path.to_owned(), queue: Some(queue), thread: Some(thread) })
    }

    /// Records a sample.
    ///
    /// # Errors
    /// A failed write, or a disk that does not keep up. The recording has then stopped.
    pub fn sample(&mut self, sample: &Sample) -> Result<(), RecordingError> {
        self.push(Queued::One(RecordingEntry::Sample(sample.clone())))
    }

    /// Records the controls of a frame.
    ///
    /// # Errors
    /// Errors of [`sample`](Self::sample).
    pub fn controls(&mut self, frame: u64, at: Nanos, controls: &Controls) -> Result<(), RecordingError> {
        self.push(Queued::One(RecordingEntry::Controls(ControlsRecord { frame, at, controls: controls.clone() })))
    }

    /// Records the observer after a frame.
    ///
    /// # Errors
    /// A number that is not finite, and errors of [`sample`](Self::sample).
    pub fn frame(&mut self, record: &FrameRecord) -> Result<(), RecordingError> {
        check(record)?;
        self.push(Queued::One(RecordingEntry::Frame(record.clone())))
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
        match queue.try_send(message) {
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
            Ok(outcome) => outcome.map_err(|error| failure(&self.path, error)),
            Err(_) => Err(failure(&self.path, McapError::Io(io::Error::other("the thread that writes has died")))),
        }
    }
}

impl Drop for Recorder {
    /// Finishes the file. Call [`finish`](Recorder::finish) to learn of errors.
    fn drop(&mut self) {
        let _ = self.close();
    }
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

fn failure(path: &Path, error: McapError) -> RecordingError {
    let cause = match error {
        McapError::Io(cause) => cause,
        other => io::Error::other(other),
    };
    RecordingError::io(path, "write", cause)
}

/// Writes entries until the queue is closed, and flushes at intervals.
fn write_until_closed(messages: &Receiver<Queued>, writer: &mut RecordingWriter) -> Result<(), McapError> {
    loop {
        match messages.recv_timeout(FLUSH_EVERY.saturating_sub(writer.flushed.elapsed())) {
            Ok(Queued::One(entry)) => writer.write(&entry)?,
            Ok(Queued::Many(entries)) => entries.iter().try_for_each(|entry| writer.write(entry))?,
            Err(RecvTimeoutError::Timeout) => writer.flush()?,
            Err(RecvTimeoutError::Disconnected) => return writer.finish(),
        }
    }
}

/// Open file, and the numbers of its channels.
struct RecordingWriter {
    mcap: mcap::Writer<NoSeek<BufWriter<File>>>,
    /// Second handle of the file, to hand it to the disk.
    file: File,
    channels: [u16; RecordingTopic::ALL.len()],
    sequence: u32,
    flushed: Instant,
    is_flushed: bool,
}

impl RecordingWriter {
    /// Writes everything that comes before the first message. Chunks are put together in memory and written whole, so
    /// that the file never holds an incomplete one that looks complete.
    fn new(file: File, header: String) -> Result<Self, McapError> {
        let mut mcap = WriteOptions::new()
            .profile(PROFILE)
            .library(format!("{PROFILE} {}", env!("CARGO_PKG_VERSION")))
            .compression(None)
            .disable_seeking(true)
            .create(NoSeek::new(BufWriter::new(file.try_clone()?)))?;

        let metadata = BTreeMap::from([
            (KEY_VERSION.to_owned(), VERSION.to_owned()),
            (KEY_CHECKSUM.to_owned(), format!("{:08x}", crc32fast::hash(header.as_bytes()))),
            (KEY_HEADER.to_owned(), header),
        ]);
        mcap.write_metadata(&Metadata { name: METADATA.to_owned(), metadata })?;

        let mut channels = [0; RecordingTopic::ALL.len()];
        for (channel, topic) in channels.iter_mut().zip(RecordingTopic::ALL) {
            let (name, schema) = topic.schema();
            let schema = mcap.add_schema(name, "jsonschema", schema.as_bytes())?;
            *channel = mcap.add_channel(schema, topic.name(), "json", &BTreeMap::new())?;
        }
        mcap.flush()?;
        Ok(Self { mcap, file, channels, sequence: 0, flushed: Instant::now(), is_flushed: true })
    }

    /// Writes an entry, and hands the chunk to the disk if it is time.
    fn write(&mut self, entry: &RecordingEntry) -> Result<(), McapError> {
        match entry {
            RecordingEntry::Sample(sample) => self.put(RecordingTopic::Samples, sample.at, &SampleRecord::from(sample)),
            RecordingEntry::Controls(record) => self.put(RecordingTopic::Controls, record.at, record),
            RecordingEntry::Frame(record) => self.put(RecordingTopic::Frames, record.at, record),
        }?;
        self.is_flushed = false;
        if self.flushed.elapsed() < FLUSH_EVERY { Ok(()) } else { self.flush() }
    }

    /// Closes the chunk, if there is one, and hands it to the disk.
    fn flush(&mut self) -> Result<(), McapError> {
        if !std::mem::replace(&mut self.is_flushed, true) {
            self.mcap.flush()?;
            self.file.sync_data()?;
        }
        self.flushed = Instant::now();
        Ok(())
    }

    /// Writes the index and the end of the file.
    fn finish(&mut self) -> Result<(), McapError> {
        self.mcap.finish()?;
        self.file.sync_all()?;
        Ok(())
    }

    fn put(&mut self, topic: RecordingTopic, at: Nanos, record: &impl Serialize) -> Result<(), McapError> {
        let text = serde_json::to_vec(record).map_err(io::Error::other)?;
        let channel_id = self.channels[topic as usize];
        let header = MessageHeader { channel_id, sequence: self.sequence, log_time: at, publish_time: at };
        self.mcap.write_to_known_channel(&header, &text)?;
        self.sequence = self.sequence.wrapping_add(1);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    //! A recorder that cannot write must report it once, with the cause, and must never stop the ride.
    use super::*;
    use crate::sample::SampleSource;

    fn recorder(queue: Sender<Queued>, thread: Option<JoinHandle<Result<(), McapError>>>) -> Recorder {
        Recorder { path: PathBuf::from("ride.mcap"), queue: Some(queue), thread }
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

    #[test]
    fn a_failed_write_is_told_with_its_cause() {
        let (queue, messages) = bounded(1);
        drop(messages);
        let thread = thread::spawn(|| Err(McapError::Io(io::Error::other("no space left"))));
        let mut recorder = recorder(queue, Some(thread));
        let error = recorder.sample(&Sample::opened(0, SampleSource::Bicycle)).unwrap_err();
        assert_eq!(error.to_string(), "cannot write ride.mcap: no space left");
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
