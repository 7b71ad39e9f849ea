//! The errors of the photo-surface kernel.

use glam::DVec3;
use thiserror::Error;

use super::instructions::Instructions;
use crate::celerity::Celerity;

/// The reasons why vertices cannot be transformed.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum PhotoSurfaceError {
    /// A position or a celerity of the eye that is not finite, or a celerity beyond the limit.
    #[error(
        "the eye's position {position} m and celerity {celerity} must be finite numbers, the celerity no longer than {limit:e}",
        limit = Celerity::LIMIT
    )]
    Eye {
        /// Position given; world frame, metres.
        position: DVec3,
        /// Celerity given; world axes.
        celerity: DVec3,
    },
    /// An origin of the vertices that is not finite.
    #[error("the vertices' origin {origin} m must be finite: take a point near the middle of the mesh")]
    Origin {
        /// Origin given; world frame, metres.
        origin: DVec3,
    },
    /// Memory for the results that does not fit the mesh.
    #[error(
        "the output stream {stream} holds {length} values and the mesh has {vertices} vertices: they must be as many"
    )]
    OutputLength {
        /// Name of the stream: `x`, `y`, `z` or `doppler`.
        stream: &'static str,
        /// Number of values in the stream.
        length: usize,
        /// Number of vertices in the mesh.
        vertices: usize,
    },
    /// Instructions that this processor does not have.
    #[error("this processor has no {instructions:?} instructions: take Instructions::fastest()")]
    Instructions {
        /// Instructions asked for.
        instructions: Instructions,
    },
}
