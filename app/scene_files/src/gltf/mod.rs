//! Scenes from glTF 2.0 files, `.gltf` and `.glb`.
//!
//! Reading a file has several steps, each in a module of its own: `container` (its chunks), `document` (the file and
//! its buffers, at `address`es), `file_json` (its JSON, with `repair`), `accessor` and `draco` (numbers), `animation`
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
mod address;
mod animation;
mod attribute;
mod bounds;
mod container;
mod deform;
mod document;
mod draco;
mod error;
pub(crate) mod extras;
mod features;
pub(crate) mod file_json;
mod first_view;
mod floor;
mod instances;
mod instancing;
mod light;
mod load;
pub(crate) mod material;
mod nodes;
mod notices;
mod picture;
mod primitive;
mod progress;
mod repair;
mod source;
pub(crate) mod spectrum;

pub use error::{GltfError, SpectrumFault};
pub use load::{ReadRules, load};
pub use progress::{LoadStage, Progress};
