//! Order of a frame's work.

use clap::ValueEnum;

/// Order of transforming and drawing within a frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum Latency {
    /// Transform and draw one after the other, for the freshest picture.
    Low,
    /// Transform the next frame while this one is drawn, for more frames per second.
    #[default]
    Overlap,
}
