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

/// A rider who goes on in another scene, drawn in another way, loses nothing: the recording of the ride before is
/// whole, and a replay shows it drawn as its rider wished.
#[test]
fn a_rider_changes_scene_and_method_in_mid_ride() {
    let folder = tempfile::tempdir().unwrap();
    let display = VirtualDisplay::open([640, 480]);
    let keys = "[keys]\nF12 = '{\"scene\":\"dice\"}'\nF10 = '{\"set\":[\"renderer\",\"--renderer polygon --tolerance 4\"]}'\n\
                F9 = '{\"scene\":\"nowhere.glb\"}'\nF8 = '{\"tour\":\"bells\"}'\n";
    std::fs::write(folder.path().join("keys.toml"), keys).unwrap();
    let arguments = ["ride", "--scene", "lattice", "--renderer", "image", "--size", "320x240", "--record", "r.mcap"];
    let arguments = [&arguments[..], &["--set-up", "keys.toml"]].concat();
    let told_to = std::fs::File::create(folder.path().join("told")).unwrap();
    let mut program = display.rapidity(folder.path(), &arguments).stderr(told_to).spawn().unwrap();
    let all_told = || std::fs::read_to_string(folder.path().join("told")).unwrap();
    let named = |title: &str| display.tool(&["search", "--name", title]).filter(|id| !id.is_empty());
    let window = wait_for("window", || named("Rapidity: lattice"));
    wait_for("focus", || display.tool(&["windowfocus", "--sync", &window]));
    let press_until = |key: &str, what: &str, done: &dyn Fn() -> bool| {
        wait_for(what, || {
            display.tool(&["key", key]);
            std::thread::sleep(Duration::from_millis(1500));
            done().then_some(())
        });
    };
    press_until("F10", "method", &|| all_told().contains("drawn by the polygon renderer"));
    press_until("F9", "refusal", &|| all_told().contains("nowhere.glb"));
    assert!(named("Rapidity: lattice").is_some(), "a scene that is not there has ended the ride");
    press_until("F12", "scene", &|| named("Rapidity: dice").is_some());
    press_until("F8", "tour", &|| named("Rapidity: train").is_some());
    let status = wait_for("end", || {
        display.tool(&["key", "Escape"]);
        program.try_wait().unwrap()
    });
    assert!(status.success(), "{}", all_told());
    let verified = run(folder.path(), &["ride", "--replay", "r.mcap", "--verify"]);
    assert!(verified.status.success(), "{}", told(&verified));

    // The onlooker's window draws as the rider's did.
    let told_to = std::fs::File::create(folder.path().join("told")).unwrap();
    let shown = ["ride", "--replay", "r.mcap", "--renderer", "image", "--size", "320x240"];
    let mut program = display.rapidity(folder.path(), &shown).stderr(told_to).spawn().unwrap();
    wait_for("method of the rider", || all_told().contains("drawn by the polygon renderer").then_some(()));
    program.kill().unwrap();
    program.wait().unwrap();
}
