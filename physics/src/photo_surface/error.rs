//! The errors of the photo-surface kernel.

use glam::DVec3;
use thiserror::Error;

use super::instructions::Instructions;

/// What cannot be transformed.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum PhotoSurfaceError {
    /// The eye is nowhere, or its velocity is none.
    #[error("the eye's position {position} m and celerity {celerity} must be finite numbers")]
    Eye {
        /// As given; world frame, metres.
        position: DVec3,
        /// As given.
        celerity: DVec3,
    },
    /// The vertices have no origin.
    #[error("the vertices' origin {origin} m must be finite: take a point near the middle of the mesh")]
    Origin {
        /// As given; world frame, metres.
        origin: DVec3,
    },
    /// The memory for the results does not fit the mesh.
    #[error(
        "the output stream {stream} holds {length} values and the mesh has {vertices} vertices: they must be as many"
    )]
    OutputLength {
        /// `x`, `y`, `z` or `doppler`.
        stream: &'static str,
        /// Values in the stream.
        length: usize,
        /// Vertices in the mesh.
        vertices: usize,
    },
    /// This processor cannot compute as asked.
    #[error("this processor has no {instructions:?} instructions: take Instructions::fastest()")]
    Instructions {
        /// As asked for.
        instructions: Instructions,
    },
}
