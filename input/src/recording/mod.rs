//! Recordings of a ride, as MCAP files that Foxglove and similar programs plot.
//!
//! | channel | a message for | holds |
//! |---|---|---|
//! | `/device/raw` | every sample | device, raw bytes, time |
//! | `/controls` | every frame | what the desk made of them |
//! | `/observer` | every frame | where and how fast the observer was afterwards |
//!
//! A replay feeds the raw bytes to a desk, reads the controls at the recorded frame times, and must get the recorded
//! observer to the last bit: [`FrameRecord::first_difference`]. Messages are JSON with a JSON schema; numbers keep
//! every bit (the shortest text that reads back to the same value). Log times are nanoseconds since the ride began.
//! Messages of all channels are numbered as one sequence, so that a lost one is noticed.
//!
//! The first record is a metadata record that holds the [`RideHeader`] with a checksum. Chunks of at most half a
//! second follow, each written whole and with its own checksum. So a crash loses at most the last chunk. [`Recorder`]
//! writes on a thread of its own, [`Recording`] reads.

mod chunk;
mod error;
mod header;
mod outer_records;
mod parse;
mod reader;
mod record;
mod writer;

pub use error::RecordingError;
pub use header::RideHeader;
pub use reader::Recording;
pub use record::{ControlsRecord, FrameDifference, FrameRecord, RecordingEntry};
pub use writer::Recorder;
