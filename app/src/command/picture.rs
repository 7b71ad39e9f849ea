//! Options that say how a picture is drawn, in a window as on file.

use crate::renderers::Effects;
use crate::renderers::display::{Development, Exposure, Gamut, Tone};
use crate::renderers::image::MapQuality;
use clap::Args;

use super::values::{self, ValueError};

/// How the picture is computed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Renderer {
    /// Chosen by what the scene needs.
    #[default]
    Auto,
    /// The photo-surface of every vertex (W 5.1).
    Polygon,
    /// A map of the world around the eye, bent pixel by pixel (B 5).
    Image,
    /// Every ray of light followed back by itself, on the CPU (W 5.2): the reference. Not in windows.
    Raytrace,
}

impl Renderer {
    /// Its name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Auto => "auto",
            Self::Polygon => "polygon",
            Self::Image => "image",
            Self::Raytrace => "raytrace",
        }
    }
}

/// Size, field of view, quality.
#[derive(Args, Clone, Debug, PartialEq)]
#[command(next_help_heading = "Picture")]
pub struct PictureOptions {
    /// Width and height of the picture, or of the window, in pixels.
    #[arg(long, value_name = "WxH", default_value = "1280x720", value_parser = values::size)]
    pub size: [u32; 2],
    /// Vertical field of view in degrees, 1 to 170.
    #[arg(long, value_name = "DEGREES", default_value = "60", value_parser = values::within(1.0, 170.0))]
    pub fov: f64,
    /// Antialiasing: samples a pixel, 1 to 64; 1 takes the colour along the pixel's centre ray.
    #[arg(long, value_name = "N", default_value = "4", value_parser = clap::value_parser!(u32).range(1..=64))]
    pub samples: u32,
    /// What relativity does to the picture: all, none, or any of geometry, doppler and searchlight, with commas between them.
    #[arg(long, value_name = "EFFECTS", default_value = "all")]
    pub effects: Effects,
    /// How bright the picture is: auto, white, or stops brighter than white, as in -1.5.
    ///
    /// auto: on the average as bright as the same surfaces are at rest. white: what is white at rest is shown as white.
    #[arg(long, value_name = "EXPOSURE", default_value = "auto", allow_hyphen_values = true)]
    pub exposure: Exposure,
    /// The curve from radiance to the screen's brightness.
    #[arg(long, value_enum, default_value = "reinhard")]
    pub tone: Tone,
    /// Where colours go that the screen does not have.
    #[arg(long, value_enum, default_value = "desaturate")]
    pub gamut: Gamut,
    /// How the picture is computed: auto, polygon, image or, not in a window, raytrace.
    #[arg(long, value_name = "RENDERER", default_value = "auto", value_parser = renderer)]
    pub renderer: Renderer,
    /// Texels of the image renderer's map for each pixel, along each axis [default: 8 for a picture of one sample a pixel, 3 for one of
    /// several, 1.5 in a window, 0.9 in one that the CPU draws].
    #[arg(long, value_name = "N", value_parser = values::within(0.1, 16.0))]
    pub map_scale: Option<f64>,
    /// Integrate the spectrum of every ray of the raytrace renderer, instead of looking its colour up in a table.
    #[arg(long)]
    pub exact_light: bool,
    /// Colour where no surface is: linear red, green, blue, each 0 to 1 [default: the scene's sky].
    #[arg(long, value_name = "R,G,B", allow_hyphen_values = true, value_parser = values::colour)]
    pub background: Option<[f32; 3]>,
    /// Threads that transform the scene, 1 to 1024 [default: one a processor core].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1024))]
    pub threads: Option<u32>,
}

impl PictureOptions {
    /// Checks what the options say together.
    pub(super) fn check(&self) -> Result<(), String> {
        if self.exact_light && self.renderer != Renderer::Raytrace {
            return Err("--exact-light is for --renderer raytrace; leave one out or add the other".to_owned());
        }
        Ok(())
    }

    /// How radiance becomes the picture.
    pub fn development(&self) -> Development {
        Development { exposure: self.exposure, tone: self.tone, gamut: self.gamut }
    }

    /// How finely the image renderer's map is drawn for pictures that are kept.
    ///
    /// One sample a pixel is the light of one ray, so the map must be fine, and its texels must not be mixed; several samples mix by themselves.
    pub fn map_of_pictures(&self) -> MapQuality {
        let usual = if self.samples == 1 { 8.0 } else { 3.0 };
        MapQuality { texels_per_pixel: self.map_scale.unwrap_or(usual), smooth: false }
    }

    /// How finely it is drawn for a window, `software`: by the CPU.
    pub fn map_of_windows(&self, software: bool) -> MapQuality {
        let usual = if software { 0.9 } else { 1.5 };
        MapQuality { texels_per_pixel: self.map_scale.unwrap_or(usual), smooth: true }
    }
}

fn renderer(text: &str) -> Result<Renderer, ValueError> {
    let all = [Renderer::Auto, Renderer::Polygon, Renderer::Image, Renderer::Raytrace];
    all.into_iter().find(|renderer| renderer.name() == text).ok_or(ValueError::Renderer)
}
