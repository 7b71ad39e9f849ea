//! `rapidity measure`: what each speed-up costs in error.

use std::path::PathBuf;

use clap::Args;

use super::{SceneChoice, values, world};

/// What to measure.
#[derive(Args, Clone, Debug, PartialEq)]
#[command(allow_negative_numbers = true)]
pub struct MeasureOptions {
    /// Print instead, as ACCURACY.md, how far the physics is off at extreme speeds, distances and steps, against 180 digits: takes minutes.
    #[arg(long, conflicts_with_all = ["size", "poses", "rounds", "out", "plot", "scene"])]
    pub extremes: bool,
    /// Width and height of the pictures, pixels.
    #[arg(long, value_name = "WxH", default_value = "640x360", value_parser = values::size)]
    pub size: [u32; 2],
    /// Places along the scene's circuit at which pictures are taken, 1 to 1000.
    #[arg(long, value_name = "N", default_value = "5", value_parser = clap::value_parser!(u32).range(1..=1000))]
    pub poses: u32,
    /// How often each picture is timed, 1 to 1000.
    #[arg(long, value_name = "N", default_value = "3", value_parser = clap::value_parser!(u32).range(1..=1000))]
    pub rounds: u32,
    /// Write the table to a file as well, as comma-separated values.
    #[arg(long, value_name = "FILE.csv", value_parser = values::table())]
    pub out: Option<PathBuf>,
    /// Draw the table as a picture: .svg or .png.
    #[arg(long, value_name = "FILE", value_parser = values::plot())]
    pub plot: Option<PathBuf>,
    /// `town`, `spectra` or `lattice` (built in), or a glTF 2.0 file (.gltf, .glb).
    #[arg(long, value_name = "SCENE", default_value = "town", value_parser = world::scene())]
    pub scene: SceneChoice,
}
