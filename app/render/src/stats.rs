//! Costs of pictures, as far as a method has them.

use std::time::Duration;

/// Size and accuracy of a cut.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CutStats {
    /// Tolerance that was kept, pixels; larger than requested if that would have made too many triangles.
    pub tolerance_px: f64,
    /// Number of triangles.
    pub triangles: usize,
    /// Time that the cut took.
    pub duration: Duration,
}

/// Cost of a map.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MapStats {
    /// Number of panes drawn.
    pub panes: usize,
    /// Number of texels drawn for each carrier.
    pub texels: u64,
    /// Memory of the map on the device, bytes.
    pub bytes: u64,
    /// Texels for each pixel along each axis that there was room for.
    pub texels_per_pixel: f64,
    /// Time to plan the map, milliseconds.
    pub plan_ms: f64,
}

/// Triangles drawn, and the calls that drew them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct DrawCounts {
    /// Number of triangles, one that is drawn in several parts of a target counted for each.
    pub triangles: u64,
    /// Number of draw calls.
    pub calls: u64,
}

impl DrawCounts {
    /// The counts with one more call, of this many triangles.
    #[must_use]
    pub fn with(self, triangles: u64) -> Self {
        Self { triangles: self.triangles + triangles, calls: self.calls + 1 }
    }
}
