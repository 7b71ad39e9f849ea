//! Recordings of a ride, as MCAP files that Foxglove and its kin plot.
//!
//! | channel | a message for | holds |
//! |---|---|---|
//! | `/device/raw` | every sample | device, raw bytes, time |
//! | `/controls` | every frame | what the desk made of them |
//! | `/observer` | every frame | where and how fast the observer was afterwards |
//!
//! A replay feeds the raw bytes to a desk, asks it at the recorded frame times, and must get the
//! recorded observer to the last bit: [`FrameRecord::first_difference`]. Messages are JSON with a
//! JSON schema; numbers keep every bit (the shortest text that reads back the same). Log times are
//! nanoseconds since the ride began. Messages of all channels are numbered as one sequence, so that
//! a lost one shows.
//!
//! The first record is a metadata record that holds the [`Header`] with a checksum; then follow
//! chunks of at most half a second, each whole and with its own checksum. A crash therefore loses
//! at most the last one. [`Recorder`] writes on a thread of its own, [`Recording`] reads.

mod reader;
mod record;
mod records;
mod wire;
mod writer;

use std::collections::BTreeMap;
use std::io;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};
use thiserror::Error;

pub use reader::Recording;
pub use record::{ControlsRecord, Difference, Entry, FrameRecord};
pub use writer::Recorder;

use crate::action::VehicleKind;
use crate::config::DeskConfig;

/// MCAP profile, which tells our files from others.
const PROFILE: &str = "rapidity";
/// Name of the metadata record with the header.
const METADATA: &str = "rapidity";
/// Version of the format; counts up when older programs could not read it.
const VERSION: &str = "1";
/// Key of the format's version in the metadata.
const KEY_VERSION: &str = "format_version";
/// Key of the header, as JSON.
const KEY_HEADER: &str = "header";
/// Key of the header's CRC-32, eight hexadecimal digits.
const KEY_CHECKSUM: &str = "header_crc32";

/// What a ride depends on besides its samples.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Header {
    /// Version of the program that recorded.
    pub build: String,
    /// The scene: a file or the name of a built-in one.
    pub scene: String,
    /// Speed of light in the world at the start, m/s.
    pub speed_of_light_m_s: f64,
    /// Vehicle at the start.
    pub vehicle: VehicleKind,
    /// Name of the integrator.
    pub integrator: String,
    /// Its step, seconds of proper time.
    pub step_s: f64,
    /// How the devices are read.
    pub desk: DeskConfig,
    /// Whatever else decides the ride, by name: the seed of a built-in scene, the place of the
    /// start.
    pub settings: BTreeMap<String, String>,
}

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
    fn io(path: &Path, action: &'static str, cause: io::Error) -> Self {
        Self::Io { path: path.to_owned(), action, cause }
    }
}
