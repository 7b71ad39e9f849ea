//! Law: a kiosk runs until a signal, whatever visitors press. It shows an attract ride, gives whoever touches a control
//! a fresh ride at the start, and takes it back when the touches end. It fills its screen, with or without a window
//! manager. Its log and its recording are complete.

use crate::runner::{rapidity, run, told};
use crate::virtual_display::{VirtualDisplay, wait_for};
use serde_json::Value;
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};

/// Entries of the day's log, or of two if it is midnight.
fn log(folder: &Path) -> Vec<Value> {
    let Ok(days) = fs::read_dir(folder.join("log")) else { return Vec::new() };
    let mut days: Vec<_> = days.map(|day| day.unwrap().path()).collect();
    days.sort();
    let text: String = days.iter().map(|day| fs::read_to_string(day).unwrap()).collect();
    text.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

/// Number of entries of a kind.
fn count(folder: &Path, event: &str) -> usize {
    log(folder).iter().filter(|entry| entry["event"] == event).count()
}

#[test]
fn visitors_come_and_go_and_only_a_signal_ends_it() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let display = VirtualDisplay::open([320, 240]);
    let arguments = ["ride", "--scene", "lattice", "--edge", "4", "--size", "320x240", "--kiosk", "--idle-s", "2"];
    let arguments = [&arguments[..], &["--log", "log", "--record", "r.mcap"]].concat();
    let mut program = display.rapidity(folder, &arguments).stderr(Stdio::piped()).spawn().unwrap();

    // Nobody is there at first.
    let window = wait_for("window", || display.tool(&["search", "--name", "Rapidity"]).filter(|id| !id.is_empty()));
    wait_for("focus", || display.tool(&["windowfocus", "--sync", &window]));
    wait_for("attract ride", || (count(folder, "attract") > 0).then_some(()));

    // A visitor rides, tries every way out, takes photos, and leaves the ride paused and in slow motion.
    display.tool(&["keydown", "w"]);
    std::thread::sleep(std::time::Duration::from_secs(3));
    display.tool(&["keyup", "w"]);
    for key in ["Escape", "F3", "F4", "F11", "c", "v", "minus", "2", "p"] {
        display.tool(&["key", key]);
    }
    let before = count(folder, "attract");
    wait_for("end of the visit", || (count(folder, "ride") > 0).then_some(()));
    wait_for("attract ride", || (count(folder, "attract") > before).then_some(()));
    assert!(program.try_wait().unwrap().is_none(), "a visitor ended the kiosk");
    let rides: Vec<_> = log(folder).into_iter().filter(|entry| entry["event"] == "ride").collect();
    assert!(rides[0]["metres"].as_f64().unwrap() > 0.0, "{rides:?}");
    assert!(rides[0]["seconds"].as_f64().unwrap() > 0.0, "{rides:?}");

    // A signal ends it, and everything is complete.
    Command::new("kill").args(["-TERM", &program.id().to_string()]).status().unwrap();
    let output = program.wait_with_output().unwrap();
    assert!(output.status.success(), "{}", told(&output));
    let entries = log(folder);
    assert_eq!((&entries[0]["event"], &entries.last().unwrap()["event"]), (&"start".into(), &"end".into()));
    let files = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap());
    let mut files: Vec<_> = files.filter(|name| name != "state").collect();
    files.sort();
    assert_eq!(files, ["log", "r.mcap"], "visitors leave no files");
    let verified = run(folder, &["ride", "--replay", "r.mcap", "--verify"]);
    assert!(verified.status.success(), "{}", told(&verified));
}

/// With a tracker the ride is shown in a display, and its tracker here has never seen a head.
#[test]
fn a_kiosk_fills_its_screen_and_logs_a_head_that_is_not_seen() {
    for tracker in [&[][..], &["--tracker", "vrpn://127.0.0.1:9/Head"]] {
        let folder = tempfile::tempdir().unwrap();
        let folder = folder.path();
        let display = VirtualDisplay::open([400, 300]);
        let arguments = ["ride", "--scene", "lattice", "--edge", "4", "--size", "64x36", "--kiosk", "--log", "log"];
        let arguments = [&arguments[..], tracker].concat();
        let mut program = display.rapidity(folder, &arguments).stderr(Stdio::piped()).spawn().unwrap();
        let place = || display.tool(&["search", "--name", "Rapidity", "getwindowgeometry"]).filter(|of| !of.is_empty());
        let place = wait_for("window", place);
        assert!(place.contains("Position: 0,0") && place.contains("Geometry: 400x300"), "{tracker:?}: {place}");

        // The scene is drawn up to the edges: what is not has one colour.
        wait_for("picture", || {
            assert!(program.try_wait().unwrap().is_none(), "the kiosk has ended");
            let picture = display.picture()?;
            // Beside the edges, where no word stands.
            let many = |x: u32| {
                let part = image::imageops::crop_imm(&picture, x, 60, 40, 100).to_image();
                part.pixels().collect::<std::collections::HashSet<_>>().len() > 4
            };
            (many(0) && many(360)).then_some(())
        });
        let unseen = |entry: &Value| entry["sentence"].as_str().is_some_and(|told| told.contains("has not been seen"));
        if !tracker.is_empty() {
            wait_for("word of the head", || log(folder).iter().any(unseen).then_some(()));
        }
        assert_eq!(log(folder).iter().filter(|entry| unseen(entry)).count(), usize::from(!tracker.is_empty()));
        Command::new("kill").args(["-TERM", &program.id().to_string()]).status().unwrap();
        assert!(program.wait().unwrap().success());
    }
}

#[test]
fn a_kiosk_without_a_screen_or_a_log_says_so() {
    let folder = tempfile::tempdir().unwrap();
    let output = run(folder.path(), &["ride", "--kiosk"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(told(&output).contains("--kiosk needs a window"), "{}", told(&output));

    let mut command = rapidity(folder.path(), &["ride", "--scene", "lattice", "--kiosk", "--log", "/dev/null/log"]);
    let output = command.env("DISPLAY", ":4711").output().unwrap();
    assert_eq!(output.status.code(), Some(1));
    assert!(told(&output).contains("/dev/null/log"), "{}", told(&output));
}
