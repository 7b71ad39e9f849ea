//! The units in which vertices are stored and worked on.

/// Number of vertices in a chunk, the unit of work of a thread. The speed is the same from 2,000 to 32,000.
pub const CHUNK: usize = 8192;

/// Number of vertices in a line: two of the widest registers.
pub(super) const LINE: usize = 32;

/// A line of one coordinate, aligned to a cache line.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub(super) struct VertexLine(pub(super) [f32; LINE]);
