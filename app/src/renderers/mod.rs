//! From a scene and an observer to radiance, and from radiance to a picture.
//!
//! [`polygon`] draws the photo-surface with ordinary rasterisation. All renderers draw into a [`target::Radiance`]
//! target of linear values, which [`resolve`] turns into pixels.

pub mod picture;
pub mod polygon;
pub mod resolve;
pub mod target;

/// What relativity does to the picture. More effects come with the renderers that show them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum Effects {
    /// Nothing: the plain picture, as if light were infinitely fast, for comparison.
    None,
    /// Aberration and light-travel time: where things are seen.
    #[default]
    Geometry,
}
