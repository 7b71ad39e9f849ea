//! How bright each pixel may be: what makes several projectors' light one even picture.

/// Factors of a channel's pixels, in linear light.
#[derive(Clone, Debug, PartialEq)]
pub struct Gains {
    /// Width and height, pixels.
    pub size: [u32; 2],
    /// What light is multiplied by, 0 to 1, row by row from the upper left: brightness correction × blending (B 4.2, 5.1.6).
    pub factors: Vec<f32>,
    /// What is then added, so that dark parts look alike where projectors' black levels add up; `None`: nothing.
    pub lifts: Option<Vec<f32>>,
}
