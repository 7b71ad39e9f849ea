//! Films: pictures are written one after another through a pipe into ffmpeg, or without ffmpeg into numbered PNG
//! files.
//!
//! A separate thread writes, so that encoding a frame and drawing the next overlap. A short channel between the
//! threads bounds the memory.

use crossbeam_channel::{Sender, bounded};
use image::RgbaImage;
use std::io::{Read, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, Command, Stdio};
use std::thread::JoinHandle;
use thiserror::Error;

/// Number of frames that may wait for the encoder.
const WAITING_FRAMES: usize = 3;

/// Reason why a film could not be written.
#[derive(Debug, Error)]
pub enum FilmError {
    /// A file or folder that could not be written.
    #[error("{path}: could not be written: {reason}; choose another place")]
    Write {
        /// Path of the file or folder.
        path: PathBuf,
        /// Reason, as the operating system words it.
        reason: String,
    },
    /// An encoder that stopped with an error.
    #[error("ffmpeg could not write {path}: {reason}")]
    Encoder {
        /// Path of the film.
        path: PathBuf,
        /// Last line of ffmpeg's messages.
        reason: String,
    },
}

/// Result of writing a film.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Written {
    /// A film file.
    Film(PathBuf),
    /// A folder of numbered PNG files, because ffmpeg is not installed.
    Pictures(PathBuf),
}

/// Film that is being written.
pub struct Film {
    frames: Sender<RgbaImage>,
    writer: JoinHandle<Result<Written, FilmError>>,
}

impl Film {
    /// Creates a film of `size` pixels at `frames_per_second`.
    ///
    /// # Errors
    /// [`FilmError::Write`] if neither ffmpeg can be started nor a folder for pictures created.
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

    /// Adds a frame. Returns false once the encoder has stopped; [`Film::finish`] then gives the reason.
    pub fn add(&self, frame: RgbaImage) -> bool {
        self.frames.send(frame).is_ok()
    }

    /// Waits until the last frame is written, and returns the file or folder.
    ///
    /// # Errors
    /// [`FilmError`] of the encoder or the disk.
    pub fn finish(self) -> Result<Written, FilmError> {
        drop(self.frames);
        self.writer.join().expect("the film thread returns its errors")
    }
}

/// Destination of the frames.
enum Sink {
    Encoder { child: Child, input: ChildStdin, path: PathBuf },
    Pictures { folder: PathBuf, count: usize },
}

impl Sink {
    fn open(path: &Path, size: [u32; 2], frames_per_second: f64) -> Result<Self, FilmError> {
        let failed =
            |path: &Path, error: std::io::Error| FilmError::Write { path: path.to_owned(), reason: error.to_string() };
        let mut encoder = Command::new("ffmpeg");
        // The encoder gets its own process group, so that Ctrl-C on the terminal does not end it before it has
        // written all frames.
        #[cfg(unix)]
        std::os::unix::process::CommandExt::process_group(&mut encoder, 0);
        let encoder = encoder
            .args(["-y", "-loglevel", "error", "-f", "rawvideo", "-pixel_format", "rgba"])
            .args(["-video_size", &format!("{}x{}", size[0], size[1])])
            .args(["-framerate", &frames_per_second.to_string(), "-i", "-"])
            // Common players need 4:2:0 colour, which needs even sides.
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

/// Last line of the encoder's messages. Waits for the encoder to end.
fn last_words(child: &mut Child) -> Option<String> {
    let mut words = String::new();
    child.stderr.take()?.read_to_string(&mut words).ok()?;
    words.lines().last().map(str::to_owned)
}
