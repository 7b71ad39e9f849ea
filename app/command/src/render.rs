//! `rapidity render`: a still or a film, without a window.

use std::path::PathBuf;

use clap::Args;
use glam::DVec3;
use physics::Celerity;

use super::dial::DialOptions;
use super::film::FilmOptions;
use super::picture::PictureOptions;
use super::projection::ProjectionOptions;
use super::rays::RayOptions;
use super::room::RoomOptions;
use super::values::{self, Output};
use super::world::WorldOptions;
use filming::{FrameFile, StereoLayout};
use scene::Start;
use view::{OutsideView, Places, Projection, RendererName};

/// Sine of the angle between `--look` and `--up` below which they count as parallel.
const PARALLEL: f64 = 1e-9;

/// Options of `rapidity render`.
#[derive(Args, Clone, Debug, PartialEq)]
#[command(allow_negative_numbers = true)]
pub struct RenderOptions {
    /// File to write: .png for a picture, .exr for its light, .mp4 (.mov, .mkv) for a film; film.####.png for numbered
    /// pictures; with --display, a folder.
    ///
    /// Light is linear sRGB in cd/m², before exposure, tone and gamut, as 32-bit floats. Numbered pictures have a place
    /// for the number in their name, #### or %04d, and may be .png or .exr; each is exposed by itself.
    #[arg(long, value_name = "FILE", value_parser = values::output())]
    pub out: Output,
    /// Options of the world.
    #[command(flatten)]
    pub world: WorldOptions,
    /// Options of the observer.
    #[command(flatten)]
    pub viewpoint: Viewpoint,
    /// Draw the view of a recorded rider.
    ///
    /// World, vehicle and observer come from the recording; --look is a direction in the rider's own axes then: right,
    /// up, backward. --scene is needed only if the file of its scene has moved.
    #[arg(long, value_name = "R.mcap", value_parser = values::recording(), help_heading = "Observer")]
    #[arg(conflicts_with_all = ["speed_of_light", "position", "celerity", "beta"])]
    pub replay: Option<PathBuf>,
    /// Move the camera along the path of this file (docs/FILMS.md says what it may hold), or with the word camera along
    /// the animation of the scene's own camera.
    ///
    /// The path says where the camera is at each moment of its own clock, how fast, and where it looks; a film is as
    /// long as its path.
    #[arg(long, value_name = "PATH.toml", value_parser = values::camera_path(), help_heading = "Observer")]
    #[arg(conflicts_with_all = ["replay", "position", "look", "up", "celerity", "beta", "display"])]
    pub path: Option<PathBuf>,
    /// Options of films and numbered pictures.
    #[command(flatten)]
    pub film: FilmOptions,
    /// Look at the photo-surface from outside: a camera at rest in the observer's frame, at X,Y,Z metres from the eye.
    ///
    /// What is drawn is the surface of all apparent positions, with the observer as a ball with its axes (right red, up
    /// green, ahead blue) and the edges of its field of view. After a slash comes the direction of the camera
    /// [default: towards the eye], after a colon what colours show: light; doppler, the factor D, blue above 1 and red
    /// below, with a line at every octave; delay, in rings of equal delay. As in 8,5,9/-1,-0.5,-1:delay. Axes are as
    /// for --look.
    #[arg(long, value_name = "X,Y,Z[/X,Y,Z][:COLOURS]", allow_hyphen_values = true, help_heading = "Observer")]
    pub outside: Option<OutsideView>,
    /// Options of the room for which the picture is drawn.
    #[command(flatten)]
    pub room: RoomOptions,
    /// Options of the method of drawing.
    #[command(flatten)]
    pub dial: DialOptions,
    /// Options of the picture.
    #[command(flatten)]
    pub picture: PictureOptions,
    /// Options of the projection and of the eyes.
    #[command(flatten)]
    pub projection: ProjectionOptions,
    /// Options of the rays.
    #[command(flatten)]
    pub rays: RayOptions,
}

/// Options of the observer: place, motion and direction of view.
#[derive(Args, Clone, Debug, PartialEq)]
#[command(next_help_heading = "Observer")]
pub struct Viewpoint {
    /// Place of the eye, world axes, metres [default: the scene's start].
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = values::vector)]
    pub position: Option<DVec3>,
    /// Direction of view in the observer's frame, normalised [default: the scene's start].
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = values::direction)]
    pub look: Option<DVec3>,
    /// Direction that is up in the picture, normalised [default: the scene's start, else 0,1,0].
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = values::direction)]
    pub up: Option<DVec3>,
    /// Velocity of the observer as celerity, gamma times v/c, world axes [default: at rest].
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = values::celerity)]
    celerity: Option<Celerity>,
    /// Velocity of the observer as v/c, shorter than 1, world axes.
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = values::beta)]
    #[arg(conflicts_with = "celerity")]
    beta: Option<Celerity>,
}

impl Viewpoint {
    /// Direction that is up in the picture. That of the start belongs to the start's direction of view. Straight above,
    /// what is ahead at the start is below in the picture, as on a dome; straight below, it is above.
    pub fn up(&self, start: &Start) -> DVec3 {
        let Some(look) = self.look else { return self.up.unwrap_or(start.up) };
        let steep = look.cross(DVec3::Y).length() < PARALLEL;
        self.up.unwrap_or(if steep { start.look.reject_from(DVec3::Y) * -look.y.signum() } else { DVec3::Y })
    }

    /// Velocity of the observer, world axes.
    pub fn celerity(&self) -> Celerity {
        self.celerity.or(self.beta).unwrap_or_default()
    }
}

impl RenderOptions {
    /// Sets what follows from other options. `sized`: the command line has a size.
    pub(super) fn complete(&mut self, sized: bool) {
        if !sized {
            self.picture.size = self.projection.projection.usual_size();
        }
    }

    /// True if the pictures are written as light.
    pub fn writes_light(&self) -> bool {
        matches!(self.out, Output::Light(_) | Output::Sequence(_, FrameFile::Exr))
    }

    /// Checks rules between the options.
    pub(super) fn check(&self) -> Result<(), String> {
        match (&self.out, &self.room.display) {
            (Output::Folder(_), None) => return Err(format!("--out: the file's name must end in {}", values::ENDINGS)),
            (Output::Folder(_), Some(_)) | (_, None) => {}
            (_, Some(_)) => {
                return Err("--display makes a picture for every channel: name a folder with --out, as in --out walls"
                    .to_owned());
            }
        }
        if self.room.display.is_some() && self.replay.is_some() {
            return Err("--replay is not drawn for --display yet; leave one out".to_owned());
        }
        self.film.check(&self.out, self.replay.is_some() || self.path.is_some())?;
        if self.room.display.is_none() {
            self.projection.check(self.picture.size)?;
        } else if self.projection != ProjectionOptions::default() {
            return Err(
                "--projection and --stereo are not for --display, whose screens and eyes the display describes; \
                 leave one out"
                    .to_owned(),
            );
        }
        if self.outside.is_some() && self.projection != ProjectionOptions::default() {
            return Err(
                "--outside makes one flat picture; leave --projection and --stereo, or --outside out".to_owned()
            );
        }
        if self.projection.stereo == Some(StereoLayout::Anaglyph) && self.film.hdr.is_some() {
            return Err(
                "--stereo anaglyph is for usual screens; leave --hdr out, or choose another arrangement".to_owned()
            );
        }
        if self.projection.stereo == Some(StereoLayout::Anaglyph) && self.writes_light() {
            return Err("--stereo anaglyph is a picture for a screen, and .exr files hold light; choose another \
                 arrangement, or .png"
                .to_owned());
        }
        let Viewpoint { look, up, .. } = self.viewpoint;
        if look.zip(up).is_some_and(|(look, up)| look.cross(up).length() < PARALLEL) {
            return Err("--up must not be parallel to --look; give another --up, or leave it out".to_owned());
        }
        let traces = self.dial.renderer == RendererName::Raytrace;
        if self.rays.bounces.is_some() && !traces {
            return Err("--bounces is for --renderer raytrace; leave one out or add the other".to_owned());
        }
        let flat = self.projection.projection == Projection::Flat && self.projection.stereo.is_none();
        if let Some(option) = self.rays.of_lens() {
            if !traces && !flat {
                return Err(format!(
                    "{option} with --projection or --stereo is for --renderer raytrace; add it, or leave one out"
                ));
            }
            if self.outside.is_some() || self.room.display.is_some() {
                return Err(format!("{option} is for what one eye sees; leave --outside, --display or {option} out"));
            }
        }
        if self.outside.is_some() && self.room.display.is_some() {
            return Err(
                "--outside makes one flat picture, and no room has a screen for it; leave --outside or --display \
                 out"
                .to_owned(),
            );
        }
        if self.outside.is_some() && self.dial.renderer == RendererName::Raytrace {
            return Err(
                "--outside shows where things appear, and the raytrace renderer follows rays, which all end at \
                 the eye; choose --renderer polygon or leave --outside out"
                    .to_owned(),
            );
        }
        if self.picture.effects.places == Places::Measured && self.rays.bounces.is_some_and(|bounces| bounces > 0) {
            return Err("--bounces are of light, and no light brings what is measured; leave --bounces or --effects \
                 measured out"
                .to_owned());
        }
        if self.picture.exact_light && self.dial.renderer != RendererName::Raytrace {
            return Err("--exact-light is for --renderer raytrace; leave one out or add the other".to_owned());
        }
        Ok(())
    }
}
