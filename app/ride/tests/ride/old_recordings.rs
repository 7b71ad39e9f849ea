//! Law: a recording stays a ride: what an earlier version of the program recorded replays to the same bits.
//!
//! The recordings were made in the lattice before the program was divided into crates: by the sensors of a bicycle,
//! by keys in flight, and with a tracked head. A changed constant of the vehicle, a changed order of operations or
//! a changed decoder would give other bits. A changed format would make the recordings unreadable.

#![allow(clippy::unwrap_used, reason = "helpers of tests, too, may fail the test")]

use std::path::{Path, PathBuf};
use std::sync::{Arc, LazyLock};

use built_in::lattice::Lattice;
use input::VehicleKind;
use input::recording::{Recording, RecordingEntry};
use ride::Replay;
use scene::collision::Collision;

/// Number of frames in each recording.
const FRAMES: u64 = 240;

static LATTICE: LazyLock<Arc<Collision>> =
    LazyLock::new(|| Arc::new(Collision::new(&Lattice::default().build()).unwrap()));

fn path(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/recordings").join(name)
}

#[track_caller]
fn assert_replays(name: &str, kind: VehicleKind) {
    let recording = Recording::open(&path(name)).unwrap();
    assert_eq!((recording.header().scene.as_str(), recording.header().vehicle), ("lattice", kind));
    let mut replay = Replay::new(recording, LATTICE.clone()).unwrap();
    assert_eq!(replay.verify().unwrap(), FRAMES);
}

/// Number of recorded controls that hold a head.
fn heads(name: &str) -> u64 {
    let entries = Recording::open(&path(name)).unwrap();
    entries.filter(|entry| matches!(entry.as_ref().unwrap(), RecordingEntry::Controls(record) if record.controls.head.is_some())).count() as u64
}

#[test]
fn a_ride_by_bicycle_replays_to_the_same_bits() {
    assert_replays("bicycle.mcap", VehicleKind::Bicycle);
    assert_eq!(heads("bicycle.mcap"), 0);
}

#[test]
fn a_flight_replays_to_the_same_bits() {
    assert_replays("fly.mcap", VehicleKind::Fly);
    assert_eq!(heads("fly.mcap"), 0);
}

#[test]
fn a_ride_with_a_tracked_head_replays_to_the_same_bits() {
    assert_replays("head.mcap", VehicleKind::Bicycle);
    // The first frame was recorded before the tracker's first pose.
    assert_eq!(heads("head.mcap"), FRAMES - 1);
}
