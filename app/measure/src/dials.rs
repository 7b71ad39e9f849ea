//! The dials of the renderers, and the settings of them that are measured.

use crate::command::Renderer;
use crate::error::Error;
use crate::renderers::choice::{Bending, Choice};
use crate::renderers::image::MapQuality;
use crate::renderers::polygon::{Pace, Tolerance};
use crate::scene::Scene;

/// One position of a dial.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Setting {
    /// `--renderer polygon --edge METRES`.
    Edge(f64),
    /// `--renderer polygon --edge METRES --transform gpu`.
    VertexStage(f64),
    /// `--renderer polygon --tolerance PIXELS`.
    Tolerance(f64),
    /// `--renderer image --map-scale N`.
    Map(f64),
}

/// For stills.
pub const OF_STILLS: [Setting; 13] = [
    Setting::Edge(2.0),
    Setting::Edge(1.0),
    Setting::Edge(0.5),
    Setting::VertexStage(1.0),
    Setting::VertexStage(0.5),
    Setting::Tolerance(4.0),
    Setting::Tolerance(2.0),
    Setting::Tolerance(1.0),
    Setting::Tolerance(0.5),
    Setting::Tolerance(0.25),
    Setting::Map(0.9),
    Setting::Map(2.0),
    Setting::Map(8.0),
];

/// For rides.
pub const OF_RIDES: [Setting; 12] = [
    Setting::Edge(2.0),
    Setting::Edge(1.0),
    Setting::Edge(0.5),
    Setting::VertexStage(1.0),
    Setting::VertexStage(0.5),
    Setting::Tolerance(8.0),
    Setting::Tolerance(4.0),
    Setting::Tolerance(1.5),
    Setting::Tolerance(0.75),
    Setting::Map(0.5),
    Setting::Map(0.9),
    Setting::Map(1.5),
];

impl Setting {
    /// The dial's name.
    pub fn dial(self) -> &'static str {
        match self {
            Self::Edge(_) => "edge",
            Self::VertexStage(_) => "transform",
            Self::Tolerance(_) => "tolerance",
            Self::Map(_) => "map-scale",
        }
    }

    /// What the dial is set to.
    pub fn value(self) -> f64 {
        let (Self::Edge(value) | Self::VertexStage(value) | Self::Tolerance(value) | Self::Map(value)) = self;
        value
    }

    /// Whose dial it is.
    pub fn renderer(self) -> Renderer {
        match self {
            Self::Edge(_) | Self::VertexStage(_) | Self::Tolerance(_) => Renderer::Polygon,
            Self::Map(_) => Renderer::Image,
        }
    }

    /// As the command line has it.
    pub fn flags(self) -> String {
        let (renderer, value) = (self.renderer().name(), self.value());
        match self {
            Self::VertexStage(_) => format!("--renderer {renderer} --edge {value} --transform gpu"),
            _ => format!("--renderer {renderer} --{} {value}", self.dial()),
        }
    }

    /// The scene as it is drawn so: in pictures that wait for it, or in a window, where maps are smooth.
    ///
    /// # Errors
    /// A scene that cannot be cut so finely.
    pub fn choose(self, scene: Scene, pace: Pace) -> Result<Choice, Error> {
        let fixed = |edge_m, vertex_stage| Bending::Fixed { edge_m, vertex_stage };
        let adaptive = |pixels| Bending::Adaptive(Tolerance { pixels, pace });
        let (bending, texels_per_pixel) = match self {
            Self::Edge(metres) => (fixed(metres, false), 1.0),
            Self::VertexStage(metres) => (fixed(metres, true), 1.0),
            Self::Tolerance(pixels) => (adaptive(pixels), 1.0),
            Self::Map(texels) => (adaptive(1.0), texels),
        };
        let quality = MapQuality { texels_per_pixel, smooth: pace == Pace::Ride };
        Ok(Choice::of(scene, self.renderer(), bending, quality)?)
    }
}
