//! `rapidity render`: a still or a film, without a window.

use std::path::PathBuf;

use clap::Args;
use glam::DVec3;
use physics::Celerity;

use super::values::{self, Output};
use super::{PictureOptions, RayOptions, Renderer, WorldOptions};

/// Pictures a second of a film for which `--fps` says nothing.
const FRAMES_PER_SECOND: f64 = 30.0;
/// Below this sine of the angle between them, `--up` does not say how a view along `--look` is turned.
const PARALLEL: f64 = 1e-9;

/// What to draw, from where, and into which file.
#[derive(Args, Clone, Debug, PartialEq)]
#[command(allow_negative_numbers = true)]
pub struct RenderOptions {
    /// The file to write: .png for a picture, .exr for its light, .mp4 for a film.
    ///
    /// Light is linear sRGB in cd/m², before exposure, tone and gamut, as 32-bit floats.
    #[arg(long, value_name = "FILE", value_parser = values::output())]
    pub out: Output,
    /// The world.
    #[command(flatten)]
    pub world: WorldOptions,
    /// The observer.
    #[command(flatten)]
    pub viewpoint: Viewpoint,
    /// See it with the eyes of a recorded rider.
    ///
    /// World, vehicle and observer come from the recording; --scene is needed only if its scene's file has moved.
    #[arg(long, value_name = "R.mcap", value_parser = values::recording(), help_heading = "Observer")]
    #[arg(conflicts_with_all = ["speed_of_light", "position", "look", "up", "celerity", "beta"])]
    pub replay: Option<PathBuf>,
    /// Length of a film in seconds of the observer's own time [default: 10, or the whole recording].
    ///
    /// For a picture of a recording: the moment to draw [default: its end].
    #[arg(long, value_name = "N", value_parser = values::positive, help_heading = "Film")]
    pub seconds: Option<f64>,
    /// Pictures a second of a film [default: 30].
    #[arg(long, value_name = "N", value_parser = values::within(0.1, 1000.0), help_heading = "Film")]
    fps: Option<f64>,
    /// How the picture is drawn.
    #[command(flatten)]
    pub picture: PictureOptions,
    /// What rays do.
    #[command(flatten)]
    pub rays: RayOptions,
}

/// Where the observer is, how he moves, and where he looks.
#[derive(Args, Clone, Debug, PartialEq)]
#[command(next_help_heading = "Observer")]
pub struct Viewpoint {
    /// Place of the eye, world axes, metres [default: the scene's start].
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = values::vector)]
    pub position: Option<DVec3>,
    /// Direction of view in the observer's frame, normalised [default: the scene's start].
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = values::direction)]
    pub look: Option<DVec3>,
    /// The direction that is up in the picture, normalised.
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, default_value = "0,1,0")]
    #[arg(value_parser = values::direction)]
    pub up: DVec3,
    /// Velocity of the observer as celerity, gamma times v/c, world axes [default: at rest].
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = values::celerity)]
    celerity: Option<Celerity>,
    /// The same as v/c, shorter than 1.
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = values::beta)]
    #[arg(conflicts_with = "celerity")]
    beta: Option<Celerity>,
}

impl Viewpoint {
    /// Velocity of the observer in the world.
    pub fn celerity(&self) -> Celerity {
        self.celerity.or(self.beta).unwrap_or_default()
    }
}

impl RenderOptions {
    /// Pictures a second of the film.
    pub fn frames_per_second(&self) -> f64 {
        self.fps.unwrap_or(FRAMES_PER_SECOND)
    }

    /// Checks what the options say together.
    pub(super) fn check(&self) -> Result<(), String> {
        if !matches!(self.out, Output::Film(_)) {
            if self.fps.is_some() {
                return Err("--fps is for films: name an .mp4 file with --out, or leave --fps out".to_owned());
            }
            if self.seconds.is_some() && self.replay.is_none() {
                return Err("--seconds is for films and recordings: name an .mp4 file with --out, or a recording \
                     with --replay, or leave --seconds out"
                    .to_owned());
            }
        }
        let Viewpoint { look, up, .. } = self.viewpoint;
        if look.is_some_and(|look| look.cross(up).length() < PARALLEL) {
            return Err("--up must not be parallel to --look; give another --up (its default is 0,1,0)".to_owned());
        }
        if let Some(option) = self.rays.given().filter(|_| self.picture.renderer != Renderer::Raytrace) {
            return Err(format!("{option} is for --renderer raytrace; leave one out or add the other"));
        }
        self.picture.check()
    }
}
