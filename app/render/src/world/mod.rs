//! A scene on the GPU: its surfaces, its light, its spectra, and how they are drawn for an eye.
//!
//! The renderers share it. Each renderer decides which positions are drawn, and for which eye: [`World::draw`] draws
//! views of the photo-surface or of the plain world, as the light that an observer sees or as weights for a map.

mod buffer_fill;
mod draw_list;
mod draws;
mod geometry;
mod materials;
mod panorama;
mod pipelines;
mod scene_world;
mod seen_draw;
mod shadow_and_light;
pub mod shift_table;

pub use buffer_fill::hand_over;
pub use draw_list::{DrawList, gather};
pub use draws::{Draws, TargetPart};
pub use geometry::{stream_count, stream_stride};
pub use pipelines::{Mode, VertexSource, effect_constants, layout};
pub use scene_world::{World, bind_group};
