//! Options of the ray tracer's camera, and of what its rays do.

use super::values;
use clap::Args;

/// Lens, shutter, mirrors.
#[derive(Args, Clone, Copy, Debug, Default, PartialEq)]
#[command(next_help_heading = "Rays (--renderer raytrace)")]
pub struct RayOptions {
    /// Diameter of the lens's opening in metres: what is nearer or further than --focus is blurred [default: 0, all is sharp].
    #[arg(long, value_name = "METRES", value_parser = values::not_negative, requires = "focus")]
    pub aperture: Option<f64>,
    /// Distance in metres that is sharp, along the axis of the picture: where things are seen by the observer.
    #[arg(long, value_name = "METRES", value_parser = values::positive, requires = "aperture")]
    pub focus: Option<f64>,
    /// How long the shutter is open, in seconds of the observer's own time, as in 0.02 or 1/50 [default: 0, nothing is smeared].
    #[arg(long, value_name = "SECONDS", value_parser = values::share_of_time)]
    pub shutter: Option<f64>,
    /// How often mirrors and clear glass turn a ray, up to 16 [default: 0, they are as dull as the other renderers draw them].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(0..=16))]
    pub bounces: Option<u32>,
}

impl RayOptions {
    /// The first option that is given.
    pub(super) fn given(&self) -> Option<&'static str> {
        let given = [
            (self.aperture.is_some(), "--aperture"),
            (self.focus.is_some(), "--focus"),
            (self.shutter.is_some(), "--shutter"),
            (self.bounces.is_some(), "--bounces"),
        ];
        given.into_iter().find_map(|(given, name)| given.then_some(name))
    }
}
