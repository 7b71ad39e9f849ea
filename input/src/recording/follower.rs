//! Copy of a recording that is still being written.
//!
//! A ride may be recorded long after its beginning. What lies before is then in a file already: its bytes are copied,
//! and those that are added to it follow until the copy is ended. Chunks are copied as they are, so hours cost no more
//! than the disk takes. The copy has no index of its chunks; programs that want one read it from front to back.

use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::thread::{self, JoinHandle};
use std::time::Duration;

use crossbeam_channel::{Receiver, RecvTimeoutError, Sender, bounded};
use mcap::records::op;

use super::error::RecordingError;
use super::recorder::new_file;
use super::writer::check_place;

/// Time between two looks at the file that grows.
const LOOK_EVERY: Duration = Duration::from_millis(250);
/// Bytes that end the file: the end of the data without a checksum, a footer without a summary, and MCAP's magic.
fn end() -> Vec<u8> {
    let record = |opcode: u8, length: u64| {
        let content = vec![0; length as usize];
        [&[opcode][..], &length.to_le_bytes(), &content].concat()
    };
    [record(op::DATA_END, 4), record(op::FOOTER, 20), mcap::MAGIC.to_vec()].concat()
}

/// Copy of a recording that is still being written, and the thread that keeps it up to date.
#[derive(Debug)]
pub struct RecordingFollower {
    path: PathBuf,
    /// Channel for the length at which the copy ends.
    end: Sender<u64>,
    thread: Option<JoinHandle<io::Result<()>>>,
}

impl RecordingFollower {
    /// Begins to copy `source` into a new file.
    ///
    /// # Errors
    /// A file that exists already, or that the system does not allow to create or read.
    pub fn begin(source: &Path, path: &Path) -> Result<Self, RecordingError> {
        let from = File::open(source).map_err(|cause| RecordingError::io(source, "read", cause))?;
        let to = new_file(path)?;
        let (end, ended) = bounded(1);
        let place = path.to_owned();
        let thread = thread::Builder::new()
            .name("recording copy".to_owned())
            .spawn(move || follow(from, to, &place, &ended))
            .map_err(|cause| RecordingError::io(path, "start the thread that writes", cause))?;
        Ok(Self { path: path.to_owned(), end, thread: Some(thread) })
    }

    /// Checks that the copy goes on.
    ///
    /// # Errors
    /// A part that could not be written, or a file that was removed.
    pub fn check(&mut self) -> Result<(), RecordingError> {
        if self.is_ended() { self.join() } else { Ok(()) }
    }

    /// Has the copy end where the source had `length` bytes, which must be the end of a chunk. This waits for nothing:
    /// [`is_ended`](Self::is_ended) tells when it is done, and [`finish`](Self::finish) waits.
    pub fn end_at(&self, length: u64) {
        // A thread that has failed takes no more.
        let _ = self.end.send(length);
    }

    /// True once the copy goes on no more.
    pub fn is_ended(&self) -> bool {
        self.thread.as_ref().is_none_or(JoinHandle::is_finished)
    }

    /// Waits until the copy has ended.
    ///
    /// # Errors
    /// A part that could not be written, or a file that was removed.
    pub fn finish(mut self) -> Result<(), RecordingError> {
        self.join()
    }

    /// Leaves the copy to its disk, which may have stalled, and waits for nothing.
    pub fn abandon(mut self) {
        self.thread = None;
    }

    fn join(&mut self) -> Result<(), RecordingError> {
        let Some(thread) = self.thread.take() else { return Ok(()) };
        let outcome = thread.join().unwrap_or_else(|_| Err(io::Error::other("the thread that copies has died")));
        let path = self.path.clone();
        outcome.map_err(|cause| match cause.kind() {
            io::ErrorKind::NotFound => RecordingError::Removed { path },
            _ => RecordingError::Broken { path, cause },
        })
    }
}

impl Drop for RecordingFollower {
    /// Leaves the copy as it is; what is in it can be replayed.
    fn drop(&mut self) {
        let (nobody, _) = bounded(0);
        drop(std::mem::replace(&mut self.end, nobody));
        let _ = self.join();
    }
}

/// Copies what is added to `from` until the length is told at which to end.
fn follow(mut from: File, mut to: File, place: &Path, ended: &Receiver<u64>) -> io::Result<()> {
    let mut copied = 0;
    loop {
        copied += io::copy(&mut from, &mut to)?;
        to.sync_data()?;
        check_place(&to, place)?;
        match ended.recv_timeout(LOOK_EVERY) {
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => {
                // Nobody says where the last whole chunk ends: what is there can be replayed.
                io::copy(&mut from, &mut to)?;
                return to.sync_all();
            }
            Ok(length) => {
                // More may have been copied than the end of the last whole chunk.
                if copied > length {
                    to.set_len(length)?;
                    to.seek(SeekFrom::Start(length))?;
                } else if io::copy(&mut from.take(length - copied), &mut to)? < length - copied {
                    return Err(io::Error::new(io::ErrorKind::UnexpectedEof, "the ride's past was cut off"));
                }
                to.write_all(&end())?;
                to.sync_all()?;
                return check_place(&to, place);
            }
        }
    }
}
