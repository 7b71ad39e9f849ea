//! Progress of reading a file.

/// What `load` is doing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// Decoding pictures.
    Pictures,
    /// Placing meshes.
    Meshes,
}

/// How far `load` is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Progress {
    /// What is being done.
    pub stage: Stage,
    /// Pictures or meshes that are ready.
    pub done: usize,
    /// Pictures or meshes in all.
    pub total: usize,
}
