//! Law: head and hands of an OpenXR runtime, through the real program, are listed, are part of the ride with the
//! velocity that their places give, and replay to the same bits without the runtime.

use crate::runner::{rapidity, run, said, told};
use input::head::Tracking;
use input::openxr::XrReport;
use input::recording::{Recording, RecordingEntry};
use input::{SampleSource, Signal};

#[test]
fn head_and_hands_are_listed() {
    let folder = tempfile::tempdir().unwrap();
    let listed = run(folder.path(), &["devices", "--tracker", "openxr://", "--seconds", "4"]);
    let text = said(&listed);
    assert!(listed.status.success(), "{}", told(&listed));
    let device = text.lines().find(|line| line.starts_with("openxr ")).unwrap_or_else(|| panic!("{text}"));
    assert!(device.contains("Simulated HMD") && device.contains(" 0 bad, 0 dropped"), "{device}");
    for thing in ["sensor 0 of openxr (the head)", "sensor 1 of openxr", "sensor 2 of openxr"] {
        let line = text.lines().find(|line| line.trim_start().starts_with(thing)).unwrap_or_else(|| panic!("{text}"));
        assert!(line.contains(" m, yaw"), "{line}");
    }
    assert!(text.lines().any(|line| line.starts_with("head tracked")), "{text}");
    assert!(text.lines().any(|line| line.starts_with("wand tracked")), "{text}");
}

#[test]
fn a_ride_with_a_headset_as_its_tracker_replays_to_the_same_bits_without_it() {
    let folder = tempfile::tempdir().unwrap();
    let arguments = ["ride", "--scene", "lattice", "--realtime", "--seconds", "4", "--record", "r.mcap"];
    let picture = ["--size", "64x36", "--samples", "1", "--out", "r.mp4", "--tracker", "openxr://"];
    // Without ffmpeg, the film is a folder of pictures.
    let ridden = run(folder.path(), &[&arguments[..], &picture].concat());
    assert!(ridden.status.success(), "{}", told(&ridden));

    // The head of each frame moves as the reports say that it moves.
    let (mut heads, mut wands, mut places) = (Vec::new(), 0, Vec::new());
    for entry in Recording::open(&folder.path().join("r.mcap")).unwrap() {
        match entry.unwrap() {
            RecordingEntry::Controls(record) => {
                heads.extend(record.controls.head.filter(|head| head.tracked == Tracking::Tracked));
                wands += u32::from(record.controls.wand.is_some_and(|wand| wand.tracked == Tracking::Tracked));
            }
            RecordingEntry::Sample(sample) if sample.source == SampleSource::Openxr => {
                let Signal::Bytes(bytes) = sample.signal else { continue };
                let report = XrReport::from_bytes(&bytes).unwrap();
                places.extend(report.head.position_m.map(|place| (report.time_ns, place.map(f64::from))));
            }
            _ => {}
        }
    }
    assert!(heads.len() > 10 && wands > 10, "{} heads and {wands} wands were tracked", heads.len());
    assert!(places.len() > 40, "{} reports", places.len());
    let speeds = places.windows(5).map(|five| {
        let (from, to) = (&five[0], &five[4]);
        let way = [0, 1, 2].map(|axis| to.1[axis] - from.1[axis]);
        way.iter().map(|part| part * part).sum::<f64>().sqrt() / ((to.0 - from.0) as f64 * 1e-9)
    });
    let fastest = speeds.fold(0.0, f64::max);
    let found = heads.iter().map(|head| head.velocity_m_s.length()).fold(0.0, f64::max);
    assert!(fastest > 0.01, "the simulated head rests: {fastest} m/s");
    assert!((0.4 * fastest..2.5 * fastest).contains(&found), "{found} m/s of {fastest} m/s");

    // Where no runtime answers, the same.
    let mut command = rapidity(folder.path(), &["ride", "--replay", "r.mcap", "--verify"]);
    let verified = command.env("XR_RUNTIME_JSON", "/nowhere").output().unwrap();
    assert!(verified.status.success(), "{}", told(&verified));
    assert!(said(&verified).contains("identical to the bit"), "{}", said(&verified));
}

#[test]
fn a_runtime_that_is_not_there_is_told_in_a_sentence_and_the_ride_goes_on() {
    let folder = tempfile::tempdir().unwrap();
    let mut command = rapidity(folder.path(), &["devices", "--tracker", "openxr://", "--seconds", "1"]);
    let listed = command.env("XR_RUNTIME_JSON", "/nowhere").output().unwrap();
    let text = said(&listed);
    assert!(listed.status.success(), "{}", told(&listed));
    let device = text.lines().find(|line| line.starts_with("openxr")).unwrap_or_else(|| panic!("{text}"));
    assert!(device.contains("no OpenXR runtime answers"), "{device}");
}
