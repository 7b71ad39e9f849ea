//! Errors of making and reading a recording.

use std::io;
use std::path::{Path, PathBuf};

use thiserror::Error;

use super::header::{PROFILE, VERSION};

/// Reason why a recording could not be made or read.
#[derive(Debug, Error)]
pub enum RecordingError {
    /// An error of the system.
    #[error("cannot {action} {}: {cause}", path.display())]
    Io {
        /// Path of the file.
        path: PathBuf,
        /// Attempted operation, a verb.
        action: &'static str,
        /// Error of the system.
        cause: io::Error,
    },
    /// A file that exists already; a recording is never written over.
    #[error("{} exists already: give the recording another name, or remove it", path.display())]
    Exists {
        /// Path of the file.
        path: PathBuf,
    },
    /// A directory instead of a file.
    #[error("{} is a directory: give the name of a recording, a file that ends in .mcap", path.display())]
    Directory {
        /// Path of the directory.
        path: PathBuf,
    },
    /// An empty file.
    #[error("{} is empty: the ride ended before anything was recorded", path.display())]
    Empty {
        /// Path of the file.
        path: PathBuf,
    },
    /// A file that is not MCAP.
    #[error("{} is not a recording: it does not begin as an MCAP file does", path.display())]
    NotMcap {
        /// Path of the file.
        path: PathBuf,
    },
    /// An MCAP file of another program.
    #[error("{} is an MCAP file of another program (profile {profile:?}, not \"{PROFILE}\")", path.display())]
    Foreign {
        /// Path of the file.
        path: PathBuf,
        /// Profile in the file.
        profile: String,
    },
    /// A recording in another version of the format.
    #[error("{} has format {found:?}, this program reads up to \"{VERSION}\": replay it with the program that recorded it", path.display())]
    Version {
        /// Path of the file.
        path: PathBuf,
        /// Version in the file.
        found: String,
    },
    /// A damaged file; the entries before the damage may be used.
    #[error("{} is damaged at byte {offset}: {what}; what comes before can be used", path.display())]
    Damaged {
        /// Path of the file.
        path: PathBuf,
        /// Place where the damaged record begins, bytes.
        offset: u64,
        /// Description of the damage.
        what: String,
    },
    /// A file that stops before its end; the entries before may be used.
    #[error("{} ends too early, at byte {offset}: the recording was cut off; what comes before can be used", path.display())]
    CutOff {
        /// Path of the file.
        path: PathBuf,
        /// Place where the missing or incomplete record begins, bytes.
        offset: u64,
    },
    /// A file with a second recording behind the first, or among it.
    #[error("{} holds another recording from byte {offset} on, which is not read; keep every ride in a file of its own", path.display())]
    Another {
        /// Path of the file.
        path: PathBuf,
        /// Place where the other recording begins, bytes.
        offset: u64,
    },
    /// A recording that could not be continued.
    #[error("cannot write {} any further: {cause}; what was recorded until then can be replayed", path.display())]
    Broken {
        /// Path of the file.
        path: PathBuf,
        /// Error of the system.
        cause: io::Error,
    },
    /// A recording whose file lost its name.
    #[error("{} was removed or replaced while the ride was recorded, so the recording is lost; record into another file", path.display())]
    Removed {
        /// Path that the file had.
        path: PathBuf,
    },
    /// A number that no replay could read back.
    #[error("frame {frame} cannot be recorded: {field} is {value}")]
    NotFinite {
        /// Number of the frame.
        frame: u64,
        /// Name of the field.
        field: String,
        /// Value of the field.
        value: f64,
    },
    /// A recorder that has failed before.
    #[error("{}: recording has stopped", path.display())]
    Stopped {
        /// Path of the file.
        path: PathBuf,
    },
    /// A disk that did not keep up with the ride.
    #[error("{}: the disk does not keep up; what was written until now can be used", path.display())]
    TooSlow {
        /// Path of the file.
        path: PathBuf,
    },
}

impl RecordingError {
    pub(super) fn io(path: &Path, action: &'static str, cause: io::Error) -> Self {
        Self::Io { path: path.to_owned(), action, cause }
    }
}
