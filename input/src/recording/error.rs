//! Why a recording cannot be made or read.

use std::io;
use std::path::{Path, PathBuf};

use thiserror::Error;

use super::header::{PROFILE, VERSION};

/// Why a recording could not be made or read.
#[derive(Debug, Error)]
pub enum RecordingError {
    /// The system refused.
    #[error("cannot {action} {}: {cause}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// What was tried.
        action: &'static str,
        /// Why it failed.
        cause: io::Error,
    },
    /// A recording is never written over.
    #[error("{} exists already: give the recording another name, or remove it", path.display())]
    Exists {
        /// The file.
        path: PathBuf,
    },
    /// A directory instead of a file.
    #[error("{} is a directory: give the name of a recording, a file that ends in .mcap", path.display())]
    Directory {
        /// The directory.
        path: PathBuf,
    },
    /// Nothing in it.
    #[error("{} is empty: the ride ended before anything was recorded", path.display())]
    Empty {
        /// The file.
        path: PathBuf,
    },
    /// Not MCAP at all.
    #[error("{} is not a recording: it does not begin as an MCAP file does", path.display())]
    NotMcap {
        /// The file.
        path: PathBuf,
    },
    /// MCAP, but not ours.
    #[error("{} is an MCAP file of another program (profile {profile:?}, not \"{PROFILE}\")", path.display())]
    Foreign {
        /// The file.
        path: PathBuf,
        /// What it calls itself.
        profile: String,
    },
    /// From another version of the program.
    #[error("{} has format {found:?}, this program reads \"{VERSION}\": replay it with the program that recorded it", path.display())]
    Version {
        /// The file.
        path: PathBuf,
        /// The format it claims.
        found: String,
    },
    /// The file is damaged; everything before may be used.
    #[error("{} is damaged at byte {offset}: {what}; what comes before can be used", path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// Where the damaged record begins.
        offset: u64,
        /// What is wrong.
        what: String,
    },
    /// The file stops before its end; everything before may be used.
    #[error("{} ends too early, at byte {offset}: the recording was cut off; what comes before can be used", path.display())]
    CutOff {
        /// The file.
        path: PathBuf,
        /// Where the record that is missing or incomplete begins.
        offset: u64,
    },
    /// A number that no replay could read back.
    #[error("frame {frame} cannot be recorded: {field} is {value}")]
    NotFinite {
        /// The frame.
        frame: u64,
        /// Which number.
        field: String,
        /// What it is.
        value: f64,
    },
    /// The recorder has failed before.
    #[error("{}: recording has stopped", path.display())]
    Stopped {
        /// The file.
        path: PathBuf,
    },
    /// The disk did not keep up with the ride.
    #[error("{}: the disk does not keep up; what was written until now can be used", path.display())]
    TooSlow {
        /// The file.
        path: PathBuf,
    },
}

impl RecordingError {
    pub(super) fn io(path: &Path, action: &'static str, cause: io::Error) -> Self {
        Self::Io { path: path.to_owned(), action, cause }
    }
}
