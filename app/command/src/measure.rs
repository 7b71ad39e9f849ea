//! `rapidity measure`: the accuracy that each speed-up costs.

use std::path::PathBuf;

use clap::Args;

use super::values;
use super::world::WorldOptions;
use measure::choice::Goal;

/// Options of `rapidity measure`.
#[derive(Args, Clone, Debug, PartialEq)]
#[command(allow_negative_numbers = true)]
pub struct MeasureOptions {
    /// Print the errors of the physics instead: at extreme speeds, distances and steps, compared with 180 digits, as
    /// in ACCURACY.md. This takes minutes.
    #[arg(long, conflicts_with_all = ["size", "poses", "rounds", "out", "plot", "scene", "camera", "speed_of_light", "replay", "budget", "tolerance"])]
    pub extremes: bool,
    /// Measure frames of a ride. Later rides are drawn with the smallest error for which 95 of 100 frames keep to
    /// this time, as in 16.7ms.
    #[arg(long, value_name = "TIME", allow_hyphen_values = true, value_parser = values::milliseconds, conflicts_with = "tolerance")]
    pub budget: Option<f64>,
    /// Measure frames of a ride. Later rides are drawn as fast as possible with at most this error in 99 of 100
    /// pixels, as in 1px.
    #[arg(long, value_name = "PIXELS", allow_hyphen_values = true, value_parser = values::pixels)]
    pub tolerance: Option<f64>,
    /// Width and height of the pictures, pixels [default: 640x360, for --budget and --tolerance 1280x720].
    #[arg(long, value_name = "WxH", value_parser = values::size)]
    pub size: Option<[u32; 2]>,
    /// Number of places along the way at which pictures are taken, 1 to 1000.
    #[arg(long, value_name = "N", default_value = "5", value_parser = clap::value_parser!(u32).range(1..=1000))]
    pub poses: u32,
    /// Number of times that each picture is timed, 1 to 1000; for a ride, number of times that four frames are timed.
    #[arg(long, value_name = "N", default_value = "3", value_parser = clap::value_parser!(u32).range(1..=1000))]
    pub rounds: u32,
    /// File to which all tables are also written, as comma-separated values.
    #[arg(long, value_name = "FILE.csv", value_parser = values::table())]
    pub out: Option<PathBuf>,
    /// File for a plot of the renderers' table: .svg or .png.
    #[arg(long, value_name = "FILE", value_parser = values::plot())]
    pub plot: Option<PathBuf>,
    /// Options of the world.
    #[command(flatten)]
    pub world: WorldOptions,
    /// Take the poses from a recorded ride, evenly along it, in its scene and with its speed of light [default: along
    /// the scene's circuit, at 0.5 to 0.99 c].
    #[arg(long, value_name = "R.mcap", value_parser = values::recording(), conflicts_with = "speed_of_light")]
    pub replay: Option<PathBuf>,
}

impl MeasureOptions {
    /// Goal of the measurement, if one is given.
    pub fn goal(&self) -> Option<Goal> {
        let budget = self.budget.map(|ms| Goal::Budget { ms });
        budget.or(self.tolerance.map(|pixels| Goal::Tolerance { pixels }))
    }
}
