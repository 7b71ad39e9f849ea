//! The reference renderer: one ray of light for every sample of every pixel, followed back to its source (W 5.2).
//!
//! A pixel is a direction in the observer's frame. Aberration takes it, in f64 and without approximation, to the
//! frame of every body that it may meet (`observer`): the world's for the resting scene, its own for each group of
//! meshes that moves uniformly. In that frame nothing moves. Light therefore travels along a straight line from a body
//! that does not change its place, and a hierarchy of boxes finds the first triangle on the way (`bodies`,
//! `triangles`). Hits in several frames are compared by their distance in the observer's frame, which along one sight
//! line also orders the times at which the light left. The surface there emits what its material, sun and sky make it
//! emit in its own frame (`surface`); the observer sees it shifted and brightened (`light`).
//!
//! Mirrors and glass turn a ray in the frame in which they rest (`path`, `finish`). A lens and a shutter spread a
//! pixel's rays over places and moments (`lens`).
//!
//! Animated bodies rest in no frame. In the body's own frame a ray is a curve, which is followed near the body
//! (`curve`, `swept`).
//!
//! Edges bend without any cut of triangles. The tracer is slow and exact: the pictures of the other renderers are
//! compared with its pictures.

mod bodies;
mod curve;
mod finish;
mod hit;
mod light;
mod observer;
mod path;
mod surface;
mod swept;
mod tracer;
mod triangles;

pub use hit::TracedPlace;
pub use tracer::{RayTracer, Traced};
