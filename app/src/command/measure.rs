//! `rapidity measure`: what each speed-up costs in error.

use std::path::PathBuf;

use clap::Args;

use super::{SceneChoice, values, world};

/// What to measure.
#[derive(Args, Clone, Debug, PartialEq)]
#[command(allow_negative_numbers = true)]
pub struct MeasureOptions {
    /// Measure the numbers at the extremes instead, against arithmetic of 50 digits, and print them as a table.
    #[arg(long)]
    pub extremes: bool,
    /// Width and height of the pictures, pixels.
    #[arg(long, value_name = "WxH", default_value = "640x360", value_parser = values::size)]
    pub size: [u32; 2],
    /// Places along the scene's circuit at which pictures are taken, 1 to 1000.
    #[arg(long, value_name = "N", default_value = "5", value_parser = clap::value_parser!(u32).range(1..=1000))]
    pub poses: u32,
    /// How often each picture is timed, 1 to 1000.
    #[arg(long, value_name = "N", default_value = "5", value_parser = clap::value_parser!(u32).range(1..=1000))]
    pub rounds: u32,
    /// Write the table to a file as well, as comma-separated values.
    #[arg(long, value_name = "FILE.csv")]
    pub out: Option<PathBuf>,
    /// `town`, `spectra` or `lattice` (built in), or a glTF 2.0 file (.gltf, .glb).
    #[arg(long, value_name = "SCENE", default_value = "town", value_parser = world::scene())]
    pub scene: SceneChoice,
}

impl MeasureOptions {
    /// Checks what the options say together.
    pub(super) fn check(&self) -> Result<(), String> {
        Ok(())
    }
}
