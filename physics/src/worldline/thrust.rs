//! Thrust and turn rate of a vehicle at one instant.

use glam::DVec3;

/// Push and turn at one instant, both in the pilot's own axes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Thrust {
    /// Proper acceleration, what an accelerometer on board shows, in units of c² per metre (1/m).
    pub acceleration: DVec3,
    /// Rotation against gyroscopes on board, right-handed, in radians per metre of proper time.
    pub turn_rate: DVec3,
}
