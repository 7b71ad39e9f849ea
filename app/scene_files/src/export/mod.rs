//! Scenes to binary glTF 2.0, for other programs and for [`crate::gltf::load`], which gives back the same scene.
//!
//! Every mesh becomes a node with a mesh of its own that stands at the scene's origin. Pictures are embedded as PNG,
//! a panorama as EXR. Data that glTF cannot express (light, white, start, circuit, solid meshes) go into
//! `extras.rapidity`, spectra into `extras.spectrum`. Emission above 1 is written as a factor and a power of two as
//! `KHR_materials_emissive_strength`, so that their product is exact. Vertex colours above 1, which glTF forbids, are
//! clamped for other programs and kept in an attribute of this program's own.

mod error;
mod expressible;
mod glb;
mod lamps;
mod lists;
mod materials;
mod write_glb;

pub use error::ExportError;
pub use write_glb::write_glb;
