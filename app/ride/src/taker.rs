//! Taker of frames between the frames of a ride, as a film needs them.

use input::Nanos;

use crate::frame::RideFrame;

/// Whoever wants frames at times of its own, on the way from one frame of a ride to the next.
pub trait FrameTaker {
    /// Times of the frames that are wanted up to `at`, the time of the ride's next frame: later than the one before,
    /// none later than `at`, in their order. Asked once for each frame of the ride.
    fn wanted(&mut self, at: Nanos) -> Vec<Nanos>;

    /// Takes the frame at the next of the wanted times.
    ///
    /// Its record bears the number of the ride's next frame, its actions are all since the ride's last frame, and its
    /// head and look glide from one report of their device to the next, an interval of reports late.
    fn take(&mut self, frame: RideFrame);
}
