//! The command line: what can be asked of the program, checked once and typed for good.
//!
//! Each subcommand is one plain struct of options. An option's text is turned into its type while it is parsed
//! (`values`), by a parser whose refusal says what was expected, so that the rest of the program reads metres,
//! celerities and paths and checks nothing again. Rules between options stand beside the options: clap knows
//! the simple ones (`conflicts_with`, `requires`), a struct's `check` the others.
//!
//! ```
//! use rapidity::command::{Command, parse_from};
//! let Ok(Command::Render(options)) = parse_from(["rapidity", "render", "--beta", "0,0,-0.6", "--out", "street.png"])
//! else { panic!() };
//! assert_eq!(options.viewpoint.celerity().gamma(), 1.25);
//! ```

use std::ffi::OsString;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Args, CommandFactory, FromArgMatches, Parser, Subcommand};
use input::TrackerUrl;
use thiserror::Error;

mod measure;
mod picture;
mod render;
mod ride;
mod values;
mod world;

pub use measure::MeasureOptions;
pub use picture::{PictureOptions, Renderer};
pub use render::{RenderOptions, Viewpoint};
pub use ride::{DeviceOptions, Latency, RideOptions, VehicleName, VehicleOptions};
pub use values::{Output, ValueError};
pub use world::{SceneChoice, WorldOptions};

/// Move through a world in which light is slow, and see it as that observer would.
#[derive(Debug, Parser)]
#[command(name = "rapidity", bin_name = "rapidity", version, arg_required_else_help = true, max_term_width = 100)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

/// What the program is asked to do.
#[derive(Clone, Debug, PartialEq, Subcommand)]
pub enum Command {
    /// Ride a bicycle, or fly, through the scene in a window.
    Ride(Box<RideOptions>),
    /// Draw a still or a film, without a window.
    Render(Box<RenderOptions>),
    /// Measure what each speed-up costs in error, on a scene and on this machine.
    Measure(Box<MeasureOptions>),
    /// Write the built-in old town to a glTF file.
    Town(TownOptions),
    /// Answer questions about relativity: JSON Lines from standard input to standard output.
    ///
    /// A question names itself by "ask" and gives its keys; lengths and times are in metres, c = 1, velocities are a "celerity" (gamma v/c) or
    /// a "beta" (v/c), of three numbers each. Questions: aberration {direction}, boost {event}, compose {vehicle, head}, apparent {observer,
    /// source}, eyes {observer, separation, right}, worldline {start, legs, step}, perceived {eyes, source, time}, and
    /// colour {spectrum: {planck: kelvin} or {sampled: [[nm, W/sr/m³], …]} or {rgb: [r, g, b]}, D: ν observed over ν emitted},
    /// answered by xyz in cd/m² and linear sRGB.
    Probe,
    /// List the input devices that are plugged in, with live values.
    Devices(DevicesOptions),
    /// Say whether scenes and recordings are good, and what is wrong with them.
    Check(CheckOptions),
}

/// `rapidity town`.
#[derive(Args, Clone, Debug, PartialEq)]
pub struct TownOptions {
    /// The file to write (.glb).
    #[arg(long, value_name = "FILE.glb", value_parser = values::glb())]
    pub out: PathBuf,
}

/// `rapidity devices`.
#[derive(Args, Clone, Debug, PartialEq)]
#[command(allow_negative_numbers = true)]
pub struct DevicesOptions {
    /// The serial port of the instrumented bicycle, to be listed with the others.
    #[arg(long, value_name = "PORT")]
    pub bicycle: Option<String>,
    /// The tracker of the head, likewise: vrpn://HOST/DEVICE or dtrack://:5000.
    #[arg(long, value_name = "URL")]
    pub tracker: Option<TrackerUrl>,
    /// How long to watch, in seconds [default: until Ctrl-C].
    #[arg(long, value_name = "N", value_parser = values::positive)]
    pub seconds: Option<f64>,
}

/// `rapidity check`.
#[derive(Args, Clone, Debug, PartialEq)]
pub struct CheckOptions {
    /// Scenes (.gltf, .glb), panoramas (.png, .jpg, .hdr, .exr) and recordings (.mcap).
    #[arg(value_name = "FILE", required = true)]
    pub files: Vec<PathBuf>,
}

/// Why there is no command to run.
#[derive(Debug, Error)]
pub enum Stop {
    /// Help or the version was asked for; the text to show.
    #[error("{}", .0.render())]
    Help(clap::Error),
    /// The command line is wrong; a sentence that says where.
    #[error("{0}")]
    Usage(String),
}

impl Stop {
    /// Exit status of a wrong command line.
    const USAGE: u8 = 2;

    /// Tells the user, and says with which status to exit: 0 for help that was asked for, 2 for a mistake.
    pub fn report(&self) -> ExitCode {
        match self {
            Self::Help(text) => match text.print() {
                Ok(()) if !text.use_stderr() => ExitCode::SUCCESS,
                _ => ExitCode::from(Self::USAGE),
            },
            Self::Usage(sentence) => {
                eprintln!("rapidity: {sentence}");
                ExitCode::from(Self::USAGE)
            }
        }
    }
}

/// Reads this process's command line.
///
/// # Errors
/// The exit status, once help has been shown or the mistake told.
pub fn parse() -> Result<Command, ExitCode> {
    parse_from(std::env::args_os()).map_err(|stop| stop.report())
}

/// Reads a command line, the program's name first.
///
/// # Errors
/// [`Stop::Help`] if only help was asked for, [`Stop::Usage`] if an option is unknown, out of range, or against another.
pub fn parse_from(arguments: impl IntoIterator<Item = impl Into<OsString> + Clone>) -> Result<Command, Stop> {
    let matches = Cli::command().try_get_matches_from(arguments).map_err(stop)?;
    let Cli { command } = Cli::from_arg_matches(&matches).map_err(stop)?;
    match &command {
        Command::Ride(options) => options.check(),
        Command::Render(options) => options.check(),
        Command::Measure(_) | Command::Town(_) | Command::Probe | Command::Devices(_) | Command::Check(_) => Ok(()),
    }
    .map_err(Stop::Usage)?;
    Ok(command)
}

/// Tells help from mistakes, and turns clap's paragraphs about a mistake into one sentence.
fn stop(error: clap::Error) -> Stop {
    use clap::error::ErrorKind;
    match error.kind() {
        ErrorKind::DisplayHelp | ErrorKind::DisplayVersion | ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand => {
            return Stop::Help(error);
        }
        _ => {}
    }
    let text = error.render().to_string();
    let paragraphs = text.trim_start_matches("error: ").split("\n\n");
    let told = paragraphs
        .filter(|paragraph| !paragraph.starts_with("Usage:") && !paragraph.starts_with("For more information"))
        .map(|paragraph| paragraph.split_whitespace().collect::<Vec<_>>().join(" "))
        .filter(|paragraph| !paragraph.is_empty());
    Stop::Usage(told.collect::<Vec<_>>().join("; "))
}

#[cfg(test)]
mod tests;
