//! Progress of reading a file.

/// Stage of `load`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LoadStage {
    /// Decoding of pictures.
    Pictures,
    /// Placing of meshes.
    Meshes,
}

/// Progress of `load`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Progress {
    /// Current stage.
    pub stage: LoadStage,
    /// Number of pictures or meshes that are ready.
    pub done: usize,
    /// Total number of pictures or meshes.
    pub total: usize,
}
