//! From a scene and an observer to radiance, and from radiance to a picture.
//!
//! [`polygon`] draws the photo-surface with ordinary rasterisation, [`image`] bends a map of the world pixel by pixel; both draw the same
//! [`world`], and [`SceneRenderer`] is whichever a scene is drawn by. All draw into a [`target::Radiance`] target of linear
//! values, which [`display`] turns into pixels. The crate `trace` follows single rays on the CPU, for reference.

pub mod certainty;
pub mod choice;
pub mod display;
pub mod gpu;
pub mod image;
mod moving;
pub mod picture;
pub mod polygon;
mod scene_renderer;
pub mod target;
mod textures;
mod view_matrix;
pub mod world;

pub use gpu::{Gpu, GpuError};
pub use scene_renderer::{Method, SceneRenderer, Subject};
pub use textures::{from_rows, view_from_rows};
