//! Errors of the program as a whole. Every part has an error of its own; here they meet, so that `main` reports once.

use crate::commands::calibrating_error::CalibratingError;
use crate::session::preferences::PreferencesError;
use crate::session::scenes::SceneError;
use camera_paths::CameraPathError;
use filming::{MakerError, SinkError};
use hardware::{SetUpError, TrackerError};
use headset::HeadsetError;
use kiosk::DayLogError;
use measure::MeasureError;
use measure::choice::ChoiceError;
use measure::extremes::ExtremesError;
use physics::photo_surface::PhotoSurfaceError;
use picture_files::PartError;
use picture_files::files::WriteError;
use picture_files::film::FilmError;
use render::GpuError;
use ride::{LightSpeedError, LogError, ReplayError, SetupError};
use room::{DisplayError, EyeBehind};
use scene::SceneFault;
use scene::refine::RefineError;
use scene_files::check::CheckError;
use scene_files::export::ExportError;
use std::path::PathBuf;
use thiserror::Error;
use tours::{PlayError, TourError};

/// Error as one sentence: the fault, its place, and the remedy.
#[derive(Debug, Error)]
pub enum Error {
    /// A graphics device that is missing or lost.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// A headset that cannot be used.
    #[error(transparent)]
    Headset(#[from] HeadsetError),
    /// A goal that no setting reaches.
    #[error(transparent)]
    Choice(#[from] ChoiceError),
    /// A tour that cannot be read.
    #[error(transparent)]
    Tour(#[from] TourError),
    /// A tour that cannot be ridden.
    #[error(transparent)]
    Play(#[from] PlayError),
    /// Preferences of the user that cannot be read or written.
    #[error(transparent)]
    Preferences(#[from] PreferencesError),
    /// A measurement that cannot be made.
    #[error(transparent)]
    Measure(#[from] MeasureError),
    /// A ride that is not recorded.
    #[error(transparent)]
    Log(#[from] LogError),
    /// Physics less exact than promised.
    #[error(transparent)]
    Extremes(#[from] ExtremesError),
    /// A film that cannot be written.
    #[error(transparent)]
    Film(#[from] FilmError),
    /// Pictures that cannot be written.
    #[error(transparent)]
    Sink(#[from] SinkError),
    /// A display that cannot be used.
    #[error(transparent)]
    Display(#[from] DisplayError),
    /// An eye that sees the back of a screen.
    #[error("channel {channel}: {behind}")]
    EyeBehind {
        /// Name of the channel.
        channel: String,
        /// Position of the eye behind the screen.
        behind: EyeBehind,
    },
    /// A calibration of a bicycle that ends without a file.
    #[error(transparent)]
    Calibrating(#[from] CalibratingError),
    /// A set-up of hardware that cannot be used.
    #[error(transparent)]
    SetUp(#[from] SetUpError),
    /// A tracker that cannot be used.
    #[error(transparent)]
    Tracker(#[from] TrackerError),
    /// A room without a graphical session for its windows.
    #[error(
        "--display needs windows, and there is no graphical session to open them in; draw stills with `rapidity render --display`"
    )]
    NoWindows,
    /// A film of a tour that shows a recording.
    #[error("a tour of a recording is shown in a window: leave --out out, or film the recording with render --replay")]
    TourOfRecording,
    /// A kiosk without a graphical session for its window.
    #[error("--kiosk needs a window, and there is no graphical session to open it in: set DISPLAY or WAYLAND_DISPLAY")]
    KioskWithoutWindows,
    /// A kiosk's log that cannot be written.
    #[error(transparent)]
    DayLog(#[from] DayLogError),
    /// The ray tracer, asked to draw for a room.
    #[error("--renderer raytrace does not draw for --display; leave one out, or choose auto, polygon or image")]
    WallsByRays,
    /// A scene that cannot be loaded.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A scene with a flaw.
    #[error(transparent)]
    Flawed(#[from] SceneFault),
    /// A scene that `rapidity check` refuses.
    #[error(transparent)]
    Check(#[from] CheckError),
    /// A file that could not be exported.
    #[error(transparent)]
    Export(#[from] ExportError),
    /// Edges so short that the scene would have too many triangles.
    #[error(transparent)]
    Refine(#[from] RefineError),
    /// A scene or an observer whose place is not finite.
    #[error(transparent)]
    PhotoSurface(#[from] PhotoSurfaceError),
    /// A recording that cannot be made or read.
    #[error(transparent)]
    Recording(#[from] input::recording::RecordingError),
    /// A ride that cannot begin.
    #[error(transparent)]
    Setup(#[from] SetupError),
    /// A recorded ride that cannot be replayed, or differs.
    #[error(transparent)]
    Replay(#[from] ReplayError),
    /// A speed of light out of range.
    #[error(transparent)]
    World(#[from] LightSpeedError),
    /// Devices that cannot be read.
    #[error(transparent)]
    Devices(#[from] input::devices::DevicesError),
    /// Device settings that cannot be used.
    #[error(transparent)]
    Desk(#[from] input::ConfigError),
    /// Files in which `rapidity check` found a fault.
    #[error("{bad} of {files} files are not good")]
    Checked {
        /// Number of faulty files.
        bad: usize,
        /// Number of checked files.
        files: usize,
    },
    /// A file of a kind that the program does not read.
    #[error("{}: neither a scene (.gltf, .glb), a panorama (.png, .jpg, .webp, .tif, .hdr, .exr), a display ({}) nor a recording (.mcap)", path.display(), room::FILE_ENDINGS)]
    UnknownKind {
        /// Path of the file.
        path: PathBuf,
    },
    /// A recording without a single frame.
    #[error("the recording ends before its first frame: there is nothing to show")]
    NothingRidden,
    /// A film that ended before it was whole.
    #[error("the film was cut short: {done} of {count} pictures are there")]
    CutShort {
        /// Number of pictures that are there.
        done: u64,
        /// Number of pictures of the whole film.
        count: u64,
    },
    /// A number beyond the end of a recorded ride.
    #[error("--frames: the recording has {count} pictures, 0 to {}, and none of number {number}; name others, or change --fps", count.saturating_sub(1))]
    BeyondFilm {
        /// Number that was asked for.
        number: u64,
        /// Number of pictures.
        count: u64,
    },
    /// A camera path that cannot be flown.
    #[error(transparent)]
    Path(#[from] CameraPathError),
    /// A scene none of whose cameras moves, or not the one that was named.
    #[error("--path camera: {scene} has no animated camera of that name; `rapidity check` lists its cameras")]
    NoMovingCamera {
        /// Name of the scene.
        scene: String,
    },
    /// A part of a farm that the environment does not name.
    #[error(transparent)]
    Part(#[from] PartError),
    /// An interruption by Ctrl-C before there was anything to keep.
    #[error("interrupted before anything was traced, so nothing was written")]
    Interrupted,
    /// A window that cannot be opened.
    #[error("no window could be opened ({0}); to film the ride instead, name a file with --out")]
    Window(String),
    /// A window that was lost during the ride.
    #[error("the windows were lost: the display server has ended or closed them; what was recorded until then is kept")]
    WindowLost,
    /// A terminal or a pipe that is gone.
    #[error("the output cannot be written: {0}")]
    Output(#[from] std::io::Error),
    /// A file that cannot be written.
    #[error(transparent)]
    Write(#[from] WriteError),
    /// A picture with more pixels than the device can draw.
    #[error("--size {}x{} is too large for this graphics device, which draws up to {limit} pixels a side", size[0], size[1])]
    TooLarge {
        /// Requested width and height, pixels.
        size: [u32; 2],
        /// Largest side that the device draws, pixels.
        limit: u32,
    },
}

impl From<MakerError> for Error {
    fn from(error: MakerError) -> Self {
        match error {
            MakerError::Gpu(error) => Self::Gpu(error),
            MakerError::Interrupted => Self::Interrupted,
        }
    }
}
