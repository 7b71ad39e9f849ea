//! Built-in scenes: the old town, a hall of three temperatures, a lattice of boxes. The same to the bit everywhere.

pub mod lattice;
pub mod spectra;
pub mod town;
mod turn;
