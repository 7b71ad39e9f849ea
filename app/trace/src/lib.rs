//! The reference: one ray of light for every sample of every pixel, followed back to where it came from (W 5.2).
//!
//! A pixel is a direction in the observer's frame. Aberration takes it to the frame of whatever it may meet, in f64 and without any
//! approximation: to the world's for what rests there, to its own for each group of meshes that moves uniformly. In that frame nothing moves, so light
//! travels along a straight line from a body that is where it always was, and a hierarchy of boxes finds the first triangle on the
//! way (`hits`). What is met in several frames is compared by its distance in the observer's, which along one sight line also orders the
//! times at which the light left. The surface there sends out what its material, sun and sky make it send out in its own frame
//! (`surface`); the observer sees it shifted and brightened (`light`).
//!
//! Mirrors and glass turn a ray in the frame in which they rest (`path`, `finish`); a lens and a shutter spread a pixel's rays over places and
//! moments (`lens`).
//!
//! What is animated rests in no frame: in its own a ray is a curve, which is followed where the body is (`curve`).
//!
//! Edges bend by themselves, and no triangle is cut. It is slow, and right: what the other renderers draw is held against it.

mod curve;
mod finish;
mod hits;
mod lens;
mod light;
mod path;
mod surface;
mod tracer;

pub use hits::Place;
pub use lens::{Lens, Optics};
pub use tracer::{RayTracer, Traced};
