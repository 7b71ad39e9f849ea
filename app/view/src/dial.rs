//! The dial: a method of drawing with its setting, in the one form that the command line, the preferences, the tables
//! of `measure` and the renderers share.

use serde::{Deserialize, Serialize};
use std::fmt::{self, Display, Formatter};
use std::str::FromStr;
use thiserror::Error;

/// Name of a method of drawing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum RendererName {
    /// The method that suits the scene.
    #[default]
    Auto,
    /// The photo-surface of every vertex (W 5.1).
    Polygon,
    /// A map of the world around the eye, bent pixel by pixel (B chapter 5).
    Image,
    /// Every ray of light followed back by itself, on the CPU (W 5.2): the reference. It is not available in windows.
    Raytrace,
}

/// Processor that works out where vertices appear.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Transform {
    /// Every core of the CPU, in parallel with the drawing.
    #[default]
    Cpu,
    /// The GPU's vertex stage; vertices astern are left to the CPU.
    Gpu,
}

/// Use of a picture. It decides whether the picture waits for its best quality.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Occasion {
    /// A picture that is kept. It waits for its own cut, and takes single texels of a map.
    Still,
    /// One of many frames in a window. It takes the newest cut there is, and mixes a map's texels.
    Ride,
}

/// Method of drawing and its setting, under the names of the command line's options. A setting that is `None` is left
/// to the program.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct Dial {
    /// Method of drawing.
    pub renderer: RendererName,
    /// Longest edge of a triangle, metres, for `polygon`: edges are cut once to this length.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub edge: Option<f64>,
    /// Processor that transforms vertices which are cut once; the CPU if `None`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub transform: Option<Transform>,
    /// Largest distance of anything drawn from its exact place, pixels, for `polygon`: edges are cut for every picture.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tolerance: Option<f64>,
    /// Texels of the map for each pixel along each axis, for `image`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub map_scale: Option<f64>,
}

impl RendererName {
    /// Every name, in the order in which help lists them.
    pub const ALL: [Self; 4] = [Self::Auto, Self::Polygon, Self::Image, Self::Raytrace];

    /// Name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Auto => "auto",
            Self::Polygon => "polygon",
            Self::Image => "image",
            Self::Raytrace => "raytrace",
        }
    }
}

impl Transform {
    /// Name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Cpu => "cpu",
            Self::Gpu => "gpu",
        }
    }
}

impl Occasion {
    /// Tolerance that is used if none is asked for, pixels.
    pub fn usual_tolerance(self) -> f64 {
        match self {
            Self::Still => 0.5,
            Self::Ride => 1.5,
        }
    }
}

impl Dial {
    const POLYGON: Self =
        Self { renderer: RendererName::Polygon, edge: None, transform: None, tolerance: None, map_scale: None };

    /// `polygon` with edges cut once to `metres`, transformed by the CPU.
    pub const fn edge(metres: f64) -> Self {
        Self { edge: Some(metres), ..Self::POLYGON }
    }

    /// `polygon` with edges cut once to `metres`, transformed by the GPU's vertex stage.
    pub const fn vertex_stage(metres: f64) -> Self {
        Self { edge: Some(metres), transform: Some(Transform::Gpu), ..Self::POLYGON }
    }

    /// `polygon` with edges cut for every picture, to `pixels`.
    pub const fn tolerance(pixels: f64) -> Self {
        Self { tolerance: Some(pixels), ..Self::POLYGON }
    }

    /// `image` with a map of so many texels for each pixel, along each axis.
    pub const fn map(texels_per_pixel: f64) -> Self {
        Self { renderer: RendererName::Image, map_scale: Some(texels_per_pixel), ..Self::POLYGON }
    }

    /// Name of the option that is set, and its value; `None` if the whole dial is left to the program.
    pub fn turned(&self) -> Option<(&'static str, f64)> {
        let name = if self.transform == Some(Transform::Gpu) { "transform" } else { "edge" };
        let options = [(name, self.edge), ("tolerance", self.tolerance), ("map-scale", self.map_scale)];
        options.into_iter().find_map(|(name, value)| Some((name, value?)))
    }
}

impl Display for Dial {
    /// Writes the options of the command line.
    fn fmt(&self, formatter: &mut Formatter<'_>) -> fmt::Result {
        write!(formatter, "--renderer {}", self.renderer.name())?;
        for (name, value) in [("edge", self.edge), ("tolerance", self.tolerance), ("map-scale", self.map_scale)] {
            if let Some(value) = value {
                write!(formatter, " --{name} {value}")?;
            }
        }
        if self.transform == Some(Transform::Gpu) {
            write!(formatter, " --transform gpu")?;
        }
        Ok(())
    }
}

/// A text that is no dial.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum DialError {
    /// An unknown method of drawing.
    #[error("expected auto, polygon, image or raytrace")]
    Renderer,
    /// An unknown processor.
    #[error("expected cpu or gpu")]
    Transform,
    /// An unknown option, or one without a value.
    #[error("{0}: expected --renderer, --edge, --transform, --tolerance or --map-scale, each followed by its value")]
    Option(String),
    /// A value that is not a number.
    #[error("{option} {value}: expected a number")]
    Number {
        /// Option, with its dashes.
        option: String,
        /// Text that should be a number.
        value: String,
    },
}

impl FromStr for RendererName {
    type Err = DialError;

    fn from_str(text: &str) -> Result<Self, DialError> {
        Self::ALL.into_iter().find(|renderer| renderer.name() == text).ok_or(DialError::Renderer)
    }
}

impl FromStr for Transform {
    type Err = DialError;

    fn from_str(text: &str) -> Result<Self, DialError> {
        [Self::Cpu, Self::Gpu].into_iter().find(|transform| transform.name() == text).ok_or(DialError::Transform)
    }
}

impl FromStr for Dial {
    type Err = DialError;

    /// Reads what [`Dial`] displays: options with their values, in any order.
    fn from_str(text: &str) -> Result<Self, DialError> {
        let mut dial = Self::default();
        let mut words = text.split_whitespace();
        while let Some(option) = words.next() {
            let value = words.next().ok_or_else(|| DialError::Option(option.to_owned()))?;
            let number = || {
                let wrong = |_| DialError::Number { option: option.to_owned(), value: value.to_owned() };
                value.parse::<f64>().map(Some).map_err(wrong)
            };
            match option {
                "--renderer" => dial.renderer = value.parse()?,
                "--edge" => dial.edge = number()?,
                "--transform" => dial.transform = Some(value.parse()?),
                "--tolerance" => dial.tolerance = number()?,
                "--map-scale" => dial.map_scale = number()?,
                _ => return Err(DialError::Option(option.to_owned())),
            }
        }
        Ok(dial)
    }
}

#[cfg(test)]
mod tests {
    //! Law: a dial that is written is read again as the same dial. A written form that loses a setting would draw in
    //! another way.
    #![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

    use super::*;

    #[test]
    fn what_is_written_is_read() {
        for dial in [
            Dial::default(),
            Dial::edge(0.5),
            Dial::vertex_stage(0.25),
            Dial::tolerance(1.5),
            Dial::map(0.9),
            Dial { renderer: RendererName::Raytrace, ..Dial::default() },
            Dial { renderer: RendererName::Auto, ..Dial::edge(0.1) },
        ] {
            assert_eq!(dial.to_string().parse(), Ok(dial), "{dial}");
        }
    }

    #[test]
    fn the_form_is_that_of_the_command_line() {
        assert_eq!(Dial::vertex_stage(0.5).to_string(), "--renderer polygon --edge 0.5 --transform gpu");
        assert_eq!(Dial::vertex_stage(0.5).turned(), Some(("transform", 0.5)));
        assert_eq!(Dial::map(2.0).turned(), Some(("map-scale", 2.0)));
        assert_eq!(Dial::default().turned(), None);
    }

    #[test]
    fn what_is_no_dial_is_refused() {
        for (text, told) in [
            ("--renderer oil", "auto, polygon"),
            ("--edge", "--edge: expected"),
            ("--edge long", "--edge long: expected a number"),
            ("--edges 1", "--edges: expected"),
            ("--transform tpu", "cpu or gpu"),
        ] {
            let refused = text.parse::<Dial>().unwrap_err().to_string();
            assert!(refused.contains(told), "{text}: {refused}");
        }
    }
}
