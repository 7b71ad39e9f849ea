//! Laws of a ride with a headset, tried on a real OpenXR runtime whose headset is simulated: `make test-headset`.
//!
//! The runtime's head is never at rest, and its controllers are held before it. What else happens to a headset, a layer
//! between program and runtime plays out (`xr_layer`).
#![allow(clippy::unwrap_used, clippy::panic, reason = "a failed construction is a failed test")]

#[path = "../program/runner.rs"]
#[allow(dead_code, reason = "the tests of the program use all of it")]
mod runner;

mod life;
mod rides;
mod tracker;
#[path = "../program/virtual_display.rs"]
#[allow(dead_code, reason = "the tests of the program use all of it")]
mod virtual_display;
