//! Vertices and indices as EXT_meshopt_compression packs them.
//!
//! Written after the bit streams' descriptions in the extension's text (appendices A and B), and in that of
//! KHR_meshopt_compression for version 1 of the vertices.

mod decode;
mod filter;
mod indices;
mod kind;
#[cfg(test)]
mod tests;
mod triangles;
mod varint;
mod vertices;

pub use decode::decode;
pub use kind::{Codec as Mode, Filter};
