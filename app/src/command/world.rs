//! Options of the world: its scene and its speed of light.

use std::convert::Infallible;
use std::path::PathBuf;

use clap::builder::{PathBufValueParser, TypedValueParser};
use clap::{Args, ValueEnum};
use serde::{Deserialize, Serialize};

use super::values;
use crate::renderers::choice::Bending;
use crate::renderers::polygon::{Pace, Tolerance};

/// Largest error of position in a still, pixels.
const STILL_PX: f64 = 0.5;

/// Largest error of position in a window, pixels.
const RIDE_PX: f64 = 1.5;

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
            file => Self::File(file.into()),
        }
    }

    /// Name by which the scene is found again.
    pub fn name(&self) -> String {
        match self {
            Self::Town => "town".to_owned(),
            Self::Spectra => "spectra".to_owned(),
            Self::Lattice => "lattice".to_owned(),
            Self::File(path) => std::path::absolute(path).as_ref().unwrap_or(path).display().to_string(),
        }
    }
}

/// Options of the scene and its speed of light.
#[derive(Args, Clone, Debug, PartialEq)]
#[command(next_help_heading = "World")]
pub struct WorldOptions {
    /// Scene: `town`, `spectra` or `lattice` (built in), a glTF 2.0 file (.gltf, .glb), or a panorama (.png, .jpg,
    /// .hdr, .exr).
    #[arg(long, value_name = "SCENE", default_value = "town", value_parser = scene())]
    pub scene: SceneChoice,
    /// Speed of light, as a number and a unit: m/s (the internal unit), km/h, mph, km/s or c (299792458 m/s).
    #[arg(long, value_name = "SPEED", default_value = "30 km/h", allow_hyphen_values = true, value_parser = values::speed)]
    pub speed_of_light: f64,
    /// Longest edge of a triangle in the polygon renderer, metres, cut once [default: cut for every picture, see
    /// --tolerance].
    ///
    /// In a scene that names a circuit, edges farther than 4 m from it may be longer in proportion.
    #[arg(long, value_name = "METRES", value_parser = values::positive, conflicts_with = "tolerance")]
    pub edge: Option<f64>,
    /// Largest error of position in the polygon renderer, pixels: edges are cut for every picture until they bend as
    /// accurately as this [default: 0.5, in a window 1.5].
    #[arg(long, value_name = "PIXELS", value_parser = values::within(0.01, 100.0))]
    pub tolerance: Option<f64>,
    /// Processor that bends vertices cut once: cpu, in parallel with drawing, or gpu, in its vertex stage except for
    /// those astern; needs --edge.
    #[arg(long, value_enum, default_value = "cpu", requires_if("gpu", "edge"))]
    pub transform: Transform,
}

/// Processor that computes the apparent positions of vertices.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Transform {
    /// Every processor core, in parallel with drawing.
    #[default]
    Cpu,
    /// The GPU's vertex stage; vertices astern are left to the CPU.
    Gpu,
}

impl WorldOptions {
    /// Method of bending the polygon renderer's edges, for a still or for a window.
    pub fn bending(&self, pace: Pace) -> Bending {
        let usual = match pace {
            Pace::Still => STILL_PX,
            Pace::Ride => RIDE_PX,
        };
        match self.edge {
            Some(edge) => Bending::Fixed { edge_m: edge, vertex_stage: self.transform == Transform::Gpu },
            None => Bending::Adaptive(Tolerance { pixels: self.tolerance.unwrap_or(usual), pace }),
        }
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
        for choice in
            [SceneChoice::Town, SceneChoice::Spectra, SceneChoice::Lattice, SceneChoice::File("/a/b.hdr".into())]
        {
            assert_eq!(SceneChoice::from_name(&choice.name()), choice);
        }
    }
}
