//! The tests of the shaders and their Rust mirror, without a GPU.
#![allow(clippy::panic, reason = "a test fails by panicking")]

mod mirror;
