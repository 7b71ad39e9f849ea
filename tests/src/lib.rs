//! What the tests of the whole system share: a graphics device, and an exact account of what it should draw.
//!
//! Nothing here is taken from the renderers. [`view`] says by itself which way a pixel looks, [`exact`] follows that direction back
//! into the world with `physics` in f64 and meets boxes analytically, [`colour`] encodes by the standard's own formula; so a sign, an
//! offset or a curve that is wrong in the program is not wrong here as well. [`bodies`] are spheres and boxes
//! in motion, with their worldlines. [`photographer`] asks the program for the same picture.

pub mod bodies;
pub mod colour;
pub mod display;
pub mod exact;
pub mod photographer;
pub mod random;
pub mod view;
