//! What can go wrong in the program as a whole. Every part has an error of its own; here they meet, so that `main`
//! reports once.

use crate::film::FilmError;
use crate::gpu::GpuError;
use crate::scene::refine::RefineError;
use crate::scene::source::LoadError;
use physics::photo_surface::PhotoSurfaceError;
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
    Plot(#[from] crate::measure::plot::PlotError),
    /// No setting for a goal.
    #[error(transparent)]
    Choice(#[from] crate::measure::choice::ChoiceError),
    /// No use of the user's preferences.
    #[error(transparent)]
    Preferences(#[from] crate::preferences::PreferencesError),
    /// A worldline that cannot be followed.
    #[error(transparent)]
    Worldline(#[from] physics::worldline::WorldlineError),
    /// Physics less exact than promised.
    #[error(transparent)]
    Extremes(#[from] crate::measure::extremes::ExtremesError),
    /// No film.
    #[error(transparent)]
    Film(#[from] FilmError),
    /// No display.
    #[error(transparent)]
    Display(#[from] crate::room::DisplayError),
    /// A display that cannot be drawn.
    #[error(transparent)]
    Walls(#[from] crate::walls::WallsError),
    /// An eye that sees the back of a screen.
    #[error("channel {channel}: {behind}")]
    EyeBehind {
        /// Its name.
        channel: String,
        /// Where the eye is.
        behind: crate::room::EyeBehind,
    },
    /// A tracker that cannot be used.
    #[error(transparent)]
    Tracker(#[from] crate::walls::tracker::TrackerError),
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
    Scene(#[from] LoadError),
    /// A scene with a flaw.
    #[error(transparent)]
    Flawed(#[from] crate::scene::SceneFault),
    /// A scene that `rapidity check` refuses.
    #[error(transparent)]
    Check(#[from] crate::scene::check::CheckError),
    /// A file that could not be exported.
    #[error(transparent)]
    Export(#[from] crate::scene::export::ExportError),
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
    Setup(#[from] crate::simulation::SetupError),
    /// A recorded ride that is not the same.
    #[error(transparent)]
    Replay(#[from] crate::simulation::ReplayError),
    /// A speed of light that is none.
    #[error(transparent)]
    World(#[from] crate::vehicle::WorldError),
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
    /// A ride too long to be recorded from its beginning.
    #[error("the ride so far is no longer remembered, so it cannot be recorded; start the program with --record FILE")]
    NotRemembered,
    /// Ctrl-C before there was anything to keep.
    #[error("interrupted before anything was traced, so nothing was written")]
    Interrupted,
    /// No window.
    #[error("no window could be opened ({0}); to film the ride instead, name a file with --out")]
    Window(String),
    /// The terminal or the pipe that is written to is gone.
    #[error("the output cannot be written: {0}")]
    Output(#[from] std::io::Error),
    /// A file that would not be written.
    #[error("{}: could not be written: {reason}; choose another place", path.display())]
    Write {
        /// What was to be written.
        path: PathBuf,
        /// As the system says it.
        reason: String,
    },
    /// More pixels than the device can draw.
    #[error("--size {}x{} is too large for this graphics device, which draws up to {limit} pixels a side", size[0], size[1])]
    TooLarge {
        /// As asked.
        size: [u32; 2],
        /// As the device says.
        limit: u32,
    },
}
