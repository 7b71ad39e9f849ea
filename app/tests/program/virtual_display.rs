//! Virtual X display for the program's windows, with time limits that suit a software driver.

use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// Time limit for a software driver on a busy machine.
const PATIENCE: Duration = Duration::from_secs(90);

/// Virtual display that ends with the test.
pub struct Display {
    server: Child,
    /// Name of the display, as in DISPLAY.
    pub name: String,
}

impl Display {
    /// Opens a display of this size, pixels.
    pub fn open([width, height]: [u32; 2]) -> Self {
        let mut server = Command::new("Xvfb")
            .args(["-displayfd", "1", "-screen", "0", &format!("{width}x{height}x24"), "-nolisten", "tcp"])
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
    pub fn tool(&self, arguments: &[&str]) -> Option<String> {
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

/// Repeats `look` until it gives an answer.
pub fn wait_for<T>(what: &str, mut look: impl FnMut() -> Option<T>) -> T {
    let began = Instant::now();
    loop {
        if let Some(found) = look() {
            return found;
        }
        assert!(began.elapsed() < PATIENCE, "no {what} after {PATIENCE:?}");
        std::thread::sleep(Duration::from_millis(100));
    }
}

/// Command that runs the program with its window on a display.
pub fn rapidity(folder: &Path, display: &str, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_rapidity"));
    command.args(arguments).current_dir(folder).env("DISPLAY", display).env_remove("WAYLAND_DISPLAY");
    command
}
