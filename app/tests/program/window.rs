//! Law: a window on a virtual display runs a ride, reacts to keys, takes a photo and closes on Escape, and its
//! recording is complete and replays to the bit. A window that lost keys, drew nothing or ended without completing
//! its file would show here.

use crate::runner::{run, said, told};
use crate::virtual_display::{VirtualDisplay, wait_for};
use input::SampleSource;
use input::recording::{Recording, RecordingEntry};
use std::time::Duration;

#[test]
fn a_window_rides_takes_a_photo_and_leaves_a_whole_recording() {
    let folder = tempfile::tempdir().unwrap();
    let display = VirtualDisplay::open([640, 480]);
    let arguments = ["ride", "--scene", "lattice", "--edge", "4", "--size", "320x240", "--record", "r.mcap"];
    let mut program = display.rapidity(folder.path(), &arguments).spawn().unwrap();

    // Find the window, and press keys until each has had its effect.
    let window = wait_for("window", || display.tool(&["search", "--name", "Rapidity"]).filter(|id| !id.is_empty()));
    wait_for("focus", || display.tool(&["windowfocus", "--sync", &window]));
    display.tool(&["keydown", "w"]);
    display.tool(&["keydown", "j"]);
    let drag = ["mousemove", "100", "100", "mousedown", "1", "mousemove", "130", "90", "mouseup", "1"];
    display.tool(&drag);
    let photo = folder.path().join("photo-001.png");
    wait_for("photo", || {
        display.tool(&["key", "c"]);
        std::thread::sleep(Duration::from_secs(1));
        image::open(&photo).ok()
    });
    let status = wait_for("end", || {
        display.tool(&["key", "Escape"]);
        program.try_wait().unwrap()
    });
    assert!(status.success());

    let picture = image::open(&photo).unwrap().into_rgb8();
    assert_eq!(picture.dimensions(), (320, 240));
    let first = *picture.get_pixel(0, 0);
    assert!(picture.pixels().any(|pixel| *pixel != first), "the photo shows nothing");
    // The look is recorded: what the key and the mouse have sent, and where it went.
    let entries: Vec<_> = Recording::open(&folder.path().join("r.mcap")).unwrap().map(Result::unwrap).collect();
    let turned =
        |entry: &RecordingEntry| matches!(entry, RecordingEntry::Controls(record) if !record.controls.look.is_ahead());
    assert!(entries.iter().any(turned), "nobody has looked round");
    let dragged = |entry: &RecordingEntry| matches!(entry, RecordingEntry::Sample(sample) if sample.source == SampleSource::Mouse);
    assert!(entries.iter().any(dragged), "the drag is not recorded");
    let verified = run(folder.path(), &["ride", "--replay", "r.mcap", "--verify"]);
    assert!(verified.status.success(), "{}", told(&verified));
}

/// A display server that ends takes the window with it, not the recording, whether Xlib or winit sees it first.
#[test]
fn a_display_that_goes_leaves_the_recording() {
    let folder = tempfile::tempdir().unwrap();
    let display = VirtualDisplay::open([640, 480]);
    let arguments = ["ride", "--scene", "lattice", "--edge", "4", "--size", "320x240", "--record", "r.mcap"];
    let program = display.rapidity(folder.path(), &arguments).stderr(std::process::Stdio::piped()).spawn().unwrap();
    let path = folder.path().join("r.mcap");
    wait_for("recording", || Recording::open(&path).ok()?.nth(20)).unwrap();
    drop(display);
    let output = program.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(1), "{}", told(&output));
    assert!(!told(&output).contains("panicked"), "{}", told(&output));
    let verified = run(folder.path(), &["ride", "--replay", "r.mcap", "--verify"]);
    let all_told = said(&verified) + &told(&verified);
    assert!(told(&output).contains("rapidity: "), "{}", told(&output));
    assert!(verified.status.success() && all_told.contains("identical to the bit"), "{all_told}");
}

/// Windows of this size take seconds to open, and nothing is ridden meanwhile.
#[test]
fn a_ride_that_is_ended_while_its_windows_open_leaves_no_broken_recording() {
    let display = VirtualDisplay::open([640, 480]);
    for pause_ms in [200, 600, 1500] {
        let folder = tempfile::tempdir().unwrap();
        let arguments = ["ride", "--scene", "lattice", "--edge", "4", "--size", "8192x4096", "--record", "r.mcap"];
        let mut program = display.rapidity(folder.path(), &arguments).spawn().unwrap();
        std::thread::sleep(Duration::from_millis(pause_ms));
        std::process::Command::new("kill").args(["-TERM", &program.id().to_string()]).status().unwrap();
        program.wait().unwrap();
        if folder.path().join("r.mcap").exists() {
            let verified = run(folder.path(), &["ride", "--replay", "r.mcap", "--verify"]);
            assert!(verified.status.success(), "{pause_ms} ms: {}", told(&verified));
        }
    }
}
