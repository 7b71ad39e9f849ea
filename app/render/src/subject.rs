//! Content of a picture: light, or the places that its pixels show.

/// Content of a picture, for each pixel with a surface in it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Subject {
    /// Light of the surface.
    #[default]
    Light,
    /// Place on the surface: x, y and z in metres relative to the scene's origin, and 1. For motion i the place in the
    /// object's own frame, and 2 + i. Zeros where no surface is.
    Places,
}
