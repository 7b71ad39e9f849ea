//! Recordings of a ride, as MCAP files that Foxglove and similar programs plot.
//!
//! | channel | a message for | holds |
//! |---|---|---|
//! | `/device/raw` | every frame with samples | their number, times, devices and raw bytes, in CBOR |
//! | `/controls` | every frame | what the desk made of them, and how many samples came before, in JSON |
//! | `/observer` | every frame | where and how fast the observer was afterwards, in JSON |
//! | `/pose` | every frame | the observer's pose as `foxglove.PoseInFrame`, for 3D views |
//! | `/tf` | the ride | the scene's axes as `foxglove.FrameTransform`, so that up is up in such a view |
//!
//! A replay feeds the raw bytes to a desk, reads the controls at the recorded frame times, and must get the recorded
//! observer to the last bit: [`FrameRecord::first_difference`]. Numbers in JSON keep every bit (the shortest text that
//! reads back to the same value). MCAP's log times are those of a wall clock, nanoseconds since 1970; the ride's own
//! time, `at`, is in the messages, and a replay uses nothing else.
//!
//! Samples and frames carry their own numbers, so that a lost one is noticed, and so that the order of the ride is
//! kept however another program writes the file anew: with other chunks, compression, sequence numbers, channels of
//! its own, without checksums or indexes (`assembly.rs`). In files of the first format, MCAP's sequence numbers serve
//! instead (`sequence.rs`).
//!
//! A metadata record holds the [`RideHeader`] with a checksum. Chunks of at most half a second follow, each compressed
//! with zstd, written whole and with its own checksum. So a crash loses at most the last chunk. [`Recorder`] writes on
//! a thread of its own, [`Recording`] reads.

mod assembly;
mod chunk;
mod content;
mod error;
mod follower;
mod header;
mod outer_records;
mod parse;
mod pose;
mod reader;
mod record;
mod recorder;
mod sample_message;
mod sequence;
mod topic;
mod writer;

pub use error::RecordingError;
pub use follower::RecordingFollower;
pub use header::RideHeader;
pub use reader::Recording;
pub use record::{ControlsRecord, FrameDifference, FrameRecord, RecordingEntry};
pub use recorder::Recorder;
