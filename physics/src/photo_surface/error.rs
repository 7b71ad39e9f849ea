//! The errors of the photo-surface kernel.

use glam::DVec3;
use thiserror::Error;

use super::instructions::Instructions;
use crate::celerity::Celerity;

/// What cannot be transformed.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum PhotoSurfaceError {
    /// A position or a celerity of the eye that is not finite, or a celerity beyond the limit.
    #[error(
        "the eye's position {position} m and celerity {celerity} must be finite numbers, the celerity no longer than {limit:e}",
        limit = Celerity::LIMIT
    )]
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
