//! A rider's hardware in the program: its set-up file, the tracking of the head by it, and lines on what it sends.

mod head;
pub mod heard;
mod set_up;

pub use head::{DESK, TrackerError, WINDOW, head_config, usual_display};
pub use set_up::{BicyclePort, SetUp, SetUpError, TrainerPlace};
