//! Text of glTF 2.0 files, before any of it means a scene: the container and its chunks, the addresses of what lies
//! outside, the JSON and its repair, and notices about the parts that are left out.
//!
//! Nothing here opens a file or takes memory in proportion to what a file claims.

pub mod address;
pub mod container;
pub mod file_json;
mod loose_json;
mod members;
pub mod notices;
pub mod repair;
