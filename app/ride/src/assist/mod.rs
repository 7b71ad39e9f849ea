//! Assisted steering: what keeps a rider in the street who only pedals.
//!
//! The assist steers along the circuit that the scene names where that is near, else where the walls leave room
//! ([`ways`]). It eases off before bends. A hand that steers wins at once; the assist comes
//! back in softly after it. It changes the controls of the vehicle only: what is recorded is what the rider wants, and
//! a replay computes the same assistance from it.

mod helmsman;
mod mode;
mod ways;

pub use helmsman::Assist;
pub use mode::AssistMode;
