//! One frame of a ride: the observer, and the numbers that are recorded.

use input::Controls;
use input::head::Tracking;
use input::recording::FrameRecord;
use physics::Celerity;
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

impl RideFrame {
    /// View of the rider's own head: of the tracked head in the vehicle, which moves and turns in it; of the resting
    /// eye ([`RideFrame::gaze`]) where no tracker has seen a head. A head counts as resting while the ride is paused.
    ///
    /// *Frames, units:* the room in which the head is tracked has the vehicle's axes and its reference point as origin.
    pub fn head_gaze(&self) -> Gaze {
        let Some(head) = self.controls.head.filter(|head| head.tracked != Tracking::Never) else { return self.gaze };
        let c = self.vehicle.light_speed().speed_of_light_m_s();
        let celerity = Celerity::new(head.velocity_m_s / c).ok().filter(|_| !self.paused).unwrap_or_default();
        let eye = self.vehicle.state().aboard(head.position_m, celerity, self.vehicle.thrust());
        Gaze { observer: eye.observer(), observer_from_eye: eye.orientation * head.orientation }
    }
}
