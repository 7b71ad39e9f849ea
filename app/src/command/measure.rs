//! `rapidity measure`: what each speed-up costs in error.

use std::fmt::{self, Display, Formatter};
use std::path::PathBuf;

use clap::Args;

use super::{SceneChoice, values, world};

/// What to measure.
#[derive(Args, Clone, Debug, PartialEq)]
#[command(allow_negative_numbers = true)]
pub struct MeasureOptions {
    /// Print instead, as ACCURACY.md, how far the physics is off at extreme speeds, distances and steps, against 180 digits: takes minutes.
    #[arg(long, conflicts_with_all = ["size", "poses", "rounds", "out", "plot", "scene", "speed_of_light", "replay", "budget", "tolerance"])]
    pub extremes: bool,
    /// Measure frames of a ride, and have rides drawn from now on with the least error that this time a frame allows in 95 of 100, as in 16.7ms.
    #[arg(long, value_name = "TIME", allow_hyphen_values = true, value_parser = values::milliseconds, conflicts_with = "tolerance")]
    pub budget: Option<f64>,
    /// Measure frames of a ride, and have rides drawn from now on as fast as an error of so many pixels in 99 of 100 allows, as in 1px.
    #[arg(long, value_name = "PIXELS", allow_hyphen_values = true, value_parser = values::pixels)]
    pub tolerance: Option<f64>,
    /// Width and height of the pictures, pixels [default: 640x360, for --budget and --tolerance 1280x720].
    #[arg(long, value_name = "WxH", value_parser = values::size)]
    pub size: Option<[u32; 2]>,
    /// Places along the way at which pictures are taken, 1 to 1000.
    #[arg(long, value_name = "N", default_value = "5", value_parser = clap::value_parser!(u32).range(1..=1000))]
    pub poses: u32,
    /// How often each picture is timed, 1 to 1000; of a ride, how often four frames are.
    #[arg(long, value_name = "N", default_value = "3", value_parser = clap::value_parser!(u32).range(1..=1000))]
    pub rounds: u32,
    /// Write all tables to a file as well, as comma-separated values.
    #[arg(long, value_name = "FILE.csv", value_parser = values::table())]
    pub out: Option<PathBuf>,
    /// Draw the table of the renderers as a picture: .svg or .png.
    #[arg(long, value_name = "FILE", value_parser = values::plot())]
    pub plot: Option<PathBuf>,
    /// `town`, `spectra` or `lattice` (built in), or a glTF 2.0 file (.gltf, .glb).
    #[arg(long, value_name = "SCENE", default_value = "town", value_parser = world::scene())]
    pub scene: SceneChoice,
    /// How fast light is, as a number and a unit: m/s (kept in these), km/h, mph, km/s or c (299792458 m/s).
    #[arg(long, value_name = "SPEED", default_value = "30 km/h", allow_hyphen_values = true, value_parser = values::speed)]
    pub speed_of_light: f64,
    /// Take the poses from a recorded ride, evenly along it, in its scene and with its speed of light [default: along the scene's circuit, at 0.5 to 0.99 c].
    #[arg(long, value_name = "R.mcap", value_parser = values::recording(), conflicts_with = "speed_of_light")]
    pub replay: Option<PathBuf>,
}

/// What the dials are chosen for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Goal {
    /// A time that 95 of 100 frames keep to.
    Budget {
        /// Milliseconds.
        ms: f64,
    },
    /// An error that 99 of 100 pixels keep to.
    Tolerance {
        /// Pixels.
        pixels: f64,
    },
}

impl Display for Goal {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Budget { ms } => write!(formatter, "budget {ms}ms"),
            Self::Tolerance { pixels } => write!(formatter, "tolerance {pixels}px"),
        }
    }
}

impl MeasureOptions {
    /// The goal, if there is one.
    pub fn goal(&self) -> Option<Goal> {
        let budget = self.budget.map(|ms| Goal::Budget { ms });
        budget.or(self.tolerance.map(|pixels| Goal::Tolerance { pixels }))
    }
}
