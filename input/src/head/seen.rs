//! Poses that follow one another, and what makes the next one unbelievable.

use glam::DVec3;
use thiserror::Error;

use super::rigid::Rigid;
use crate::clock::{Nanos, seconds_between};

/// Over a longer gap than this, seconds, no velocity is made.
const GAP_S: f64 = 0.25;
/// A message time that goes back further than this, seconds, is a clock that was set.
const CLOCK_SET_S: f64 = 1.0;
/// No head goes faster, m/s.
const FASTEST_M_S: f64 = 5.0;
/// What noise may add to its way, metres.
const NOISE_M: f64 = 0.02;

/// Why a pose was rejected.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum PoseError {
    /// Not finite, or absurdly far away.
    #[error("a head at {0}, which is nowhere")]
    Place(DVec3),
    /// No turn.
    #[error("a quaternion of length {0}")]
    Quaternion(f64),
    /// Measured no later than the last.
    #[error("a pose that is no newer than the last")]
    Stale,
    /// A leap.
    #[error("a leap of {way_m:.2} m in {interval_s:.3} s")]
    Leap {
        /// How far.
        way_m: f64,
        /// In what time.
        interval_s: f64,
    },
}

/// A pose of the head, and its times.
#[derive(Clone, Copy, Debug)]
pub(super) struct SeenPose {
    pub(super) at: Nanos,
    pub(super) measured_s: Option<f64>,
    pub(super) room_from_head: Rigid,
}

/// The time from one pose to the next, seconds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum PoseInterval {
    /// They belong to one track.
    Steady(f64),
    /// There was a gap, or the tracker's clock was set.
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
    /// The time since then; `None` if the next pose is no newer.
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

    /// Whether a head may have gone there in this time; if not, how far it would be.
    pub(super) fn reaches(&self, next: &Self, interval: PoseInterval) -> Result<(), PoseError> {
        let way_m = self.room_from_head.position.distance(next.room_from_head.position);
        let interval_s = interval.seconds();
        if way_m <= FASTEST_M_S * interval_s + NOISE_M { Ok(()) } else { Err(PoseError::Leap { way_m, interval_s }) }
    }
}
