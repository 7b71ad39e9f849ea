//! Counts of what a transform met with.

/// What a transform met with.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Stats {
    /// Vertices transformed.
    pub vertices: usize,
    /// Vertices whose coordinates are not finite.
    pub not_finite_inputs: usize,
    /// Vertices with finite coordinates whose results are not: too far away.
    pub not_finite_results: usize,
}

impl Stats {
    /// All vertices that were written as zeros for want of a finite result.
    pub fn not_finite(&self) -> usize {
        self.not_finite_inputs + self.not_finite_results
    }
}
