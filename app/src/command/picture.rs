//! Options for drawing a picture, in a window or into a file.

use crate::renderers::Effects;
use crate::renderers::display::{Development, Exposure, Gamut, Tone};
use crate::renderers::image::MapQuality;
use clap::Args;

use super::values::{self, ValueError};

/// Method of computing the picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Renderer {
    /// The method that fits the scene.
    #[default]
    Auto,
    /// The photo-surface of every vertex (W 5.1).
    Polygon,
    /// A map of the world around the eye, bent pixel by pixel (B 5).
    Image,
    /// Every ray of light traced back on the CPU (W 5.2): the reference method, not for windows.
    Raytrace,
}

impl Renderer {
    /// Name of the method on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Auto => "auto",
            Self::Polygon => "polygon",
            Self::Image => "image",
            Self::Raytrace => "raytrace",
        }
    }
}

/// Options of the picture: size, field of view, quality.
#[derive(Args, Clone, Debug, PartialEq)]
#[command(next_help_heading = "Picture")]
pub struct PictureOptions {
    /// Width and height of the picture or of the window, pixels.
    #[arg(long, value_name = "WxH", default_value = "1280x720", value_parser = values::size)]
    pub size: [u32; 2],
    /// Vertical field of view, degrees, 1 to 170.
    #[arg(long, value_name = "DEGREES", default_value = "60", value_parser = values::within(1.0, 170.0))]
    pub fov: f64,
    /// Samples per pixel for antialiasing, 1 to 64; with 1, a pixel has the colour along its centre ray.
    #[arg(long, value_name = "N", default_value = "4", value_parser = clap::value_parser!(u32).range(1..=64))]
    pub samples: u32,
    /// Relativistic effects in the picture: all, none, or any of geometry, doppler and searchlight, separated by
    /// commas.
    #[arg(long, value_name = "EFFECTS", default_value = "all")]
    pub effects: Effects,
    /// Brightness of the picture: auto, white, or a number of stops brighter than white, as in -1.5.
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
    /// Method of computing the picture: auto, polygon, image or, not in a window, raytrace.
    #[arg(long, value_name = "RENDERER", default_value = "auto", value_parser = renderer)]
    pub renderer: Renderer,
    /// Texels of the image renderer's map per pixel, along each axis [default: 8 with one sample per pixel, 3 with
    /// several samples, 1.5 in a window, 0.9 in a window that the CPU draws].
    #[arg(long, value_name = "N", value_parser = values::within(0.1, 16.0))]
    pub map_scale: Option<f64>,
    /// Integrate the spectrum of every ray of the raytrace renderer, instead of looking its colour up in a table.
    #[arg(long)]
    pub exact_light: bool,
    /// Colour where there is no surface: linear red, green, blue, each 0 to 1 [default: the scene's sky].
    #[arg(long, value_name = "R,G,B", allow_hyphen_values = true, value_parser = values::colour)]
    pub background: Option<[f32; 3]>,
    /// Number of threads that transform the scene, 1 to 1024 [default: one per processor core].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1024))]
    pub threads: Option<u32>,
}

impl PictureOptions {
    /// Checks rules between the options.
    pub(super) fn check(&self) -> Result<(), String> {
        if self.exact_light && self.renderer != Renderer::Raytrace {
            return Err("--exact-light is for --renderer raytrace; leave one out or add the other".to_owned());
        }
        Ok(())
    }

    /// Development of radiance into the picture.
    pub fn development(&self) -> Development {
        Development { exposure: self.exposure, tone: self.tone, gamut: self.gamut }
    }

    /// Quality of the image renderer's map for pictures that are written to files.
    ///
    /// With one sample per pixel, the sample is the light of one ray: the map must be fine, and its texels must not
    /// be interpolated. Several samples are averaged anyway.
    pub fn map_of_pictures(&self) -> MapQuality {
        let usual = if self.samples == 1 { 8.0 } else { 3.0 };
        MapQuality { texels_per_pixel: self.map_scale.unwrap_or(usual), smooth: false }
    }

    /// Quality of the image renderer's map for a window; `software` is true if the CPU draws it.
    pub fn map_of_windows(&self, software: bool) -> MapQuality {
        let usual = if software { 0.9 } else { 1.5 };
        MapQuality { texels_per_pixel: self.map_scale.unwrap_or(usual), smooth: true }
    }
}

fn renderer(text: &str) -> Result<Renderer, ValueError> {
    let all = [Renderer::Auto, Renderer::Polygon, Renderer::Image, Renderer::Raytrace];
    all.into_iter().find(|renderer| renderer.name() == text).ok_or(ValueError::Renderer)
}
