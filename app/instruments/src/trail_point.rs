//! Points of a trail.

use physics::Event;

/// Point of the ride's worldline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TrailPoint {
    /// Event, world frame.
    pub event: Event,
    /// Time on the vehicle's own clock, seconds.
    pub own_s: f64,
    /// True if a line begins here: at the start, and after a jump.
    pub begins: bool,
}
