//! Laws of a ride that is shown in a headset, and mirrored in a window: head and hands of the runtime are part of it,
//! its recording replays without runtime and headset to the same bits, and a runtime that is killed costs the pictures
//! in the headset alone: a sentence says so, the ride goes on in the window, and the recording is whole.

use crate::runner::{rapidity, said, told};
use crate::virtual_display::{VirtualDisplay, wait_for};
use input::head::Tracking;
use input::recording::{Recording, RecordingEntry};
use input::{SampleSource, Signal};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::Duration;
use xr_layer::{PLAIN_RUNTIME, plain_runtime};

/// Socket at which the runtime is reached.
const SOCKET: &str = "/run/rapidity/monado_comp_ipc";

/// Ride in the headset whose window has come.
pub struct Worn {
    display: VirtualDisplay,
    program: Child,
    folder: tempfile::TempDir,
    window: String,
}

impl Worn {
    fn new() -> Self {
        Self::arranged(tempfile::tempdir().unwrap(), |_| {})
    }

    /// Ride in a folder, whose command is arranged first.
    pub fn arranged(folder: tempfile::TempDir, arrange: impl FnOnce(&mut Command)) -> Self {
        let display = VirtualDisplay::open([640, 480]);
        let arguments = ["ride", "--display", "openxr", "--scene", "dice", "--language", "en", "--record", "r.mcap"];
        let mut command = display.rapidity(folder.path(), &arguments);
        command.env("XDG_CONFIG_HOME", folder.path()).stdout(Stdio::piped()).stderr(Stdio::piped());
        arrange(&mut command);
        let program = command.spawn().unwrap();
        let window = wait_for("window", || display.tool(&["search", "--name", "Rapidity"]).filter(|id| !id.is_empty()));
        Self { display, program, folder, window }
    }

    /// Holds the key that drives ahead for some seconds.
    pub fn drive(&self, seconds: f64) {
        self.display.tool(&["windowfocus", &self.window]);
        self.display.tool(&["keydown", "w"]).unwrap();
        std::thread::sleep(Duration::from_secs_f64(seconds));
        self.display.tool(&["keyup", "w"]).unwrap();
    }

    /// Ends the ride by its key. What it said on standard error, and its folder.
    pub fn end(self) -> (String, tempfile::TempDir) {
        let Self { display, program, folder, window } = self;
        display.tool(&["windowfocus", &window]);
        display.tool(&["key", "Escape"]).unwrap();
        let output = program.wait_with_output().unwrap();
        assert!(output.status.success(), "{}", told(&output));
        (told(&output), folder)
    }
}

/// Numbers of frames with a tracked head, with a tracked wand, and after the end of the session.
struct Ridden {
    heads: usize,
    wands: usize,
    closed: bool,
    after: usize,
}

fn ridden(folder: &Path) -> Ridden {
    let mut ridden = Ridden { heads: 0, wands: 0, closed: false, after: 0 };
    for entry in Recording::open(&folder.join("r.mcap")).unwrap() {
        match entry.unwrap() {
            RecordingEntry::Controls(record) => {
                let is_tracked = |tracked: Tracking| usize::from(tracked == Tracking::Tracked);
                ridden.heads += record.controls.head.map_or(0, |head| is_tracked(head.tracked));
                ridden.wands += record.controls.wand.map_or(0, |wand| is_tracked(wand.tracked));
                ridden.after += usize::from(ridden.closed);
            }
            RecordingEntry::Sample(sample) if sample.source == SampleSource::Openxr => {
                ridden.closed |= sample.signal == Signal::Closed;
            }
            _ => {}
        }
    }
    ridden
}

/// Replays the ride where no runtime answers, and compares its bits.
pub fn assert_replays(folder: &Path) {
    let mut command = rapidity(folder, &["ride", "--replay", "r.mcap", "--verify"]);
    let verified = command.env("XR_RUNTIME_JSON", "/nowhere").output().unwrap();
    assert!(verified.status.success(), "{}", told(&verified));
    assert!(said(&verified).contains("identical to the bit"), "{}", said(&verified));
}

#[test]
fn a_ride_in_a_headset_has_its_head_and_hands_and_replays_without_it() {
    let worn = Worn::new();
    worn.drive(5.0);
    let (told, folder) = worn.end();
    assert!(told.contains("headset: Monado: Simulated HMD"), "{told}");
    let ridden = ridden(folder.path());
    assert!(ridden.heads >= 2 && ridden.wands >= 2, "{} heads, {} wands", ridden.heads, ridden.wands);
    assert!(!ridden.closed, "the session ended: {told}");
    assert_replays(folder.path());
}

#[test]
fn a_runtime_that_is_killed_costs_the_headset_alone() {
    let worn = Worn::new();
    worn.drive(3.0);
    let killed = Command::new("sh").args(["-c", "kill -KILL \"$(cat /run/rapidity/monado.pid)\""]).status();
    assert!(killed.unwrap().success());
    worn.drive(3.0);
    let (told, folder) = worn.end();
    let lost: Vec<&str> = told.lines().filter(|line| line.contains("the ride goes on in the window")).collect();
    assert!(lost.len() == 1 && lost[0].contains("has ended the session"), "{told}");
    let ridden = ridden(folder.path());
    assert!(ridden.heads >= 2 && ridden.closed && ridden.after >= 2, "{} frames after the end", ridden.after);
    assert_replays(folder.path());

    // A new runtime serves the next ride.
    let _ = std::fs::remove_file(SOCKET);
    let started =
        Command::new("monado-service").stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null()).spawn();
    started.unwrap();
    wait_for("runtime", || Path::new(SOCKET).exists().then_some(()));
    let worn = Worn::new();
    worn.drive(3.0);
    let (told, folder) = worn.end();
    assert!(self::ridden(folder.path()).heads >= 2, "{told}");
}

#[test]
fn a_headset_without_a_runtime_is_told_in_a_sentence() {
    let display = VirtualDisplay::open([640, 480]);
    let folder = tempfile::tempdir().unwrap();
    let mut command = display.rapidity(folder.path(), &["ride", "--display", "openxr", "--scene", "dice"]);
    command.env("XR_RUNTIME_JSON", "/nowhere").env("XDG_CONFIG_HOME", folder.path());
    let refused = command.output().unwrap();
    let text = told(&refused);
    assert!(!refused.status.success() && text.contains("no OpenXR runtime answers"), "{text}");
    assert_eq!(text.lines().filter(|line| line.starts_with("rapidity: ")).count(), 1, "{text}");
}

#[test]
fn a_runtime_that_lacks_what_is_needed_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let mut command = rapidity(folder.path(), &["devices", "--tracker", "openxr://", "--seconds", "1"]);
    command.env("XR_RUNTIME_JSON", plain_runtime(folder.path())).env_remove("XR_ENABLE_API_LAYERS");
    let listed = command.output().unwrap();
    let expected = format!("{PLAIN_RUNTIME} lacks XR_MND_headless");
    assert!(listed.status.success() && said(&listed).contains(&expected), "{}{}", said(&listed), told(&listed));
}
