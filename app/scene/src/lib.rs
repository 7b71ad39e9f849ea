//! A scene: flattened meshes, at rest in the world or moving, their materials, and the light that falls on them.
//!
//! A scene is plain data. Files are read by `gltf` and `panorama`; built-in scenes are made by `town`, `spectra` and
//! `lattice`. Each gives a [`Scene`], which everything else reads: refinement, collision, renderers, export.
//! Instances are flattened (W 5.1.6), because the relativistic transform does not commute with a node's affine one.
//!
//! Positions are f32 metres relative to [`Scene::origin`], which is f64: a scene a million kilometres from
//! the world's origin keeps its millimetres.

pub mod carriers;
mod clock;
pub mod collision;
pub mod cut;
mod extent;
pub mod irradiance;
mod lamp;
mod lighting;
mod material;
mod mesh;
pub mod mipmap;
pub mod motion;
mod panorama;
mod place;
pub mod refine;
mod scene;
mod speed_limit;
mod surroundings;
mod triangle_point;
mod validate;

pub use clock::{ClockReading, SceneClock};
pub use lamp::{Lamp, Lamplight, Spot};
pub use lighting::Lighting;
pub use material::{Alpha, Material, Texture, Wrap};
pub use mesh::Mesh;
pub use panorama::Panorama;
pub use place::{LocalName, NamedPlace};
pub use scene::{MAX_SPECTRA, MAX_TRIANGLES, Scene, Start, ViewCamera};
pub use speed_limit::{Fastest, TooFast};
pub use surroundings::{Ground, OpenPlane, OpenSpace, Surroundings, Wall};
pub use validate::SceneFault;
