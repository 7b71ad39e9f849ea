//! One measurement of a tracker.

use glam::{DQuat, DVec3};

use crate::clock::Nanos;

/// What a tracker says about one of its sensors.
///
/// *Frames, units*: the tracker's axes; metres, seconds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TrackedPose {
    /// Number of the sensor, or body.
    pub sensor: i32,
    /// When it arrived.
    pub at: Nanos,
    /// When it was measured, on the tracker's clock, from which only differences are of use.
    pub measured_s: Option<f64>,
    /// How long before its sending it was measured, where the tracker says so.
    pub latency_s: Option<f64>,
    /// Where.
    pub position_m: DVec3,
    /// `tracker_from_sensor`, as it came.
    pub orientation: DQuat,
    /// The sensor's velocity by the tracker's own reckoning, m/s. The head's is made of places, since
    /// this is not the velocity of the eyes.
    pub velocity_m_s: Option<DVec3>,
}
