//! Counts of what a transform met with.

/// Counts of the vertices of a transform.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Stats {
    /// Number of vertices transformed.
    pub vertices: usize,
    /// Number of vertices whose coordinates are not finite.
    pub not_finite_inputs: usize,
    /// Number of vertices with finite coordinates and without a finite result: too far away, or seen by an eye whose
    /// position is not finite.
    pub not_finite_results: usize,
}

impl Stats {
    /// Number of vertices that were written as zeros for want of a finite result.
    pub fn not_finite(&self) -> usize {
        self.not_finite_inputs + self.not_finite_results
    }
}
