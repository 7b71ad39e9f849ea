//! Pictures of the old town that were painted once, kept in the user's cache folder. Painting them takes seconds,
//! reading them a fraction of one.
//!
//! A file holds the pictures of one edition: a head, the packed planes of each picture, and a checksum of all that.
//! It is written beside its place and renamed, so that any number of programs may start at once. A file that is
//! missing, damaged or foreign means that the pictures are painted and kept anew; a folder that cannot be written
//! means that nothing is kept. Neither is a fault.

mod cache;
mod packed;
#[cfg(test)]
mod tests;

pub use cache::PictureCache;
