//! Scenes from glTF 2.0 files, `.gltf` and `.glb`.
//!
//! Reading a file has several steps, each in a module of its own: `container` (the file, its chunks and buffers),
//! `file_json` (its JSON), `accessor` (numbers in buffers), `animation` (keys), `primitive` (triangles), `nodes`
//! (their placements), `picture`, `material`, `light` and `spectrum`. The `gltf` crate gives the types of the JSON
//! only. Every index, offset and length in it is checked here before it is used: a file may come from anywhere, and
//! none may bring the program down or make it ask for more memory than [`scene::MAX_TRIANGLES`] and the limits in
//! `picture` allow.
//!
//! Node transforms are composed in f64, from the digits in the file. Only the difference from
//! [`scene::Scene::origin`] becomes f32: a street 1000 km from the file's origin keeps its millimetres.

mod accessor;
mod animation;
mod container;
mod error;
pub(crate) mod extras;
pub(crate) mod file_json;
mod light;
mod load;
pub(crate) mod material;
mod nodes;
mod notices;
mod picture;
mod primitive;
mod progress;
pub(crate) mod spectrum;

pub use error::{GltfError, SpectrumFault};
pub use load::load;
pub use progress::{LoadStage, Progress};
