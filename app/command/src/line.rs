//! The command line as a whole: subcommands, help, mistakes.

use std::ffi::OsString;
use std::path::PathBuf;

use clap::parser::ValueSource;
use clap::{Args, CommandFactory, FromArgMatches, Parser, Subcommand};
use input::{TrackerUrl, TrainerUrl};
use thiserror::Error;

use super::measure::MeasureOptions;
use super::render::RenderOptions;
use super::ride::{HEADSET, RideOptions};
use super::values;
use super::world::ReadingOptions;

/// Move through a world in which light is slow, and see it as it would really look.
#[derive(Debug, Parser)]
#[command(name = "rapidity", bin_name = "rapidity", version, arg_required_else_help = true, max_term_width = 100)]
pub(super) struct Cli {
    #[command(subcommand)]
    command: Command,
}

/// Subcommand with its options.
#[derive(Clone, Debug, PartialEq, Subcommand)]
pub enum Command {
    /// Ride a bicycle, or fly, through the scene in a window.
    ///
    /// If none of --renderer, --tolerance, --edge, --transform and --map-scale is given, their values come from
    /// rapidity.toml in the user's configuration directory (~/.config/rapidity on Linux, or rapidity in
    /// XDG_CONFIG_HOME), if that file exists. `rapidity measure --budget` and `rapidity measure --tolerance` write
    /// it.
    Ride(Box<RideOptions>),
    /// Draw a still or a film, without a window.
    Render(Box<RenderOptions>),
    /// Measure how much accuracy each speed-up costs, on a scene and on this machine.
    ///
    /// Draws stills from places along a way, by each renderer at several settings (--edge, --transform, --tolerance,
    /// --map-scale). For each setting, it prints the time, in all and by stage; the memory on the graphics device;
    /// the errors of position in minutes of arc (the median, the value that 99 of 100 pixels keep to, and the
    /// largest); and the difference of colours from traced rays. More tables follow: samples, the shift table,
    /// integrators and precision. The old town takes about three minutes on two cores. Ctrl-C ends the measurement
    /// and keeps the results so far.
    ///
    /// With --budget or --tolerance, frames of a ride are measured instead, and the best setting is written to
    /// rapidity.toml in the user's configuration directory (~/.config/rapidity on Linux, or rapidity in
    /// XDG_CONFIG_HOME). `rapidity ride` uses it from then on.
    Measure(Box<MeasureOptions>),
    /// Write the built-in old town to a glTF file.
    Town(TownOptions),
    /// Answer questions about relativity: JSON Lines from standard input to standard output.
    ///
    /// A question is named by "ask" and has its own keys. Lengths and times are in metres, c = 1. A velocity is a
    /// "celerity" (gamma v/c) or a "beta" (v/c), of three numbers each. Questions: aberration {direction}, boost
    /// {event}, compose {vehicle, head}, apparent {observer, source}, eyes {observer, separation, right}, worldline
    /// {start, legs, step}, perceived {eyes, source, time}, and colour {spectrum: {planck: kelvin} or {sampled: [[nm,
    /// W/sr/m³], …]} or {rgb: [r, g, b]}, D: ν observed over ν emitted}, answered by xyz in cd/m² and linear sRGB.
    Probe,
    /// List the input devices that are plugged in, with live values.
    Devices(DevicesOptions),
    /// Check scenes, displays and recordings, and report their faults.
    Check(CheckOptions),
}

/// Options of `rapidity town`.
#[derive(Args, Clone, Debug, PartialEq)]
pub struct TownOptions {
    /// File to write (.glb).
    #[arg(long, value_name = "FILE.glb", value_parser = values::glb())]
    pub out: PathBuf,
}

/// Options of `rapidity devices`.
#[derive(Args, Clone, Debug, PartialEq)]
#[command(allow_negative_numbers = true)]
pub struct DevicesOptions {
    /// File that describes the rider's hardware, as for `rapidity ride`.
    #[arg(long, value_name = "FILE.toml")]
    pub set_up: Option<PathBuf>,
    /// Walk through the calibration of the bicycle, step by step, and write this set-up file. What others wrote into
    /// the file stays.
    #[arg(long, value_name = "FILE.toml", conflicts_with_all = ["seconds", "trainer", "tracker", "sensor", "display"])]
    pub calibrate: Option<PathBuf>,
    /// Serial port of the instrumented bicycle, which is listed with the other devices.
    #[arg(long, value_name = "PORT")]
    pub bicycle: Option<String>,
    /// Trainer over the network, which is listed with the other devices: tcp://HOST or tcp://HOST:PORT.
    #[arg(long, value_name = "URL")]
    pub trainer: Option<TrainerUrl>,
    /// Tracker of the head: vrpn://HOST/DEVICE, dtrack://:5000, opentrack://:4242 or openxr://. All
    /// that it sends is listed, also what no ride uses, with the reason of the last message that could not be read.
    #[arg(long, value_name = "URL")]
    pub tracker: Option<TrackerUrl>,
    /// Number of the tracker's sensor, or body, that is on the head [default: 0, or that of the display].
    #[arg(long, value_name = "N", allow_hyphen_values = true)]
    pub sensor: Option<i32>,
    /// Display whose table `[tracker]` says how the head is tracked: its tracker, unless --tracker names another, its
    /// unit, mirrors and placements.
    #[arg(long, value_name = "DISPLAY")]
    pub display: Option<String>,
    /// Time for which devices are watched, seconds [default: until Ctrl-C].
    #[arg(long, value_name = "N", value_parser = values::positive)]
    pub seconds: Option<f64>,
}

/// Options of `rapidity check`.
#[derive(Args, Clone, Debug, PartialEq)]
pub struct CheckOptions {
    /// Scenes (.gltf, .glb), panoramas (.png, .jpg, .webp, .tif, .hdr, .exr), displays, which describe rooms with
    /// screens (.toml of this program, .mpcdi or .mpcdi.xml of projector calibrations, .pvx of ParaView, .ndisplay of
    /// Unreal Engine), and recordings (.mcap).
    #[arg(value_name = "FILE", required = true)]
    pub files: Vec<PathBuf>,
    /// Print one JSON object per file instead of text.
    #[arg(long)]
    pub json: bool,
    /// Options of reading the files.
    #[command(flatten)]
    pub reading: ReadingOptions,
}

/// Reason why there is no command to run.
#[derive(Debug, Error)]
pub enum Stop {
    /// Help or version that was asked for, with its text.
    #[error("{}", .0.render())]
    Help(clap::Error),
    /// Mistake in the command line, with a sentence that says where it is.
    #[error("{0}")]
    Usage(String),
}

/// Reads a command line, the program's name first.
///
/// # Errors
/// [`Stop::Help`] if only help was asked for. [`Stop::Usage`] if an option is unknown, out of range, or contradicts
/// another.
pub fn parse_from(arguments: impl IntoIterator<Item = impl Into<OsString> + Clone>) -> Result<Command, Stop> {
    let matches = Cli::command().try_get_matches_from(arguments).map_err(stop)?;
    let Cli { mut command } = Cli::from_arg_matches(&matches).map_err(stop)?;
    if let Some((_, matches)) = matches.subcommand() {
        let given = |id: &&str| matches.value_source(id) == Some(ValueSource::CommandLine);
        let picture = || ["effects", "fov", "exposure", "tone", "gamut"].iter().any(given);
        match &mut command {
            Command::Ride(options) => {
                let drawing = ["renderer", "tolerance", "edge", "transform", "map_scale"];
                options.drawing_is_given = drawing.iter().any(given);
                options.picture.is_given = picture();
                if options.headset {
                    options.display = Some(HEADSET.to_owned());
                }
            }
            Command::Render(options) => {
                options.picture.is_given = picture();
                options.complete(given(&"size"));
            }
            _ => {}
        }
    }
    match &command {
        Command::Ride(options) => options.check(),
        Command::Render(options) => options.check(),
        Command::Measure(_) | Command::Town(_) | Command::Probe | Command::Devices(_) | Command::Check(_) => Ok(()),
    }
    .map_err(Stop::Usage)?;
    Ok(command)
}

/// Separates help from mistakes, and turns clap's paragraphs about a mistake into one sentence.
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
