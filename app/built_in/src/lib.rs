//! Built-in scenes, the same to the bit everywhere: the old town, a hall of three temperatures, a lattice of boxes; a
//! row of dice, a train with clocks, and the laboratory of a cube and a sphere.

pub mod clock;
pub mod dice;
pub mod laboratory;
pub mod lattice;
mod open_country;
mod shape;
pub mod spectra;
pub mod town;
pub mod train;
mod turn;
