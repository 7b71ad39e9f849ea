//! Reasons why a file is no tour, or a tour cannot be played.

use regular_file::FileFault;
use std::path::PathBuf;
use thiserror::Error;

/// Reason why a file is no tour.
#[derive(Debug, Error)]
pub enum TourError {
    /// A file that cannot be read.
    #[error("{}: {fault}", path.display())]
    File {
        /// File of the tour.
        path: PathBuf,
        /// Reason.
        fault: FileFault,
    },
    /// Bytes that are no text.
    #[error("{name}: it is no UTF-8 text; save it as a text file")]
    NoText {
        /// File or name of the tour.
        name: String,
    },
    /// A key or a value that is not understood.
    #[error("{name}, line {line}: {fault}")]
    Line {
        /// File or name of the tour.
        name: String,
        /// Line in the file, from 1.
        line: usize,
        /// Description, with the key and what to do.
        fault: String,
    },
    /// A name that no built-in tour has.
    #[error("there is no tour \"{name}\": expected {known}, or a file that ends in .toml")]
    Unknown {
        /// Name that was asked for.
        name: String,
        /// Names that there are.
        known: String,
    },
}

/// Reason why a tour cannot be played in a scene.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum PlayError {
    /// A route along the scene's circuit, where there is none.
    #[error("the tour \"{title}\" rides along the circuit of its scene, which has none: give it a route of points")]
    NoCircuit {
        /// Title of the tour.
        title: String,
    },
    /// A route that cannot be ridden.
    #[error("the route of the tour \"{title}\" has fewer than two places that differ: give it more points")]
    NoRoute {
        /// Title of the tour.
        title: String,
    },
}
