//! Reasons why a scene cannot be refined.

use crate::validate::SceneFault;

/// Reason why a scene cannot be refined.
#[derive(Debug, thiserror::Error)]
pub enum RefineError {
    /// A length that is not a finite number above 0.
    #[error("an edge cannot be {0} m long; use a length above 0, such as --edge 0.5")]
    Edge(f32),
    /// A result with too many triangles.
    #[error(
        "edges of {edge} m would make at least {triangles} triangles of scene \"{scene}\" ({limit} are possible); \
         use --edge {enough} or more"
    )]
    TooMany {
        /// Name of the scene.
        scene: String,
        /// Requested length of edges, metres.
        edge: f32,
        /// Lower bound of their number.
        triangles: u64,
        /// Largest number allowed.
        limit: usize,
        /// Length that stays within the limit, metres.
        enough: f32,
    },
    /// Coordinates that are too large for edges so short.
    #[error(
        "edges of {edge} m are shorter than the coordinates of mesh \"{mesh}\" can resolve; use --edge {enough} or \
         more, or move the mesh closer to the scene's origin"
    )]
    TooFine {
        /// Name of the mesh.
        mesh: String,
        /// Requested length of edges, metres.
        edge: f32,
        /// Shortest length that this mesh allows, metres.
        enough: f32,
    },
    /// A scene that breaks a promise of its types.
    #[error(transparent)]
    Damaged(#[from] SceneFault),
}
