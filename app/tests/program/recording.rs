//! Law: a recording holds what was ridden until the last second, whatever ends the ride; and where it cannot, the
//! program says so when it happens and ends with status 1. A program that breaks this law loses a ride in silence.

use crate::runner::{rapidity, run, said, told};
use input::recording::{Recording, RecordingEntry};
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};

/// Time limit for a software driver on a busy machine.
const PATIENCE: Duration = Duration::from_secs(60);

/// Options of a short ride in the lattice, filmed as small as possible.
const SMALL: [&str; 7] = ["ride", "--scene", "lattice", "--size", "64x36", "--samples", "1"];

/// Records a ride of a second.
fn ridden(folder: &Path, name: &str) -> Vec<u8> {
    let output = run(folder, &[&SMALL[..], &["--record", name, "--seconds", "1", "--out", "r.mp4"]].concat());
    assert!(output.status.success(), "{}", told(&output));
    std::fs::read(folder.join(name)).unwrap()
}

/// Number of frames that can be read.
fn frames(path: &Path) -> usize {
    let entries = Recording::open(path).unwrap();
    entries.filter(|entry| matches!(entry, Ok(RecordingEntry::Frame(_)))).count()
}

#[track_caller]
fn assert_told(output: &Output, status: i32, words: &[&str]) {
    let told = told(output);
    assert_eq!(output.status.code(), Some(status), "{told}");
    for word in words {
        assert!(told.contains(word), "{told:?} does not say {word:?}");
    }
    assert!(!told.contains("panicked"), "{told}");
}

/// A crash at any moment costs a second at most: the times of the messages are those of the wall clock.
#[test]
fn a_killed_ride_is_recorded_until_the_last_second() {
    for milliseconds in [1300, 1900] {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("r.mcap");
        let arguments =
            [&SMALL[..], &["--record", "r.mcap", "--realtime", "--seconds", "60", "--out", "r.mp4"]].concat();
        let mut program = rapidity(folder.path(), &arguments).stderr(Stdio::null()).spawn().unwrap();
        let began = Instant::now();
        // At first there is no file, then an empty one.
        while !(Recording::open(&path).is_ok() && frames(&path) > 0) {
            assert!(began.elapsed() < PATIENCE, "nothing was recorded");
            std::thread::sleep(Duration::from_millis(20));
        }
        std::thread::sleep(Duration::from_millis(milliseconds));
        program.kill().unwrap();
        let killed = SystemTime::now().duration_since(UNIX_EPOCH).unwrap().as_nanos() as u64;
        program.wait().unwrap();
        let bytes = std::fs::read(&path).unwrap();
        let messages = mcap::MessageStream::new_with_options(&bytes, [mcap::read::Options::IgnoreEndMagic].into());
        let times = messages.unwrap().map_while(Result::ok).filter(|message| message.channel.topic == "/observer");
        let lost = killed - times.map(|message| message.log_time).max().unwrap();
        // The limit is twice the promise, for a busy machine.
        assert!(lost < 2_000_000_000, "{} s are lost", lost as f64 * 1e-9);

        let verified = run(folder.path(), &["ride", "--replay", "r.mcap", "--verify"]);
        let all = format!("all {} frames that can be read are identical to the bit, but", frames(&path));
        assert_told(&verified, 1, &[&all, "ends too early"]);
    }
}

/// Largest size of a file stands for a full disk, which needs rights to make.
#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_told_when_it_happens_and_ends_with_status_1() {
    let folder = tempfile::tempdir().unwrap();
    let arguments = [&SMALL[..], &["--record", "r.mcap", "--realtime", "--seconds", "2", "--out", "r.mp4"]].concat();
    let limited = |blocks: u32| {
        let mut shell = Command::new("sh");
        shell.args(["-c", &format!("ulimit -f {blocks}; exec \"$0\" \"$@\""), env!("CARGO_BIN_EXE_rapidity")]);
        shell.args(&arguments).current_dir(folder.path()).env_remove("DISPLAY").env_remove("WAYLAND_DISPLAY");
        shell.output().unwrap()
    };
    let output = limited(16);
    assert_told(&output, 1, &["cannot write r.mcap any further", "the ride was not recorded to its end"]);
    // The film is drawn all the same.
    assert_told(&output, 1, &["wrote r.mp4"]);
    assert!(folder.path().join("r.mp4").exists());
    let verified = run(folder.path(), &["ride", "--replay", "r.mcap", "--verify"]);
    assert_told(&verified, 1, &["ends too early"]);
}

#[cfg(unix)]
#[test]
fn a_removed_recording_is_told_and_ends_with_status_1() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("r.mcap");
    let arguments = [&SMALL[..], &["--record", "r.mcap", "--realtime", "--seconds", "3", "--out", "r.mp4"]].concat();
    let program = rapidity(folder.path(), &arguments).stderr(Stdio::piped()).spawn().unwrap();
    let began = Instant::now();
    while !path.exists() {
        assert!(began.elapsed() < PATIENCE, "nothing was recorded");
        std::thread::sleep(Duration::from_millis(20));
    }
    std::fs::remove_file(&path).unwrap();
    assert_told(
        &program.wait_with_output().unwrap(),
        1,
        &["r.mcap was removed or replaced", "not recorded to its end"],
    );
}

#[test]
fn a_scene_that_is_named_is_taken_even_if_it_is_the_default() {
    let folder = tempfile::tempdir().unwrap();
    ridden(folder.path(), "r.mcap");
    let as_recorded = run(folder.path(), &["ride", "--replay", "r.mcap", "--verify"]);
    assert!(
        as_recorded.status.success() && said(&as_recorded).contains("30 frames, identical"),
        "{}",
        told(&as_recorded)
    );
    let in_town = run(folder.path(), &["ride", "--replay", "r.mcap", "--scene", "town", "--verify"]);
    // On flat ground the ride may be the same.
    assert!(told(&in_town).contains("town is not the scene that was ridden through"), "{}", told(&in_town));
}

#[test]
fn two_recordings_in_one_file_are_told() {
    let folder = tempfile::tempdir().unwrap();
    let bytes = ridden(folder.path(), "r.mcap");
    std::fs::write(folder.path().join("two.mcap"), [&bytes[..], &bytes].concat()).unwrap();
    let words = format!("two.mcap holds another recording from byte {} on", bytes.len());
    let verified = run(folder.path(), &["ride", "--replay", "two.mcap", "--verify"]);
    assert_told(&verified, 0, &[&words]);
    let checked = run(folder.path(), &["check", "two.mcap"]);
    assert!(said(&checked).contains(&words), "{}", said(&checked));
}

/// A ride in which the computer slept for a year, or that was made to look so.
#[test]
fn a_year_between_two_frames_does_not_fill_the_memory() {
    let folder = tempfile::tempdir().unwrap();
    let bytes = ridden(folder.path(), "r.mcap");
    const YEAR: u64 = 365 * 24 * 3600 * 1_000_000_000;
    // The same ride in the first format, whose second frame comes a year later.
    let later = |text: &[u8]| {
        let mut message: serde_json::Value = serde_json::from_slice(text).unwrap();
        let at = message["at"].as_u64().unwrap();
        message["at"] = (if at > 0 { at + YEAR } else { 0 }).into();
        message.to_string().into_bytes()
    };
    let summary = mcap::Summary::read(&bytes).unwrap().unwrap();
    let description = mcap::read::metadata(&bytes, &summary.metadata_indexes[0]).unwrap();
    let options = mcap::WriteOptions::new().profile("rapidity").compression(None);
    let mut copy = options.create(std::io::Cursor::new(Vec::new())).unwrap();
    copy.write_metadata(&description).unwrap();
    for message in mcap::MessageStream::new(&bytes).unwrap() {
        let mut message = message.unwrap();
        if ["/observer", "/controls"].contains(&message.channel.topic.as_str()) {
            message.data = later(&message.data).into();
        }
        copy.write(&message).unwrap();
    }
    copy.finish().unwrap();
    std::fs::write(folder.path().join("year.mcap"), copy.into_inner().into_inner()).unwrap();

    let gap = "one gap of more than 10 s without a frame";
    let checked = run(folder.path(), &["check", "year.mcap"]);
    assert!(checked.status.success() && said(&checked).contains(gap), "{}", said(&checked));
    for out in ["a.png", "a.mp4"] {
        let small = ["--size", "64x36", "--samples", "1", "--out", out];
        let output = run(folder.path(), &[&["render", "--replay", "year.mcap"][..], &small].concat());
        assert_told(&output, 0, &[gap, "wrote"]);
    }
}
