//! Options for drawing a picture, in a window or into a file.

use clap::Args;
use presentation::Presentation;
use render::display::{Development, Exposure, Gamut, Tone};
use scene::Start;
use view::Effects;

use super::values;

/// Options of the picture: size, field of view, quality.
#[derive(Args, Clone, Debug, PartialEq)]
#[command(next_help_heading = "Picture")]
pub struct PictureOptions {
    /// Width and height of the picture or of the window, pixels.
    #[arg(long, value_name = "WxH", default_value = "1280x720", value_parser = values::size)]
    pub size: [u32; 2],
    /// Vertical field of view, degrees, 1 to 170 [default: that of the scene's camera, else 60].
    #[arg(long, value_name = "DEGREES", value_parser = values::within(1.0, 170.0))]
    pub fov: Option<f64>,
    /// Samples per pixel for antialiasing, 1 to 64; with 1, a pixel has the colour along its centre ray.
    ///
    /// A window takes 4 for the edges of triangles where a graphics card draws, unless 1 is asked for, and else 1; a
    /// picture in which nothing changes takes 16 in any case.
    #[arg(long, value_name = "N", default_value = "4", value_parser = clap::value_parser!(u32).range(1..=64))]
    pub samples: u32,
    /// Relativistic effects in the picture: all, none, measured, or any of geometry, doppler and searchlight, separated
    /// by commas.
    ///
    /// geometry: things are where their light comes from. Without it, light is infinitely fast in the world. measured:
    /// things are where they are now for the observer, contracted along the motion; nothing of light goes with it.
    #[arg(long, value_name = "EFFECTS", default_value = "all")]
    pub effects: Effects,
    /// Brightness of the picture: auto, white, or a number of stops brighter than white, as in -1.5 (a stop is a
    /// factor of two).
    ///
    /// auto: on average as bright as the same surfaces are at rest. white: a surface that is white at rest is shown
    /// as white.
    #[arg(long, value_name = "EXPOSURE", default_value = "auto", allow_hyphen_values = true)]
    pub exposure: Exposure,
    /// Curve from radiance to the screen's brightness.
    #[arg(long, value_enum, default_value = "reinhard")]
    pub tone: Tone,
    /// Treatment of colours that the screen cannot show.
    #[arg(long, value_enum, default_value = "desaturate")]
    pub gamut: Gamut,
    /// Integrate the spectrum of every ray of the raytrace renderer, instead of looking its colour up in a table.
    #[arg(long)]
    pub exact_light: bool,
    /// Colour where there is no surface: linear red, green, blue, each 0 to 1 [default: the scene's sky].
    #[arg(long, value_name = "R,G,B", allow_hyphen_values = true, value_parser = values::colour)]
    pub background: Option<[f32; 3]>,
    /// Number of threads that transform the scene, 1 to 1024 [default: one per processor core].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1024))]
    pub threads: Option<u32>,
    /// True if the command line has an option for the picture that a recording tells, too.
    #[arg(skip)]
    pub is_given: bool,
}

/// Vertical field of view of a picture of which nothing else is said, degrees.
const FOV_DEGREES: f64 = 60.0;

impl PictureOptions {
    /// Vertical field of view in degrees: the given one, else that of the start.
    pub fn fov_deg(&self, start: &Start) -> f64 {
        self.fov.unwrap_or(start.field_of_view_rad.map_or(FOV_DEGREES, f64::to_degrees))
    }

    /// Presentation by these options, from a start.
    pub fn presentation(&self, start: &Start) -> Presentation {
        Presentation {
            effects: self.effects,
            fov_deg: self.fov_deg(start),
            development: self.development(),
            ..Presentation::default()
        }
    }

    /// Development of radiance into the picture.
    pub fn development(&self) -> Development {
        Development { exposure: self.exposure, tone: self.tone, gamut: self.gamut }
    }
}
