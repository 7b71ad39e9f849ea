//! Tests of the crate `scene_files`, one module a subject.

mod animation;
mod export;
mod gltf;
mod gltf_broken;
mod kinds;
mod shared;
mod spectra;
mod support;
mod town_file;
mod unusual;
