//! Shared parts of the benchmarks.
#![allow(dead_code, reason = "each benchmark takes some of them")]

pub mod default_path;
pub mod figures;
pub mod frame_times;
pub mod table_scenes;
pub mod words;
