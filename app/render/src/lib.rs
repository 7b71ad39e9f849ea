//! From a scene and an observer to radiance, and from radiance to a picture.
//!
//! `polygon` draws the photo-surface with ordinary rasterisation, `image` bends a map of the world pixel by
//! pixel; both draw the same [`world`], and [`SceneRenderer`] draws a scene by either of them. All draw into a
//! [`target::Radiance`] target of linear values, which [`display`] turns into pixels. The crate `trace` follows
//! single rays on the CPU, for reference.

pub mod certainty;
pub mod choice;
pub mod display;
mod format;
mod gpu;
mod hidden_area;
mod image;
mod method;
mod moving_objects;
mod outside;
mod pending;
mod polygon;
mod scene_renderer;
mod stats;
mod subject;
pub mod target;
mod textures;
mod view_matrix;
pub mod world;

pub use gpu::{Gpu, GpuError, descriptor};
pub use hidden_area::HiddenArea;
pub use pending::Pending;
pub use scene_renderer::{BentScreen, SceneRenderer, TransformReport};
pub use stats::{CutStats, DrawCounts, MapStats};
pub use subject::Subject;
pub use textures::{from_rows, view_from_rows};
pub use view_matrix::{near_m, shader_view};
