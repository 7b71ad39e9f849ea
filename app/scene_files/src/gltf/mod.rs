//! Scenes from glTF 2.0 files, `.gltf` and `.glb`.
//!
//! Reading a file has several steps, each in a module of its own: `document` (the file and its buffers; its text
//! is the crate `gltf_text`'s), `accessor` and `draco` (numbers), `animation`
//! (keys), `nodes` and `instancing` (placements), `primitive` and `deform` (triangles), `picture`, `material`, `light`,
//! `spectrum` and `first_view`. The `gltf` crate gives the types of the JSON only. Every index, offset and length in
//! it is checked here before it is used: a file may come from anywhere, and none may bring the program down or make
//! it take more memory than its [`Budget`](regular_file::Budget).
//!
//! A faulty part is left out and named (`notices`), and the rest is drawn.
//!
//! Node transforms are composed in f64, from the digits in the file. Only the difference from
//! [`scene::Scene::origin`] becomes f32: a street 1000 km from the file's origin keeps its millimetres.

mod accessor;
mod animation;
mod attribute;
mod bounds;
mod deform;
mod document;
mod draco;
mod error;
pub(crate) mod extras;
mod features;
mod first_view;
mod floor;
mod instances;
mod instancing;
mod light;
mod load;
pub(crate) mod material;
mod nodes;
mod picture;
mod primitive;
mod progress;
mod source;
pub(crate) mod spectrum;
mod specular;
mod start_pose;

pub(crate) use gltf_text::file_json;
use gltf_text::{container, notices};

pub use error::{GltfError, SpectrumFault};
pub use load::{ReadRules, load};
pub use progress::{LoadStage, Progress};
