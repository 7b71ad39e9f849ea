//! Options of the projection of pictures and films, and of both eyes.

use clap::Args;
use filming::StereoLayout;
use room::EYE_SEPARATION_M;
use view::Projection;

use super::values;

/// Distance of the wall of a flat stereo picture without an option, metres.
const WALL_M: f64 = 2.0;

/// Options of the projection and of the eyes.
#[derive(Args, Clone, Debug, Default, PartialEq)]
#[command(next_help_heading = "Projection")]
pub struct ProjectionOptions {
    /// Projection: flat, sphere, fisheye, cube or vr180.
    ///
    /// sphere: all directions, twice as wide as high (equirectangular), as 360° players show them; its middle is along
    /// --look. fisheye: a disc whose radius is the angle from --look, for a dome; 180 degrees in all, or as many as
    /// follow a colon, as in fisheye:220. cube: six faces, right, left and above over below, ahead and behind. vr180:
    /// half of a sphere.
    #[arg(long, value_name = "PROJECTION", default_value = "flat")]
    pub projection: Projection,
    /// Draw for two eyes, in this arrangement; --size is that of one eye's picture.
    ///
    /// In all projections but flat, every direction has its own pair of eyes, so depth is right wherever one looks.
    #[arg(long, value_enum, value_name = "LAYOUT")]
    pub stereo: Option<StereoLayout>,
    /// Distance between the eyes, metres [default: 0.064].
    #[arg(long, value_name = "M", value_parser = values::within(1e-6, 1e6), requires = "stereo")]
    eye_separation: Option<f64>,
    /// Distance of the wall on which a flat stereo picture is shown, metres: what is as far away is seen on the wall
    /// itself, nearer things before it [default: 2].
    #[arg(long, value_name = "M", value_parser = values::within(1e-3, 1e9), requires = "stereo")]
    pub wall_distance: Option<f64>,
}

impl ProjectionOptions {
    /// Distance between the eyes, metres.
    pub fn eye_separation_m(&self) -> f64 {
        self.eye_separation.unwrap_or(EYE_SEPARATION_M)
    }

    /// Distance of the wall of a flat stereo picture, metres.
    pub fn wall_m(&self) -> f64 {
        self.wall_distance.unwrap_or(WALL_M)
    }

    /// Checks the projection against the size of a picture.
    pub(super) fn check(&self, size: [u32; 2]) -> Result<(), String> {
        let Some([wide, high]) = self.projection.shape() else { return Ok(()) };
        let fits = u64::from(size[0]) * u64::from(high) == u64::from(size[1]) * u64::from(wide);
        let whole = self.projection != Projection::Cube || size[1].is_multiple_of(2);
        if fits && whole {
            return Ok(());
        }
        let [width, height] = self.projection.usual_size();
        let [of_width, of_height] = size;
        Err(format!(
            "--size {of_width}x{of_height} is not {wide} to {high}, as --projection {} needs it; try --size \
             {width}x{height}, or leave --size out",
            self.projection
        ))
    }
}
