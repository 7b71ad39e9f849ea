//! Row of the table of dials.

use view::Dial;

/// Results for a setting.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// Method and its setting.
    pub dial: Dial,
    /// Time of a picture, milliseconds: median and 95th percentile.
    pub ms: [f64; 2],
    /// Times of bending, uploading and drawing, milliseconds: median and 95th percentile.
    pub stages_ms: [[f64; 2]; 3],
    /// Largest memory of the renderer on the device, bytes, if the driver tells.
    pub bytes: Option<f64>,
    /// Number of pixels that showed a surface, in all pictures.
    pub pixels: usize,
    /// Direction errors, minutes of arc: median, 99th percentile and largest.
    pub arcmin: [f64; 3],
    /// Share of pixels that are off by more than one minute of arc.
    pub above_one: f64,
    /// Colour errors of stills: ΔE2000 of their pixels, median, 99th percentile and largest, and FLIP.
    pub colour: Option<([f64; 3], f64)>,
    /// True if no other setting is both faster and more accurate (by the 99th percentile).
    pub best: bool,
}
