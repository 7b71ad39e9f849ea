//! Writing a recording while the ride goes on.
//!
//! Whoever records only puts things into a queue; a thread named `recorder` turns them into JSON and writes. Every half
//! second it closes the chunk and hands it to the disk. A queue that is full means that the disk has stalled for many seconds:
//! since a recording with a gap would not replay, recording then stops with an error instead of losing something or of
//! stopping the ride.

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

use super::record::{ControlsRecord, FrameRecord, SampleRecord, Topic};
use super::{
    Header, KEY_CHECKSUM, KEY_HEADER, KEY_VERSION, METADATA, PROFILE, RecordingError, VERSION,
};
use crate::controls::Controls;
use crate::sample::{Nanos, Sample};

/// How often a chunk is closed and handed to the disk.
const FLUSH_EVERY: Duration = Duration::from_millis(500);
/// Things that wait for the disk: half a minute of a ride with all devices.
const QUEUE: usize = 32_768;

/// What is put into the queue.
enum Message {
    Sample(Sample),
    Controls(ControlsRecord),
    Frame(FrameRecord),
}

/// A recording that is being made.
///
/// The order of the calls is the order of the replay: samples as they are fed to the desk, then the controls and the
/// observer of the frame.
#[derive(Debug)]
pub struct Recorder {
    path: PathBuf,
    queue: Option<Sender<Message>>,
    thread: Option<JoinHandle<Result<(), McapError>>>,
}

impl Recorder {
    /// Creates the file and writes what the ride depends on.
    ///
    /// # Errors
    /// If the file exists already, or the system does not let us create or write it.
    pub fn create(path: &Path, header: &Header) -> Result<Self, RecordingError> {
        let file = OpenOptions::new()
            .write(true)
            .create_new(true)
            .open(path)
            .map_err(|cause| match cause.kind() {
                io::ErrorKind::AlreadyExists if path.is_dir() => RecordingError::Directory {
                    path: path.to_owned(),
                },
                io::ErrorKind::AlreadyExists => RecordingError::Exists {
                    path: path.to_owned(),
                },
                _ => RecordingError::io(path, "create", cause),
            })?;
        let failed = |error| failure(path, error);
        let file_to_sync = file
            .try_clone()
            .map_err(|cause| failed(McapError::Io(cause)))?;
        let mut writer = Writer::new(file, header).map_err(failed)?;
        let (queue, messages) = bounded(QUEUE);
        let thread = thread::Builder::new()
            .name("recorder".to_owned())
            .spawn(move || {
                write_until_closed(&messages, &mut writer, &file_to_sync)?;
                writer.mcap.finish()?;
                file_to_sync.sync_all()?;
                Ok(())
            })
            .map_err(|cause| RecordingError::io(path, "start the thread that writes", cause))?;
        Ok(Self {
            path: path.to_owned(),
            queue: Some(queue),
            thread: Some(thread),
        })
    }

    /// Records a sample.
    ///
    /// # Errors
    /// If writing has failed, or does not keep up. The recording has then stopped.
    pub fn sample(&mut self, sample: &Sample) -> Result<(), RecordingError> {
        self.push(Message::Sample(sample.clone()))
    }

    /// Records what the desk said for a frame.
    ///
    /// # Errors
    /// As for [`sample`](Self::sample).
    pub fn controls(
        &mut self,
        frame: u64,
        at: Nanos,
        controls: &Controls,
    ) -> Result<(), RecordingError> {
        self.push(Message::Controls(ControlsRecord {
            frame,
            at,
            controls: controls.clone(),
        }))
    }

    /// Records the observer after a frame.
    ///
    /// # Errors
    /// If a number is not finite; else as for [`sample`](Self::sample).
    pub fn frame(&mut self, record: &FrameRecord) -> Result<(), RecordingError> {
        if let Some((field, value)) = record.not_finite() {
            return Err(RecordingError::NotFinite {
                frame: record.frame,
                field,
                value,
            });
        }
        self.push(Message::Frame(record.clone()))
    }

    /// Writes what still waits, the index and the end of the file.
    ///
    /// # Errors
    /// If any of the recording could not be written.
    pub fn finish(mut self) -> Result<(), RecordingError> {
        self.close()
    }

    fn push(&mut self, message: Message) -> Result<(), RecordingError> {
        let Some(queue) = &self.queue else {
            return Err(RecordingError::Stopped {
                path: self.path.clone(),
            });
        };
        match queue.try_send(message) {
            Ok(()) => Ok(()),
            Err(TrySendError::Full(_)) => {
                // Leave the thread to its disk.
                self.queue = None;
                self.thread = None;
                Err(RecordingError::TooSlow {
                    path: self.path.clone(),
                })
            }
            Err(TrySendError::Disconnected(_)) => {
                self.close()?;
                Err(RecordingError::Stopped {
                    path: self.path.clone(),
                })
            }
        }
    }

    /// Closes the queue and waits until all is written.
    fn close(&mut self) -> Result<(), RecordingError> {
        self.queue = None;
        let Some(thread) = self.thread.take() else {
            return Ok(());
        };
        match thread.join() {
            Ok(outcome) => outcome.map_err(|error| failure(&self.path, error)),
            Err(_) => Err(failure(
                &self.path,
                McapError::Io(io::Error::other("the thread that writes has died")),
            )),
        }
    }
}

impl Drop for Recorder {
    /// Finishes the file; who wants to know whether that went well calls [`finish`](Recorder::finish).
    fn drop(&mut self) {
        let _ = self.close();
    }
}

fn failure(path: &Path, error: McapError) -> RecordingError {
    let cause = match error {
        McapError::Io(cause) => cause,
        other => io::Error::other(other),
    };
    RecordingError::io(path, "write", cause)
}

/// Writes the messages until the queue is closed, and flushes now and then.
fn write_until_closed(
    messages: &Receiver<Message>,
    writer: &mut Writer,
    file: &File,
) -> Result<(), McapError> {
    let mut flushed = Instant::now();
    let mut waiting = false;
    loop {
        match messages.recv_timeout(FLUSH_EVERY.saturating_sub(flushed.elapsed())) {
            Ok(message) => {
                writer.write(&message)?;
                waiting = true;
            }
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => return Ok(()),
        }
        if flushed.elapsed() >= FLUSH_EVERY {
            if std::mem::take(&mut waiting) {
                writer.mcap.flush()?;
                file.sync_data()?;
            }
            flushed = Instant::now();
        }
    }
}

/// The file, and the numbers of its channels.
struct Writer {
    mcap: mcap::Writer<NoSeek<BufWriter<File>>>,
    channels: [u16; Topic::ALL.len()],
    sequence: u32,
}

impl Writer {
    /// Writes everything that comes before the first message. Chunks are put together in memory and written whole, so
    /// that the file never holds half of one that looks complete.
    fn new(file: File, header: &Header) -> Result<Self, McapError> {
        let mut mcap = WriteOptions::new()
            .profile(PROFILE)
            .library(format!("{PROFILE} {}", env!("CARGO_PKG_VERSION")))
            .compression(None)
            .disable_seeking(true)
            .create(NoSeek::new(BufWriter::new(file)))?;

        let header = serde_json::to_string(header).map_err(io::Error::other)?;
        let metadata = BTreeMap::from([
            (KEY_VERSION.to_owned(), VERSION.to_owned()),
            (
                KEY_CHECKSUM.to_owned(),
                format!("{:08x}", crc32fast::hash(header.as_bytes())),
            ),
            (KEY_HEADER.to_owned(), header),
        ]);
        mcap.write_metadata(&Metadata {
            name: METADATA.to_owned(),
            metadata,
        })?;

        let mut channels = [0; Topic::ALL.len()];
        for (channel, topic) in channels.iter_mut().zip(Topic::ALL) {
            let (name, schema) = topic.schema();
            let schema = mcap.add_schema(name, "jsonschema", schema.as_bytes())?;
            *channel = mcap.add_channel(schema, topic.name(), "json", &BTreeMap::new())?;
        }
        mcap.flush()?;
        Ok(Self {
            mcap,
            channels,
            sequence: 0,
        })
    }

    fn write(&mut self, message: &Message) -> Result<(), McapError> {
        match message {
            Message::Sample(sample) => {
                self.put(Topic::Samples, sample.at, &SampleRecord::from(sample))
            }
            Message::Controls(record) => self.put(Topic::Controls, record.at, record),
            Message::Frame(record) => self.put(Topic::Frames, record.at, record),
        }
    }

    fn put(&mut self, topic: Topic, at: Nanos, record: &impl Serialize) -> Result<(), McapError> {
        let text = serde_json::to_vec(record).map_err(io::Error::other)?;
        let channel_id = self.channels[topic as usize];
        let header = MessageHeader {
            channel_id,
            sequence: self.sequence,
            log_time: at,
            publish_time: at,
        };
        self.mcap.write_to_known_channel(&header, &text)?;
        self.sequence = self.sequence.wrapping_add(1);
        Ok(())
    }
}
