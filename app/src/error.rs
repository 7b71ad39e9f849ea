//! What can go wrong in the program as a whole. Every part has an error of its own; here they meet, so that `main`
//! reports once.

use crate::output::files::WriteError;
use crate::output::film::FilmError;
use crate::session::preferences::PreferencesError;
use crate::session::scenes::SceneError;
use crate::session::tracker::TrackerError;
use measure::MeasureError;
use measure::choice::ChoiceError;
use measure::extremes::ExtremesError;
use measure::plot::PlotError;
use physics::photo_surface::PhotoSurfaceError;
use render::GpuError;
use ride::{LightSpeedError, LogError, ReplayError, SetupError};
use room::{DisplayError, EyeBehind};
use scene::SceneFault;
use scene::refine::RefineError;
use scene_files::check::CheckError;
use scene_files::export::ExportError;
use std::path::PathBuf;
use thiserror::Error;

/// One sentence: what was wrong, where, and what to do.
#[derive(Debug, Error)]
pub enum Error {
    /// Nothing to draw with.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// No plot.
    #[error(transparent)]
    Plot(#[from] PlotError),
    /// No setting for a goal.
    #[error(transparent)]
    Choice(#[from] ChoiceError),
    /// No use of the user's preferences.
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
    /// No film.
    #[error(transparent)]
    Film(#[from] FilmError),
    /// No display.
    #[error(transparent)]
    Display(#[from] DisplayError),
    /// An eye that sees the back of a screen.
    #[error("channel {channel}: {behind}")]
    EyeBehind {
        /// Its name.
        channel: String,
        /// Where the eye is.
        behind: EyeBehind,
    },
    /// A tracker that cannot be used.
    #[error(transparent)]
    Tracker(#[from] TrackerError),
    /// A room without a graphical session.
    #[error(
        "--display needs windows, and there is no graphical session to open them in; draw stills with `rapidity render --display`"
    )]
    NoWindows,
    /// Rays for a room.
    #[error("--renderer raytrace does not draw for --display; leave one out, or choose auto, polygon or image")]
    WallsByRays,
    /// No scene.
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
    /// Too fine.
    #[error(transparent)]
    Refine(#[from] RefineError),
    /// An observer or a scene that is nowhere.
    #[error(transparent)]
    PhotoSurface(#[from] PhotoSurfaceError),
    /// A recording that cannot be made or read.
    #[error(transparent)]
    Recording(#[from] input::recording::RecordingError),
    /// A ride that cannot begin.
    #[error(transparent)]
    Setup(#[from] SetupError),
    /// A recorded ride that is not the same.
    #[error(transparent)]
    Replay(#[from] ReplayError),
    /// A speed of light that is none.
    #[error(transparent)]
    World(#[from] LightSpeedError),
    /// Devices that cannot be read.
    #[error(transparent)]
    Devices(#[from] input::devices::DevicesError),
    /// Device settings that cannot be used.
    #[error(transparent)]
    Desk(#[from] input::ConfigError),
    /// Files that `rapidity check` found fault with.
    #[error("{bad} of {files} files are not good")]
    Checked {
        /// How many.
        bad: usize,
        /// Of how many.
        files: usize,
    },
    /// A file that nothing here reads.
    #[error("{}: neither a scene (.gltf, .glb), a panorama (.png, .jpg, .hdr, .exr), a display (.toml, .pvx, .mpcdi) nor a recording (.mcap)", path.display())]
    UnknownKind {
        /// The file.
        path: PathBuf,
    },
    /// A recording without a single frame.
    #[error("the recording ends before its first frame: there is nothing to show")]
    NothingRidden,
    /// Ctrl-C before there was anything to keep.
    #[error("interrupted before anything was traced, so nothing was written")]
    Interrupted,
    /// No window.
    #[error("no window could be opened ({0}); to film the ride instead, name a file with --out")]
    Window(String),
    /// The terminal or the pipe that is written to is gone.
    #[error("the output cannot be written: {0}")]
    Output(#[from] std::io::Error),
    /// A file that cannot be written.
    #[error(transparent)]
    Write(#[from] WriteError),
    /// More pixels than the device can draw.
    #[error("--size {}x{} is too large for this graphics device, which draws up to {limit} pixels a side", size[0], size[1])]
    TooLarge {
        /// As asked.
        size: [u32; 2],
        /// As the device says.
        limit: u32,
    },
}
