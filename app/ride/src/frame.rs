//! One frame of a ride: the observer, and the numbers that are recorded.

use input::Controls;
use input::recording::FrameRecord;
use view::Gaze;

use crate::vehicle::{Notice, Vehicle};

/// One frame of a ride: the view that is shown, and the numbers that are recorded.
#[derive(Clone, Debug)]
pub struct RideFrame {
    /// Numbers that a replay has to reproduce to the bit.
    pub record: FrameRecord,
    /// Controls of the last tick, with all actions since the last frame. Actions that concern the ride itself have been
    /// performed already.
    pub controls: Controls,
    /// View that the frame shows: from the rider's eye along the nose, turned by the rider's look.
    pub gaze: Gaze,
    /// Vehicle as it is shown.
    pub vehicle: Vehicle,
    /// True if the ride is paused.
    pub paused: bool,
    /// Ratio of own time to real time.
    pub time_scale: f64,
    /// Notices for the rider, each once.
    pub notices: Vec<Notice>,
    /// Number of ticks that were not simulated, because the frame came late.
    pub dropped_ticks: u64,
}
