//! Law: a head that a VRPN server tracks, through a real socket and the real program, is listed, is part of the ride,
//! and replays to the same bits, also where the C library has no fused multiplication. A program that lost the tracker
//! on its way would have no head; one that read a clock would have another head the second time.

use crate::runner::{WITHOUT_FMA, rapidity, run, said, told};
use crate::turning_head::{SWAY, TURN, flood, pose, serve};
use std::sync::atomic::Ordering;
use std::time::Duration;

use input::head::{HeadState, Tracking};
use input::recording::{Recording, RecordingEntry};
use input::{Sample, Signal};

#[test]
fn a_tracked_head_is_listed() {
    let folder = tempfile::tempdir().unwrap();
    let listed = run(folder.path(), &["devices", "--tracker", &serve(), "--seconds", "1.5"]);
    let text = said(&listed);
    assert!(listed.status.success(), "{}", told(&listed));
    let device = text.lines().find(|line| line.starts_with("vrpn ")).unwrap_or_else(|| panic!("{text}"));
    assert!(device.contains("Head") && device.contains(" 0 bad, 0 dropped"), "{device}");
    let head = text.lines().find(|line| line.starts_with("head ")).unwrap_or_else(|| panic!("{text}"));
    assert!(head.starts_with("head tracked") && head.contains("+1.600") && head.ends_with("0 rejected"), "{head}");

    let other = serve().replace("Head", "Wand");
    let text = said(&run(folder.path(), &["devices", "--tracker", &other, "--seconds", "4.5"]));
    assert!(text.contains("head not seen yet") && text.contains("the server sends sensor 0 of Head"), "{text}");
}

#[test]
fn a_ride_with_a_tracked_head_replays_to_the_same_bits() {
    let folder = tempfile::tempdir().unwrap();
    let tracker = serve();
    let arguments = ["ride", "--scene", "lattice", "--realtime", "--seconds", "3", "--record", "r.mcap"];
    let picture = ["--size", "64x36", "--samples", "1", "--out", "r.mp4", "--tracker", &tracker];
    let ridden = run(folder.path(), &[&arguments[..], &picture].concat());
    assert!(ridden.status.success(), "{}", told(&ridden));

    let recording = Recording::open(&folder.path().join("r.mcap")).unwrap();
    let head = recording.header().desk.head.clone().expect("the header says how the head was tracked");
    assert_eq!(head.url.to_string(), tracker);
    let heads: Vec<_> = recording
        .filter_map(|entry| match entry.unwrap() {
            RecordingEntry::Controls(record) => record.controls.head,
            _ => None,
        })
        .filter(|head| head.tracked == Tracking::Tracked)
        .collect();
    let fastest = |rate: fn(&HeadState) -> f64| heads.iter().map(|head| rate(head).abs()).fold(0.0, f64::max);
    // Both are means of four frames, on a busy machine.
    for ((amplitude, rate), found) in
        [(SWAY, fastest(|head| head.velocity_m_s.x)), (TURN, fastest(|head| head.turn_rad_s.y))]
    {
        let expected = amplitude * rate;
        assert!((0.5 * expected..1.5 * expected).contains(&found), "{found} of {expected} in {} frames", heads.len());
    }

    for (name, value) in [("RAPIDITY_TESTS", "as it is"), WITHOUT_FMA] {
        let mut command = rapidity(folder.path(), &["ride", "--replay", "r.mcap", "--verify"]);
        let verified = command.env(name, value).output().unwrap();
        assert!(verified.status.success(), "{name}: {}", told(&verified));
        assert!(said(&verified).contains("identical to the bit"), "{name}: {}", said(&verified));
    }
}

#[test]
fn a_wrong_place_is_told_in_a_sentence() {
    let folder = tempfile::tempdir().unwrap();
    let refused = run(folder.path(), &["ride", "--tracker", "vrpn://cave"]);
    assert_eq!(refused.status.code(), Some(2));
    let text = told(&refused);
    assert!(text.contains("names no device of the server") && text.lines().count() == 1, "{text}");
}

#[test]
fn a_flood_of_poses_leaves_the_ride_its_frames_and_the_recording_its_size() {
    let folder = tempfile::tempdir().unwrap();
    let (tracker, sent) = flood();
    let arguments = ["ride", "--scene", "lattice", "--realtime", "--seconds", "3", "--record", "r.mcap"];
    let picture = ["--size", "64x36", "--samples", "1", "--out", "r.mp4", "--tracker", &tracker];
    let ridden = run(folder.path(), &[&arguments[..], &picture].concat());
    assert!(ridden.status.success(), "{}", told(&ridden));

    let (path, sent) = (folder.path().join("r.mcap"), sent.load(Ordering::Relaxed));
    let bytes = std::fs::metadata(&path).unwrap().len();
    let (mut frames, mut poses) = (0_u64, 0_u64);
    for entry in Recording::open(&path).unwrap() {
        match entry.unwrap() {
            RecordingEntry::Frame(_) => frames += 1,
            RecordingEntry::Sample(Sample { signal: Signal::Bytes(bytes), .. }) => {
                poses += (bytes.len() / pose(Duration::ZERO).len()) as u64;
            }
            RecordingEntry::Sample(_) | RecordingEntry::Controls(_) => {}
        }
    }
    println!("{sent} poses sent in 3 s, {poses} at most recorded, {frames} frames, {bytes} bytes");
    assert!(sent > 300_000, "{sent} poses are no flood");
    assert!(poses < 60_000, "{poses} poses were recorded");
    assert!(bytes < 10_000_000, "the recording has {bytes} bytes");
    // Sixty a second, on a machine whose other core sends.
    assert!(frames > 90, "{frames} frames in 3 s");
}
