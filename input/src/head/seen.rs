//! Poses that follow one another, and the checks of the next one.

use glam::DVec3;
use thiserror::Error;

use super::rigid::Rigid;
use super::unit::LengthUnit;
use crate::clock::{Nanos, seconds_between};

/// Longest gap across which a velocity is made, seconds.
const GAP_S: f64 = 0.25;
/// Step back of the message time beyond which the tracker's clock has been set, seconds.
const CLOCK_SET_S: f64 = 1.0;
/// Highest speed of a head, m/s.
const FASTEST_M_S: f64 = 5.0;
/// Largest distance that noise may add, metres.
const NOISE_M: f64 = 0.02;

/// Reason for rejecting a pose.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum PoseError {
    /// A place that is not finite, or absurdly far away.
    #[error("a head at {0}, which is nowhere")]
    Place(DVec3),
    /// A place that can only be in another unit.
    #[error(
        "a pose {distance:.0} {} from the tracker's origin: does the tracker send {}? Set scale = \"{likely}\" in [tracker]",
        .unit.plural(), .likely.plural()
    )]
    Unit {
        /// Distance from the tracker's origin, as it was sent.
        distance: f64,
        /// Unit that was assumed.
        unit: LengthUnit,
        /// Unit in which the distance is one of a head.
        likely: LengthUnit,
    },
    /// The tracker's origin without any turn, to the bit, which no sensor measures.
    #[error("the zero pose, which trackers send for a head that they have lost")]
    Zero,
    /// A quaternion that is not of length one.
    #[error("a quaternion of length {0}")]
    Quaternion(f64),
    /// A pose measured no later than the last.
    #[error("a pose that is no newer than the last")]
    Stale,
    /// A leap, faster than any head moves.
    #[error("a leap of {way_m:.2} m in {interval_s:.3} s")]
    Leap {
        /// Distance of the leap, metres.
        way_m: f64,
        /// Time of the leap, seconds.
        interval_s: f64,
    },
}

/// Pose of the head, and its times.
#[derive(Clone, Copy, Debug)]
pub(super) struct SeenPose {
    pub(super) at: Nanos,
    pub(super) measured_s: Option<f64>,
    pub(super) room_from_head: Rigid,
}

/// Time from one pose to the next, seconds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum PoseInterval {
    /// Interval within one track.
    Steady(f64),
    /// Interval over a gap, or after the tracker's clock was set.
    Gap(f64),
}

impl PoseInterval {
    pub(super) fn seconds(self) -> f64 {
        match self {
            Self::Steady(seconds) | Self::Gap(seconds) => seconds,
        }
    }
}

impl SeenPose {
    /// Time from this pose to the next; `None` if the next one is no newer.
    pub(super) fn until(&self, next: &Self) -> Option<PoseInterval> {
        let arrived_s = seconds_between(self.at, next.at);
        let measured_s = self.measured_s.zip(next.measured_s).map(|(earlier, later)| later - earlier);
        match measured_s {
            Some(measured_s) if measured_s > -CLOCK_SET_S && measured_s <= 0.0 => None,
            Some(measured_s) if measured_s > 0.0 && measured_s <= GAP_S => Some(PoseInterval::Steady(measured_s)),
            None if arrived_s <= GAP_S => Some(PoseInterval::Steady(arrived_s)),
            _ => Some(PoseInterval::Gap(arrived_s)),
        }
    }

    /// Checks that a head can move to the next pose in this time.
    pub(super) fn reaches(&self, next: &Self, interval: PoseInterval) -> Result<(), PoseError> {
        let way_m = self.room_from_head.position.distance(next.room_from_head.position);
        let interval_s = interval.seconds();
        if way_m <= FASTEST_M_S * interval_s + NOISE_M { Ok(()) } else { Err(PoseError::Leap { way_m, interval_s }) }
    }
}
