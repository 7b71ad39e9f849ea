//! From a scene and an observer to radiance, and from radiance to a picture.
//!
//! [`polygon`] draws the photo-surface with ordinary rasterisation. All renderers draw into a [`target::Radiance`]
//! target of linear values, which [`resolve`] turns into pixels.

pub mod picture;
pub mod polygon;
pub mod resolve;
pub mod target;

/// What of relativity is drawn. More effects come with the renderers that show them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Effects {
    /// The plain world, as if light were infinitely fast: for comparison.
    None,
    /// Aberration and light-travel time.
    #[default]
    Geometry,
}

impl std::str::FromStr for Effects {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "none" => Ok(Self::None),
            "geometry" => Ok(Self::Geometry),
            _ => Err(format!("`{text}` is no effect; choose `none` or `geometry`")),
        }
    }
}
