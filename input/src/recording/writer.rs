//! Writer of a recording's file.
//!
//! The bytes are written by the `mcap` crate's writer, which puts a chunk together in memory, compresses it and writes
//! it whole. Only the end of a chunk is decided here ([`FLUSH_EVERY`]), because it decides how much a crash costs.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::{self, BufWriter};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};

use mcap::records::{MessageHeader, Metadata};
use mcap::write::NoSeek;
use mcap::{Compression, McapError, WriteOptions};
use serde::Serialize;

use super::header::{KEY_CHECKSUM, KEY_HEADER, KEY_VERSION, METADATA, PROFILE, VERSION};
use super::pose::{FrameTransform, POSE_SCHEMA, POSE_TOPIC, PoseInFrame, TRANSFORM_SCHEMA, TRANSFORM_TOPIC};
use super::record::{RecordingEntry, WrittenControls};
use super::sample_message::SampleMessage;
use super::topic::{JSON, JSON_SCHEMA, RecordingTopic};
use crate::clock::{Nanos, SECOND};
use crate::sample::{Sample, Signal};

/// Time after which a chunk is closed and handed to the disk.
const FLUSH_EVERY: Duration = Duration::from_millis(500);
/// Time of the ride after which a chunk is closed, for a ride that is simulated faster than the clock.
const LONGEST_CHUNK: Nanos = SECOND / 2;

/// Most samples in a message, and most bytes in them, unless a single one has more.
const MOST_SAMPLES: usize = 1024;
const MOST_BYTES: usize = 64 << 10;

/// Open file, and the numbers of its channels.
pub(super) struct RecordingWriter {
    mcap: mcap::Writer<NoSeek<BufWriter<File>>>,
    /// Second handle of the file, to hand it to the disk.
    file: File,
    path: PathBuf,
    channels: [u16; RecordingTopic::ALL.len()],
    pose_channel: u16,
    transform_channel: u16,
    /// Beginning of the ride, nanoseconds since 1970, once it is known.
    began: Option<u64>,
    /// Number of messages, and of samples among them.
    messages: u32,
    samples: u64,
    /// Samples that wait for the controls of their frame, and the number of their bytes.
    waiting: Vec<Sample>,
    waiting_bytes: usize,
    flushed: Instant,
    is_flushed: bool,
    /// Time of the ride at which the chunk began.
    chunk: Nanos,
}

impl RecordingWriter {
    /// Writes everything that comes before the first message. Chunks are put together in memory and written whole, so
    /// that the file never holds an incomplete one that looks complete.
    pub(super) fn new(file: File, path: &Path, header: String) -> Result<Self, McapError> {
        let mut mcap = WriteOptions::new()
            .profile(PROFILE)
            .library(format!("{PROFILE} {}", env!("CARGO_PKG_VERSION")))
            .compression(Some(Compression::Zstd))
            .compression_threads(0)
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
            *channel = add_channel(&mut mcap, topic.name(), topic.encoding(), topic.schema())?;
        }
        let pose_channel = add_channel(&mut mcap, POSE_TOPIC, JSON, Some(POSE_SCHEMA))?;
        let transform_channel = add_channel(&mut mcap, TRANSFORM_TOPIC, JSON, Some(TRANSFORM_SCHEMA))?;
        mcap.flush()?;
        Ok(Self {
            mcap,
            file,
            path: path.to_owned(),
            channels,
            pose_channel,
            transform_channel,
            began: None,
            messages: 0,
            samples: 0,
            waiting: Vec::new(),
            waiting_bytes: 0,
            flushed: Instant::now(),
            is_flushed: true,
            chunk: 0,
        })
    }

    /// Sets the beginning of the ride, nanoseconds since 1970.
    pub(super) fn began(&mut self, unix_ns: u64) {
        self.began = Some(unix_ns);
    }

    /// Writes an entry, and hands the chunk to the disk if it is time.
    pub(super) fn write(&mut self, entry: &RecordingEntry) -> Result<(), McapError> {
        match entry {
            RecordingEntry::Sample(sample) => {
                self.waiting_bytes += if let Signal::Bytes(bytes) = &sample.signal { bytes.len() } else { 0 };
                self.waiting.push(sample.clone());
                if self.waiting.len() < MOST_SAMPLES && self.waiting_bytes < MOST_BYTES {
                    Ok(())
                } else {
                    self.put_samples()
                }
            }
            RecordingEntry::Controls(record) => {
                self.put_samples()?;
                if record.at.saturating_sub(self.chunk) >= LONGEST_CHUNK {
                    self.chunk = record.at;
                    self.mcap.flush()?;
                }
                let written = WrittenControls { samples: self.samples, record };
                self.put_json(self.channels[RecordingTopic::Controls as usize], record.at, &written)
            }
            RecordingEntry::Frame(record) => {
                let unix_ns = self.unix_ns(record.at);
                if record.frame == 0 {
                    self.put_json(self.transform_channel, record.at, &FrameTransform::new(unix_ns))?;
                }
                self.put_json(self.channels[RecordingTopic::Frames as usize], record.at, record)?;
                self.put_json(self.pose_channel, record.at, &PoseInFrame::new(unix_ns, record))
            }
        }?;
        self.is_flushed = false;
        if self.flushed.elapsed() < FLUSH_EVERY { Ok(()) } else { self.flush() }
    }

    /// Time until the chunk is to be closed.
    pub(super) fn time_to_flush(&self) -> Duration {
        FLUSH_EVERY.saturating_sub(self.flushed.elapsed())
    }

    /// Closes the chunk, if there is one, and hands it to the disk.
    ///
    /// # Errors
    /// A failed write, or a file that has been removed.
    pub(super) fn flush(&mut self) -> Result<(), McapError> {
        if !std::mem::replace(&mut self.is_flushed, true) {
            self.put_samples()?;
            self.mcap.flush()?;
            self.file.sync_data()?;
            check_place(&self.file, &self.path)?;
        }
        self.flushed = Instant::now();
        Ok(())
    }

    /// Length of the file once everything so far is in it, bytes.
    ///
    /// # Errors
    /// Errors of [`flush`](Self::flush).
    pub(super) fn settled(&mut self) -> Result<u64, McapError> {
        self.flush()?;
        Ok(self.file.metadata()?.len())
    }

    /// Writes the index and the end of the file.
    ///
    /// # Errors
    /// A failed write, or a file that has been removed.
    pub(super) fn finish(&mut self) -> Result<(), McapError> {
        self.put_samples()?;
        self.mcap.finish()?;
        self.file.sync_all()?;
        Ok(check_place(&self.file, &self.path)?)
    }

    /// Moment since 1970 of a time of the ride, nanoseconds.
    fn unix_ns(&mut self, at: Nanos) -> u64 {
        let began = self.began.get_or_insert_with(|| {
            let now = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default();
            u64::try_from(now.as_nanos()).unwrap_or(u64::MAX).saturating_sub(at)
        });
        began.saturating_add(at)
    }

    /// Writes the waiting samples as one message, dated by the last of them.
    fn put_samples(&mut self) -> Result<(), McapError> {
        let samples = std::mem::take(&mut self.waiting);
        self.waiting_bytes = 0;
        let Some(at) = samples.last().map(|sample| sample.at) else { return Ok(()) };
        let message = SampleMessage::to_cbor(self.samples, &samples);
        self.samples += samples.len() as u64;
        self.put(self.channels[RecordingTopic::Samples as usize], at, &message)
    }

    fn put_json(&mut self, channel_id: u16, at: Nanos, message: &impl Serialize) -> Result<(), McapError> {
        let text = serde_json::to_vec(message).map_err(io::Error::other)?;
        self.put(channel_id, at, &text)
    }

    fn put(&mut self, channel_id: u16, at: Nanos, message: &[u8]) -> Result<(), McapError> {
        let log_time = self.unix_ns(at);
        let header = MessageHeader { channel_id, sequence: self.messages, log_time, publish_time: log_time };
        self.mcap.write_to_known_channel(&header, message)?;
        self.messages = self.messages.wrapping_add(1);
        Ok(())
    }
}

/// Checks that an open file still has its name: what is written into a removed file is lost.
///
/// # Errors
/// [`io::ErrorKind::NotFound`] if the name is gone, or is that of another file.
pub(super) fn check_place(file: &File, path: &Path) -> io::Result<()> {
    let named = std::fs::metadata(path)?;
    #[cfg(unix)]
    {
        use std::os::unix::fs::MetadataExt;
        let own = file.metadata()?;
        if (own.dev(), own.ino()) != (named.dev(), named.ino()) {
            return Err(io::ErrorKind::NotFound.into());
        }
    }
    #[cfg(not(unix))]
    let _ = (file, named);
    Ok(())
}

/// Adds a channel with its schema; its number.
fn add_channel(
    mcap: &mut mcap::Writer<NoSeek<BufWriter<File>>>,
    topic: &str,
    encoding: &str,
    schema: Option<(&str, &str)>,
) -> Result<u16, McapError> {
    let schema = match schema {
        Some((name, text)) => mcap.add_schema(name, JSON_SCHEMA, text.as_bytes())?,
        // The number of no schema.
        None => 0,
    };
    mcap.add_channel(schema, topic, encoding, &BTreeMap::new())
}
