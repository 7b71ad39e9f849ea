//! Pictures one after another into a film, through a pipe into ffmpeg; without ffmpeg, into numbered PNGs.
//!
//! A thread of its own writes, so that encoding a frame and drawing the next overlap; a short channel between
//! them bounds the memory.

use crossbeam_channel::{Sender, bounded};
use image::RgbaImage;
use std::io::{Read, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, Command, Stdio};
use std::thread::JoinHandle;
use thiserror::Error;

/// Frames that may wait for the encoder.
const WAITING_FRAMES: usize = 3;

/// Why a film could not be written.
#[derive(Debug, Error)]
pub enum FilmError {
    /// A file or folder would not be written.
    #[error("{path}: could not be written: {reason}; choose another place")]
    Write {
        /// What was to be written.
        path: PathBuf,
        /// As the system says it.
        reason: String,
    },
    /// The encoder ran and gave up.
    #[error("ffmpeg could not write {path}: {reason}")]
    Encoder {
        /// The film.
        path: PathBuf,
        /// ffmpeg's last line.
        reason: String,
    },
}

/// What became of the pictures.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Written {
    /// One film.
    Film(PathBuf),
    /// ffmpeg is not installed: a folder of numbered PNGs.
    Pictures(PathBuf),
}

/// A film being written.
pub struct Film {
    frames: Sender<RgbaImage>,
    writer: JoinHandle<Result<Written, FilmError>>,
}

impl Film {
    /// Begins a film of `size` pixels at `frames_per_second`.
    ///
    /// # Errors
    /// [`FilmError::Write`] if neither ffmpeg nor the folder for pictures can be had.
    pub fn create(path: &Path, size: [u32; 2], frames_per_second: f64) -> Result<Self, FilmError> {
        let mut sink = Sink::open(path, size, frames_per_second)?;
        let (frames, queue) = bounded::<RgbaImage>(WAITING_FRAMES);
        let writer = std::thread::Builder::new()
            .name("film".to_owned())
            .spawn(move || {
                for frame in queue {
                    sink.write(&frame)?;
                }
                sink.finish()
            })
            .map_err(|error| FilmError::Write { path: path.to_owned(), reason: error.to_string() })?;
        Ok(Self { frames, writer })
    }

    /// Adds a frame. Returns false once the encoder has stopped; [`Film::finish`] says why.
    pub fn add(&self, frame: RgbaImage) -> bool {
        self.frames.send(frame).is_ok()
    }

    /// Waits for the last frame to be written.
    ///
    /// # Errors
    /// What the encoder or the disk said.
    pub fn finish(self) -> Result<Written, FilmError> {
        drop(self.frames);
        self.writer.join().expect("the film thread returns its errors")
    }
}

/// Where frames go.
enum Sink {
    Encoder { child: Child, input: ChildStdin, path: PathBuf },
    Pictures { folder: PathBuf, count: usize },
}

impl Sink {
    fn open(path: &Path, size: [u32; 2], frames_per_second: f64) -> Result<Self, FilmError> {
        let failed =
            |path: &Path, error: std::io::Error| FilmError::Write { path: path.to_owned(), reason: error.to_string() };
        let mut encoder = Command::new("ffmpeg");
        // Ctrl-C on the terminal is for us: the encoder goes on to the end of what it is given.
        #[cfg(unix)]
        std::os::unix::process::CommandExt::process_group(&mut encoder, 0);
        let encoder = encoder
            .args(["-y", "-loglevel", "error", "-f", "rawvideo", "-pixel_format", "rgba"])
            .args(["-video_size", &format!("{}x{}", size[0], size[1])])
            .args(["-framerate", &frames_per_second.to_string(), "-i", "-"])
            // The usual players want 4:2:0, which wants even sides.
            .args(["-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-c:v", "libx264", "-preset", "veryfast"])
            .args(["-crf", "18", "-pix_fmt", "yuv420p", "-movflags", "+faststart"])
            .arg(path)
            .stdin(Stdio::piped())
            .stdout(Stdio::null())
            .stderr(Stdio::piped())
            .spawn();
        match encoder {
            Ok(mut child) => {
                let input = child.stdin.take().expect("standard input was asked for as a pipe");
                Ok(Self::Encoder { child, input, path: path.to_owned() })
            }
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => {
                let folder = path.with_extension("frames");
                std::fs::create_dir_all(&folder).map_err(|error| failed(&folder, error))?;
                Ok(Self::Pictures { folder, count: 0 })
            }
            Err(error) => Err(failed(path, error)),
        }
    }

    fn write(&mut self, frame: &RgbaImage) -> Result<(), FilmError> {
        match self {
            Self::Encoder { child, input, path } => input.write_all(frame).map_err(|error| FilmError::Encoder {
                path: path.clone(),
                reason: last_words(child).unwrap_or_else(|| error.to_string()),
            }),
            Self::Pictures { folder, count } => {
                let path = folder.join(format!("{count:06}.png"));
                *count += 1;
                frame.save(&path).map_err(|error| FilmError::Write { path, reason: error.to_string() })
            }
        }
    }

    fn finish(self) -> Result<Written, FilmError> {
        match self {
            Self::Encoder { mut child, input, path } => {
                drop(input);
                let words = last_words(&mut child);
                match child.wait() {
                    Ok(status) if status.success() => Ok(Written::Film(path)),
                    Ok(status) => Err(FilmError::Encoder { path, reason: words.unwrap_or_else(|| status.to_string()) }),
                    Err(error) => Err(FilmError::Encoder { path, reason: error.to_string() }),
                }
            }
            Self::Pictures { folder, .. } => Ok(Written::Pictures(folder)),
        }
    }
}

/// What the encoder said last, waiting for it to end.
fn last_words(child: &mut Child) -> Option<String> {
    let mut words = String::new();
    child.stderr.take()?.read_to_string(&mut words).ok()?;
    words.lines().last().map(str::to_owned)
}
