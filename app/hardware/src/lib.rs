//! A rider's hardware in the program: its set-up file, the tracking of the head by it, and lines on what it sends, in
//! the rider's language.

mod german;
mod head;
pub mod heard;
mod seen_head;
mod set_up;

pub use head::{DESK, TrackerError, WINDOW, head_config, usual_display};
pub use seen_head::{UnseenHead, head_line, straightened, tracking_told};
pub use set_up::{BicyclePort, SetUp, SetUpError, TrainerPlace};
