//! Options of the world: its scene and its speed of light.

use std::convert::Infallible;
use std::path::PathBuf;

use clap::Args;
use clap::builder::{PathBufValueParser, TypedValueParser};

use super::values;
use regular_file::Budget;

/// Scene that is shown.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum SceneChoice {
    /// The built-in old town.
    #[default]
    Town,
    /// The built-in hall of three temperatures, which shows the effect on spectra.
    Spectra,
    /// The built-in lattice of boxes, for seeing and measuring the geometry alone.
    Lattice,
    /// The built-in row of dice beside a road, for seeing that what passes is turned.
    Dice,
    /// The built-in platform and trains, with clocks on both.
    Train,
    /// The built-in laboratory, which a wire cube and a sphere pass.
    Laboratory,
    /// A glTF 2.0 file, or a panorama.
    File(PathBuf),
}

impl SceneChoice {
    /// Choice by its name on the command line and in recordings.
    pub fn from_name(name: &str) -> Self {
        match name {
            "town" => Self::Town,
            "spectra" => Self::Spectra,
            "lattice" => Self::Lattice,
            "dice" => Self::Dice,
            "train" => Self::Train,
            "laboratory" => Self::Laboratory,
            file => Self::File(file.into()),
        }
    }

    /// Name by which the scene is found again.
    pub fn name(&self) -> String {
        match self {
            Self::Town => "town".to_owned(),
            Self::Spectra => "spectra".to_owned(),
            Self::Lattice => "lattice".to_owned(),
            Self::Dice => "dice".to_owned(),
            Self::Train => "train".to_owned(),
            Self::Laboratory => "laboratory".to_owned(),
            Self::File(path) => std::path::absolute(path).as_ref().unwrap_or(path).display().to_string(),
        }
    }
}

/// Options of the scene and its speed of light.
#[derive(Args, Clone, Debug, PartialEq)]
#[command(next_help_heading = "World")]
pub struct WorldOptions {
    /// Scene: `town`, `spectra`, `lattice`, `dice`, `train` or `laboratory` (built in), a glTF 2.0 file (.gltf, .glb),
    /// or a panorama (.png, .jpg, .webp, .tif, .hdr, .exr).
    ///
    /// [default: town, or the scene of the recording]
    #[arg(long, value_name = "SCENE", value_parser = scene())]
    pub scene: Option<SceneChoice>,
    /// Camera of the scene's file from which it is seen at the start, by its name, or by its number from 1
    /// [default: the first perspective one]. `rapidity check` lists them.
    #[arg(long, value_name = "NAME|N")]
    pub camera: Option<String>,
    /// Speed of light, as a number and a unit: m/s (the internal unit), km/h, mph, km/s or c (299792458 m/s)
    /// [default: 30 km/h; for a file, a speed that crosses the scene in about five seconds].
    #[arg(long, value_name = "SPEED", allow_hyphen_values = true, value_parser = values::speed)]
    pub speed_of_light: Option<f64>,
    /// Paint the old town anew, instead of taking its pictures from the cache and keeping them there (`rapidity` in the
    /// user's folder for caches: ~/.cache on Linux, or XDG_CACHE_HOME).
    #[arg(long)]
    pub no_cache: bool,
    /// Options of reading the scene's file.
    #[command(flatten)]
    pub reading: ReadingOptions,
}

/// Options of reading files.
#[derive(Args, Clone, Copy, Debug, PartialEq)]
pub struct ReadingOptions {
    /// Memory that a file may take when it is read, GB.
    #[arg(long, value_name = "GB", default_value = "3", value_parser = values::positive)]
    pub limit: f64,
    /// Allow a scene's file to refer to files outside its folder.
    #[arg(long)]
    pub trust: bool,
}

impl ReadingOptions {
    /// Budget of memory.
    pub fn budget(&self) -> Budget {
        Budget::new((self.limit * 1e9) as u64)
    }
}

impl WorldOptions {
    /// Scene that is shown if no recording names one.
    pub fn scene(&self) -> SceneChoice {
        self.scene.clone().unwrap_or_default()
    }
}

pub(super) fn scene() -> impl TypedValueParser<Value = SceneChoice> {
    PathBufValueParser::new().try_map(|path| {
        Ok::<_, Infallible>(path.to_str().map_or_else(|| SceneChoice::File(path.clone()), SceneChoice::from_name))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_scene_is_found_again_by_its_name() {
        for choice in [
            SceneChoice::Town,
            SceneChoice::Spectra,
            SceneChoice::Lattice,
            SceneChoice::Dice,
            SceneChoice::Train,
            SceneChoice::Laboratory,
            SceneChoice::File("/a/b.hdr".into()),
        ] {
            assert_eq!(SceneChoice::from_name(&choice.name()), choice);
        }
    }
}
