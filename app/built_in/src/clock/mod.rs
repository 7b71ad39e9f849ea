//! Clocks of the built-in scenes: dials with twelve seconds a round, and hands that turn by the dial's own time.

mod clock_face;
mod hand;

pub(crate) use clock_face::ClockFace;
pub(crate) use hand::HandKind;
pub use hand::{ROUND_S, ROUNDS_S};
