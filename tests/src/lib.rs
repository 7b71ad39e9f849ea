//! Shared parts of the system tests: a graphics device, and an exact account of the pictures that it should draw.
//!
//! Nothing here is taken from the renderers. [`view`] computes the direction of a pixel by itself; [`exact`] follows
//! that direction back into the world with `physics` in f64 and meets boxes analytically; [`colour`] encodes by the
//! standard's own formula. So a wrong sign, offset or curve in the program is not repeated here. [`bodies`] are spheres
//! and boxes in motion, with their worldlines. [`occupants`] have eyes in a vehicle. [`photographer`] asks the program
//! for the same picture. [`turns`] keep tests that need much memory from running at once. [`house`] measures the
//! sources.

pub mod bodies;
pub mod colour;
pub mod display;
pub mod exact;
pub mod house;
pub mod lorentz;
pub mod occupants;
pub mod photographer;
pub mod turns;
pub mod view;
