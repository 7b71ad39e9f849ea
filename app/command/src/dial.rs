//! Options of the method of drawing.

use clap::Args;
use view::{Dial, Occasion, RendererName, Transform};

use super::values;

/// Method of drawing, and its setting.
#[derive(Args, Clone, Debug, Default, PartialEq)]
#[command(next_help_heading = "Drawing")]
pub struct DialOptions {
    /// Method of drawing: auto, polygon, image or, not in a window, raytrace.
    #[arg(long, value_name = "RENDERER", default_value = "auto")]
    pub renderer: RendererName,
    /// Largest error of position in the polygon renderer, pixels. Edges are cut for every picture until they bend as
    /// accurately as this [default: 0.5, in a window 1.5].
    #[arg(long, value_name = "PIXELS", value_parser = values::within(0.01, 100.0))]
    pub tolerance: Option<f64>,
    /// Longest edge of a triangle in the polygon renderer, metres. Triangles are cut once, to this length [default:
    /// cut for every picture, see --tolerance].
    ///
    /// In a scene that names a circuit, edges farther than 4 m from it may be longer in proportion.
    #[arg(long, value_name = "METRES", value_parser = values::within(1e-5, 1e9), conflicts_with = "tolerance")]
    pub edge: Option<f64>,
    /// Processor that bends the vertices after --edge: cpu, in parallel with drawing, or gpu, in its vertex stage,
    /// except for vertices astern. gpu needs --edge.
    #[arg(long, value_name = "cpu|gpu", default_value = "cpu", requires_if("gpu", "edge"))]
    pub transform: Transform,
    /// Texels of the image renderer's map for each pixel, along each axis [default: 8 for a picture of one sample a
    /// pixel, 3 for one of several, 1.5 in a window, 0.9 in one that the CPU draws].
    #[arg(long, value_name = "N", value_parser = values::within(0.1, 16.0))]
    pub map_scale: Option<f64>,
}

impl DialOptions {
    /// Options on the command line for a dial.
    pub fn of(dial: Dial) -> Self {
        let Dial { renderer, edge, transform, tolerance, map_scale } = dial;
        Self { renderer, tolerance, edge, transform: transform.unwrap_or_default(), map_scale }
    }

    /// Dial that is asked for, with the usual setting where none is given. `usual_map_scale`: texels of a map for each
    /// pixel.
    pub fn dial(&self, occasion: Occasion, usual_map_scale: f64) -> Dial {
        let usual_tolerance = self.edge.is_none().then(|| occasion.usual_tolerance());
        Dial {
            renderer: self.renderer,
            edge: self.edge,
            transform: Some(self.transform),
            tolerance: self.tolerance.or(usual_tolerance),
            map_scale: self.map_scale.or(Some(usual_map_scale)),
        }
    }
}

/// Texels of the map for each pixel of a picture that is kept.
///
/// A picture of one sample a pixel is the light of one ray, so the map must be fine; several samples mix by themselves.
pub fn map_scale_of_stills(samples: u32) -> f64 {
    if samples == 1 { 8.0 } else { 3.0 }
}

/// Texels of the map for each pixel of a window; `software`: drawn by the CPU.
pub fn map_scale_of_windows(software: bool) -> f64 {
    if software { 0.9 } else { 1.5 }
}
