//! Options of the ray tracer's camera and rays.

use super::values;
use clap::Args;

/// Options of the lens, the shutter and the mirrors.
#[derive(Args, Clone, Copy, Debug, Default, PartialEq)]
#[command(next_help_heading = "Lens and shutter")]
pub struct RayOptions {
    /// Diameter of the lens's opening, metres. Things nearer or farther than --focus are blurred [default: 0,
    /// everything is sharp].
    ///
    /// polygon and image draw a picture with a lens or a shutter at least 16 times, or as often as --samples says, and
    /// add these up; rays take a sample of both for each of theirs.
    #[arg(long, value_name = "METRES", value_parser = values::not_negative, requires = "focus")]
    pub aperture: Option<f64>,
    /// Distance that is in focus, metres along the axis of the picture, measured to where the observer sees things.
    #[arg(long, value_name = "METRES", value_parser = values::positive, requires = "aperture")]
    pub focus: Option<f64>,
    /// Time that the shutter is open, seconds of the observer's own time, as in 0.02 or 1/50 [default: 0, no motion
    /// blur]. The eye moves and turns meanwhile as it really does.
    #[arg(long, value_name = "SECONDS", value_parser = values::share_of_time)]
    pub shutter: Option<f64>,
    /// Largest number of times that mirrors and clear glass turn a ray, up to 16 [default: 0; they then look as dull
    /// as in the other renderers].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(0..=16))]
    #[arg(help_heading = "Rays (--renderer raytrace)")]
    pub bounces: Option<u32>,
}

impl RayOptions {
    /// Name of the first option of lens and shutter that is given, if any is.
    pub(super) fn of_lens(&self) -> Option<&'static str> {
        let given = [(self.aperture.is_some(), "--aperture"), (self.shutter.is_some(), "--shutter")];
        given.into_iter().find_map(|(given, name)| given.then_some(name))
    }
}
