//! Tests of the crate `camera_paths`, one module a subject.

mod circle;
mod documented;
mod gltf_camera;
mod keys;
mod legs;
mod parts;
mod refused;
mod support;
