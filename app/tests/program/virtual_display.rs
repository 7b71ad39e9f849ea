//! Virtual X display for the program's windows, with time limits that suit a software driver.

use crate::runner::rapidity;
use image::RgbImage;
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// Time limit for a software driver on a busy machine.
const PATIENCE: Duration = Duration::from_secs(90);

/// Virtual display that ends with the test.
pub struct VirtualDisplay {
    server: Child,
    size: [u32; 2],
    /// Name of the display, as in DISPLAY.
    pub name: String,
}

impl VirtualDisplay {
    /// Opens a display of this size, pixels.
    pub fn open(size: [u32; 2]) -> Self {
        let [width, height] = size;
        let mut server = Command::new("Xvfb")
            .args(["-displayfd", "1", "-screen", "0", &format!("{width}x{height}x24"), "-nolisten", "tcp"])
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .expect("Xvfb is installed (on Debian or Ubuntu: apt-get install xvfb xdotool)");
        let mut number = String::new();
        let output = server.stdout.take().expect("standard output was asked for as a pipe");
        BufReader::new(output).read_line(&mut number).expect("the server names its display");
        Self { server, size, name: format!(":{}", number.trim()) }
    }

    /// Command that runs the program in a folder, with its windows on this display.
    pub fn rapidity(&self, folder: &Path, arguments: &[&str]) -> Command {
        let mut command = rapidity(folder, arguments);
        command.env("DISPLAY", &self.name);
        command
    }

    /// Picture of the whole display; `None` while the server is not ready.
    pub fn picture(&self) -> Option<RgbImage> {
        let folder = tempfile::tempdir().expect("there is a folder for temporary files");
        let shot = folder.path().join("screen.png");
        let [width, height] = self.size;
        let grabbed = Command::new("ffmpeg")
            .args(["-loglevel", "error", "-y", "-f", "x11grab", "-video_size", &format!("{width}x{height}")])
            .args(["-i", &self.name, "-frames:v", "1"])
            .arg(&shot)
            .status();
        grabbed.expect("ffmpeg is installed (on Debian or Ubuntu: apt-get install ffmpeg)").success().then_some(())?;
        Some(image::open(shot).expect("ffmpeg wrote a picture").into_rgb8())
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

impl Drop for VirtualDisplay {
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
