//! From a scene and an observer to radiance, and from radiance to a picture.
//!
//! [`polygon`] draws the photo-surface with ordinary rasterisation, [`image`] bends a map of the world pixel by pixel; both draw the same
//! [`world`], and [`SceneRenderer`] is whichever a scene is drawn by. All draw into a [`target::Radiance`] target of linear
//! values, which [`display`] turns into pixels. [`raytrace`] follows single rays on the CPU, for reference.

pub mod certainty;
pub mod choice;
pub mod display;
pub mod image;
mod moving;
pub mod picture;
pub mod polygon;
pub mod raytrace;
mod scene_renderer;
pub mod target;
pub mod world;

pub use scene_renderer::{Method, SceneRenderer, Shot, Subject};

use std::fmt::{self, Display, Formatter};
use std::str::FromStr;
use thiserror::Error;

/// What relativity does to the picture: any of its three parts.
///
/// The wavelength shift alone, L'(λ') = D L(Dλ'), keeps the radiance of all wavelengths together; the searchlight effect alone multiplies it
/// by D⁴; both are D⁵ L(Dλ') (W eq. 4.13, B eq. 2.10).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Effects {
    /// Aberration and light-travel time: where things are seen.
    pub geometry: bool,
    /// Shift of the wavelengths: in which colour.
    pub doppler: bool,
    /// The searchlight effect: how bright.
    pub searchlight: bool,
}

impl Effects {
    /// Everything, as it would be seen.
    pub const ALL: Self = Self { geometry: true, doppler: true, searchlight: true };
    /// The plain picture, as if light were infinitely fast.
    pub const NONE: Self = Self { geometry: false, doppler: false, searchlight: false };
    /// Where things are seen, in the colours and brightness that they have at rest.
    pub const GEOMETRY: Self = Self { geometry: true, ..Self::NONE };

    /// Whether colour or brightness change.
    pub fn shift_light(self) -> bool {
        self.doppler || self.searchlight
    }
}

impl Default for Effects {
    fn default() -> Self {
        Self::ALL
    }
}

impl Display for Effects {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> fmt::Result {
        let parts = [(self.geometry, "geometry"), (self.doppler, "doppler"), (self.searchlight, "searchlight")];
        let named: Vec<_> = parts.iter().filter(|(on, _)| *on).map(|(_, name)| *name).collect();
        formatter.write_str(&if named.is_empty() { "none".to_owned() } else { named.join(",") })
    }
}

/// A text that names no effects.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("expected all, none, or any of geometry, doppler and searchlight with commas between them")]
pub struct EffectsError;

impl FromStr for Effects {
    type Err = EffectsError;

    fn from_str(text: &str) -> Result<Self, EffectsError> {
        match text.trim() {
            "all" => return Ok(Self::ALL),
            "none" => return Ok(Self::NONE),
            _ => {}
        }
        let mut effects = Self::NONE;
        for name in text.split(',') {
            let effect = match name.trim() {
                "geometry" => &mut effects.geometry,
                "doppler" => &mut effects.doppler,
                "searchlight" => &mut effects.searchlight,
                _ => return Err(EffectsError),
            };
            *effect = true;
        }
        Ok(effects)
    }
}
