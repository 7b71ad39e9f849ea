//! Resolution of the channels' pictures.

use render::target::Format;

/// Fineness with which channels are drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quality {
    /// Formats of the textures that are drawn into.
    pub format: Format,
    /// Samples per pixel, one draw each.
    pub samples: u32,
    /// Texels of flat pictures per pixel of a screen that is not flat, along each axis.
    pub density: f64,
    /// True if these texels are interpolated; else the nearest one is taken.
    pub smooth: bool,
}
