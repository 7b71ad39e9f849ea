//! Films: pictures are written one after another through a pipe into ffmpeg, or without ffmpeg into numbered PNG
//! files.
//!
//! A separate thread writes, so that encoding a frame and drawing the next overlap. A short channel between the
//! threads bounds the memory.

use super::codec::{self, FilmCodec, HdrCurve};
use super::files::{WriteError, save, temporary, whole};
use super::spherical::{self, SphericalTags};
use crossbeam_channel::{Sender, bounded};
use image::DynamicImage;
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, Command, Stdio};
use std::thread::JoinHandle;
use thiserror::Error;

/// Pixels of frames with 16 bits a colour, in this machine's order of bytes.
const DEEP_PIXELS: &str = if cfg!(target_endian = "little") { "rgb48le" } else { "rgb48be" };
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
    /// An encoder that is there and cannot be started.
    #[error(
        "ffmpeg cannot be started: {reason}; mend or reinstall it, or take it off the PATH to get numbered pictures \
         instead of a film"
    )]
    Start {
        /// Reason, as the operating system words it.
        reason: String,
    },
    /// An encoder that was ended from outside.
    #[error(
        "ffmpeg was ended by signal {signal} before {path} was whole, perhaps because memory was short; film again, \
         or with a smaller --size"
    )]
    Killed {
        /// Path of the film.
        path: PathBuf,
        /// Number of the signal.
        signal: i32,
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

/// Form of a film's file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FilmForm {
    /// FilmCodec of its pictures.
    pub codec: FilmCodec,
    /// Signal of a high dynamic range: its frames have 16 bits a colour then; `None` for sRGB with 8 bits.
    pub hdr: Option<HdrCurve>,
    /// What players are told of its projection; `None` for a flat film of one eye.
    pub tags: Option<SphericalTags>,
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
    frames: Sender<DynamicImage>,
    writer: JoinHandle<Result<Written, FilmError>>,
}

impl Film {
    /// Creates a film of `size` pixels at `frames_per_second`.
    ///
    /// # Errors
    /// [`FilmError::Start`] if ffmpeg is there and cannot be started, [`FilmError::Write`] if there is none and no
    /// folder for pictures can be created.
    pub fn create(path: &Path, size: [u32; 2], frames_per_second: f64, form: FilmForm) -> Result<Self, FilmError> {
        let mut sink = Sink::open(path, size, frames_per_second, form)?;
        let (frames, queue) = bounded::<DynamicImage>(WAITING_FRAMES);
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
    pub fn add(&self, frame: impl Into<DynamicImage>) -> bool {
        self.frames.send(frame.into()).is_ok()
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
    Encoder(FilmEncoder),
    Pictures { folder: PathBuf, count: usize },
}

impl Sink {
    fn open(path: &Path, size: [u32; 2], frames_per_second: f64, form: FilmForm) -> Result<Self, FilmError> {
        match FilmEncoder::start(path, size, frames_per_second, form) {
            Ok(encoder) => Ok(Self::Encoder(encoder)),
            Err(error) if error.kind() == io::ErrorKind::NotFound => {
                let folder = path.with_extension("frames");
                let ready = std::fs::create_dir_all(&folder).and_then(|()| remove_pictures(&folder));
                ready.map_err(|error| FilmError::Write { path: folder.clone(), reason: error.to_string() })?;
                Ok(Self::Pictures { folder, count: 0 })
            }
            Err(error) => Err(FilmError::Start { reason: error.to_string() }),
        }
    }

    fn write(&mut self, frame: &DynamicImage) -> Result<(), FilmError> {
        match self {
            Self::Encoder(encoder) => encoder.write(frame),
            Self::Pictures { folder, count } => {
                let WriteError { path, reason } = match save(frame.clone(), &folder.join(format!("{count:06}.png"))) {
                    Ok(()) => {
                        *count += 1;
                        return Ok(());
                    }
                    Err(error) => error,
                };
                Err(FilmError::Write { path, reason })
            }
        }
    }

    fn finish(self) -> Result<Written, FilmError> {
        match self {
            Self::Encoder(encoder) => encoder.finish(),
            Self::Pictures { folder, .. } if folder.is_dir() => Ok(Written::Pictures(folder)),
            Self::Pictures { folder, .. } => {
                Err(FilmError::Write { path: folder, reason: "the folder was removed meanwhile".to_owned() })
            }
        }
    }
}

/// Arguments of ffmpeg for the pixels: even sides, which players need where they share colours among four pixels, and
/// the colours of high-definition video, by name, so that every player shows the same.
fn pixels(form: FilmForm) -> Vec<String> {
    let curve = match form.hdr {
        None => "bt709",
        Some(HdrCurve::Pq) => "smpte2084",
        Some(HdrCurve::Hlg) => "arib-std-b67",
    };
    let primaries = if form.hdr.is_some() { "bt2020" } else { "bt709" };
    let named = ["-color_primaries", primaries, "-color_trc", curve];
    if form.codec.keeps_rgb() {
        return named.map(str::to_owned).to_vec();
    }
    let (scaled, matrix) = if form.hdr.is_some() { ("bt2020", "bt2020nc") } else { ("bt709", "bt709") };
    // Some encoders believe what the command says of the colours, others what the pictures say.
    let filter = format!(
        "pad=ceil(iw/2)*2:ceil(ih/2)*2,scale=out_color_matrix={scaled}:out_range=tv,\
         setparams=range=tv:color_primaries={primaries}:color_trc={curve}:colorspace={matrix}"
    );
    let named = named.into_iter().chain(["-colorspace", matrix, "-color_range", "tv"]).map(str::to_owned);
    ["-vf".to_owned(), filter].into_iter().chain(named).collect()
}

/// Removes the numbered pictures of an earlier film, which a shorter one would end with.
fn remove_pictures(folder: &Path) -> io::Result<()> {
    for entry in std::fs::read_dir(folder)? {
        let path = entry?.path();
        let is_number = |stem: &str| stem.len() >= 6 && stem.bytes().all(|byte| byte.is_ascii_digit());
        let is_ours = path.extension().is_some_and(|extension| extension == "png")
            && path.file_stem().and_then(|stem| stem.to_str()).is_some_and(is_number);
        if is_ours {
            std::fs::remove_file(&path)?;
        }
    }
    Ok(())
}

/// Running ffmpeg. It writes under a temporary name, and the film gets its name once it is whole.
struct FilmEncoder {
    child: Child,
    /// Pipe of the frames; closed at the end.
    input: Option<ChildStdin>,
    path: PathBuf,
    temporary: PathBuf,
    tags: Option<SphericalTags>,
}

impl FilmEncoder {
    fn start(path: &Path, size: [u32; 2], frames_per_second: f64, form: FilmForm) -> io::Result<Self> {
        let temporary = temporary(path);
        let mut encoder = Command::new("ffmpeg");
        // The encoder gets its own process group, so that Ctrl-C on the terminal does not end it before it has
        // written all frames.
        #[cfg(unix)]
        std::os::unix::process::CommandExt::process_group(&mut encoder, 0);
        let mut child = encoder
            .args(["-y", "-loglevel", "error", "-f", "rawvideo"])
            .args(["-pixel_format", if form.hdr.is_some() { DEEP_PIXELS } else { "rgba" }])
            .args(["-video_size", &format!("{}x{}", size[0], size[1])])
            .args(["-framerate", &frames_per_second.to_string(), "-i", "-"])
            .args(pixels(form))
            .args(form.codec.arguments(form.hdr.is_some()))
            .args(if codec::is_indexed(path) { ["-movflags", "+faststart"].as_slice() } else { &[] })
            .arg(&temporary)
            .stdin(Stdio::piped())
            .stdout(Stdio::null())
            .stderr(Stdio::piped())
            .spawn()?;
        let input = child.stdin.take();
        Ok(Self { child, input, path: path.to_owned(), temporary, tags: form.tags })
    }

    fn write(&mut self, frame: &DynamicImage) -> Result<(), FilmError> {
        let Some(input) = &mut self.input else { return Ok(()) };
        match input.write_all(frame.as_bytes()) {
            Ok(()) => Ok(()),
            // The encoder has ended too early, and says why.
            Err(error) => Err(self.end().err().unwrap_or_else(|| self.failed(error.to_string()))),
        }
    }

    /// Waits for the encoder to end.
    fn end(&mut self) -> Result<(), FilmError> {
        self.input = None;
        let words = self.last_words();
        let status = self.child.wait().map_err(|error| self.failed(error.to_string()))?;
        #[cfg(unix)]
        if let Some(signal) = std::os::unix::process::ExitStatusExt::signal(&status) {
            return Err(FilmError::Killed { path: self.path.clone(), signal });
        }
        if status.success() { Ok(()) } else { Err(self.failed(words.unwrap_or_else(|| status.to_string()))) }
    }

    fn finish(mut self) -> Result<Written, FilmError> {
        self.end()?;
        if let Some(tags) = self.tags {
            // The tagged film takes the place of the one without.
            let tagged = whole(&self.temporary, |tagged| spherical::tag(&self.temporary, tagged, &tags));
            tagged.map_err(|error| FilmError::Write { path: self.path.clone(), reason: error.to_string() })?;
        }
        match std::fs::rename(&self.temporary, &self.path) {
            Ok(()) => Ok(Written::Film(self.path.clone())),
            Err(error) => Err(FilmError::Write { path: self.path.clone(), reason: error.to_string() }),
        }
    }

    fn failed(&self, reason: String) -> FilmError {
        FilmError::Encoder { path: self.path.clone(), reason }
    }

    /// Last line of the encoder's messages.
    fn last_words(&mut self) -> Option<String> {
        let mut words = String::new();
        self.child.stderr.take()?.read_to_string(&mut words).ok()?;
        let named = |line: &str| line.replace(&*self.temporary.to_string_lossy(), &self.path.to_string_lossy());
        words.lines().last().map(named)
    }
}

impl Drop for FilmEncoder {
    /// Removes what is not whole.
    fn drop(&mut self) {
        self.input = None;
        let _ = self.child.wait();
        let _ = std::fs::remove_file(&self.temporary);
    }
}
