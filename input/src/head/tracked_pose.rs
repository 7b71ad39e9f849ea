//! Measurement of a tracker.

use glam::{DQuat, DVec3};

use crate::clock::Nanos;

/// Pose of one of a tracker's sensors.
///
/// *Frames, units*: the tracker's axes; metres, seconds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TrackedPose {
    /// Number of the sensor, or body.
    pub sensor: i32,
    /// Time of arrival.
    pub at: Nanos,
    /// Time of the measurement on the tracker's clock, of which only differences are of use.
    pub measured_s: Option<f64>,
    /// Time from the measurement to its sending, where the tracker gives it.
    pub latency_s: Option<f64>,
    /// Place of the sensor.
    pub position_m: DVec3,
    /// Turn `tracker_from_sensor`, as it came.
    pub orientation: DQuat,
    /// Velocity of the sensor as the tracker computes it, m/s. The head's velocity is made from places, since this is
    /// not the velocity of the eyes.
    pub velocity_m_s: Option<DVec3>,
}
