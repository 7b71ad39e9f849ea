//! Settings of the map, and its cost.

/// Resolution of the map, and the way in which it is looked up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MapQuality {
    /// Texels for each pixel of the picture, along each axis.
    pub texels_per_pixel: f64,
    /// True if texels are interpolated. If not, the nearest one is taken, so that only colours of the scene appear.
    pub smooth: bool,
}
