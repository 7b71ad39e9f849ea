//! Darkening of the edges of a headset's pictures.

use clap::ValueEnum;

/// Darkening of the edges of a headset's pictures with motion that the rider sees and does not feel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum Vignette {
    /// None: all of the world is seen.
    #[default]
    Off,
    /// The outermost parts of the pictures grow darker.
    Weak,
    /// All but the middle of the pictures grows black.
    Strong,
}
