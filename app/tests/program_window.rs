//! Law: a window on a real (virtual) display rides, listens to keys, takes a photo, leaves on Escape, and its recording is
//! whole and replays to the bit. A window that lost keys, drew nothing or ended without completing its file would show here.
#![cfg(target_os = "linux")]

use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// Long enough for a software driver on a busy machine.
const PATIENCE: Duration = Duration::from_secs(90);

/// A virtual display that ends with the test.
struct Display {
    server: Child,
    name: String,
}

impl Display {
    fn open() -> Self {
        let mut server = Command::new("Xvfb")
            .args(["-displayfd", "1", "-screen", "0", "640x480x24", "-nolisten", "tcp"])
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .expect("Xvfb is installed (on Debian or Ubuntu: apt-get install xvfb xdotool)");
        let mut number = String::new();
        let output = server.stdout.take().expect("standard output was asked for as a pipe");
        BufReader::new(output).read_line(&mut number).expect("the server names its display");
        Self { server, name: format!(":{}", number.trim()) }
    }

    /// Runs xdotool; its output if it succeeded.
    fn tool(&self, arguments: &[&str]) -> Option<String> {
        let output = Command::new("xdotool")
            .args(arguments)
            .env("DISPLAY", &self.name)
            .output()
            .expect("xdotool is installed (on Debian or Ubuntu: apt-get install xvfb xdotool)");
        output.status.success().then(|| String::from_utf8_lossy(&output.stdout).trim().to_owned())
    }
}

impl Drop for Display {
    fn drop(&mut self) {
        let _ = self.server.kill();
        let _ = self.server.wait();
    }
}

/// Asks until there is an answer.
fn wait_for<T>(what: &str, mut look: impl FnMut() -> Option<T>) -> T {
    let began = Instant::now();
    loop {
        if let Some(found) = look() {
            return found;
        }
        assert!(began.elapsed() < PATIENCE, "no {what} after {PATIENCE:?}");
        std::thread::sleep(Duration::from_millis(100));
    }
}

fn rapidity(folder: &Path, display: &str, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_rapidity"));
    command.args(arguments).current_dir(folder).env("DISPLAY", display).env_remove("WAYLAND_DISPLAY");
    command
}

#[test]
fn a_window_rides_takes_a_photo_and_leaves_a_whole_recording() {
    let folder = tempfile::tempdir().unwrap();
    let display = Display::open();
    let arguments = ["ride", "--scene", "lattice", "--edge", "4", "--size", "320x240", "--record", "r.mcap"];
    let mut program = rapidity(folder.path(), &display.name, &arguments).spawn().unwrap();

    // Find the window, and press keys until each has shown what it does.
    let window = wait_for("window", || display.tool(&["search", "--name", "Rapidity"]).filter(|id| !id.is_empty()));
    wait_for("focus", || display.tool(&["windowfocus", "--sync", &window]));
    display.tool(&["keydown", "w"]);
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
    let verified = rapidity(folder.path(), "", &["ride", "--replay", "r.mcap", "--verify"]).output().unwrap();
    assert!(verified.status.success(), "{}", String::from_utf8_lossy(&verified.stderr));
}
