//! Scenes from glTF 2.0 files, `.gltf` and `.glb`.
//!
//! A file passes several doors, each in a module of its own: `container` (the file, its chunks and buffers), `accessor`
//! (numbers in buffers), `animation` (keys), `primitive` (triangles), `nodes` (where they stand), `picture`, `material`, `light` and `spectrum`. The `gltf` crate only reads
//! the JSON; every index, offset and length in it is looked up with a check here, because a file may come from
//! anywhere and none may bring the program down or make it ask for more memory than [`scene::MAX_TRIANGLES`] and the limits in `picture` allow.
//!
//! Node transforms are composed in f64, from the digits in the file, and only what is left after subtracting
//! [`scene::Scene::origin`] becomes f32: a street 1000 km from the file's origin keeps its millimetres.

mod accessor;
mod animation;
mod container;
mod error;
pub(crate) mod extras;
mod light;
mod load;
mod material;
mod nodes;
mod notices;
mod picture;
mod primitive;
mod progress;
pub(crate) mod spectrum;

pub use error::{GltfError, SpectrumFault};
pub use load::load;
pub use progress::{Progress, Stage};
