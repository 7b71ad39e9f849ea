//! The free look: where the rider looks, against the nose of the vehicle.
//!
//! Keys turn the look at a steady rate, a drag of the window's mouse turns it by angles, and a gamepad's second stick
//! turns it as far as it is pushed. It ends in the frame's gaze and nowhere else: nobody rides another way because of
//! it. Angles are functions of the last event's time and the time of asking, so the number of calls does not matter.

pub(crate) mod decoder;
pub(crate) mod free_look;

pub use decoder::LookDecoder;
pub use free_look::{FreeLook, STEEPEST_LOOK_RAD};
