//! `image`: the world around the eye drawn plainly, then bent, shifted and brightened pixel by pixel (B chapter 5).
//!
//! Light that reaches the eye now came from what is at rest in the world on straight lines. So an ordinary picture of
//! all directions, drawn in the world frame from the place of the eye, holds everything that the observer sees. That
//! map is drawn first: linear weights on the scene's spectra, in an atlas of `panes`, which are only drawn where the
//! picture sees them, and as fine as the picture needs. Then the inverse boost takes each pixel's direction to the
//! world, its weights are looked up, and their light is shifted. Straight edges bend without being cut. The number of
//! texels does not grow with the speed; the number of panes does, slowly.
//!
//! Moving bodies are not in the map, since light left them at other times than the light from behind them along the
//! same line. They are drawn over the bent map as polygons ([`MovingParts`]); the map's depth, bent as well, decides
//! what hides what. Glass at rest has no depth: bodies that move behind it are drawn over it.

mod atlas;
mod atlas_tiles;
mod image_renderer;
mod map_quality;
mod map_renderer;
mod moving_parts;
mod picture_map;

pub use image_renderer::ImageRenderer;
pub use map_quality::MapQuality;
