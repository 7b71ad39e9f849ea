//! A headset through OpenXR: the graphics device that its runtime wants, the session, and a picture for each eye.
//!
//! One turn: [`Headset::wait`] waits until the runtime wants a frame, and tells when it will be seen, where head and
//! hands will be then, and what each eye sees. The ride takes head and hands as a sample
//! ([`HeadsetTurn::report`]), as it takes those of every tracker, and draws; [`Headset::show`] hands the pictures over.
//!
//! While the runtime does not see the head, [`HeadFade`] says how dark the pictures are.
//!
//! What is drawn is what `walls` draws: two screens that move with the head ([`room::Display::headset`]). The runtime
//! may turn a late picture after the head. For a turn that is exact: aberration does not depend on where one looks. For
//! a step it is not, as in every program.

mod device;
mod error;
mod fade;
mod pictures;
mod session;

pub use device::HeadsetDevice;
pub use error::HeadsetError;
pub use fade::HeadFade;
pub use pictures::{DEPTH_NEAR_M, TurnPictures};
pub use session::{Headset, HeadsetTurn};
