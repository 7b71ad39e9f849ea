//! Compressed meshes and pictures: bytes to numbers, within a bound of memory.
//!
//! Every decoder is a pure function of bytes and of a budget. No input makes one panic, run for longer than its size
//! explains, or take memory that the budget does not hold.

pub mod draco;
mod error;
mod loan;
pub mod meshopt;
#[cfg(test)]
mod mutations;
pub mod picture;

pub use error::DecodeError;
