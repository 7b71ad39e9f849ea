//! The head: from a tracker's poses to where the eyes are and how fast they go.
//!
//! A tracker says how its sensor stands in its own axes. With the two transforms that the laboratory
//! has measured,
//!
//! room_from_head = room_from_tracker · tracker_from_sensor · sensor_from_head,
//!
//! where the head's origin is midway between the eyes, so the velocity, made of differences of that
//! origin's places, is the eyes' and not the sensor's: when the head turns, the two differ.
//!
//! Times: a velocity is a difference of the times at which the tracker *measured*, where it says so,
//! for those do not jitter with the network; how old a pose is goes by its arrival.
//!
//! What cannot be is rejected and counted ([`PoseError`]): numbers that are none, quaternions that are
//! none, poses that are older than the last, and leaps faster than anybody moves, unless the next pose
//! says the same. A head that is lost keeps its place, and its velocity fades. Nothing ever takes it
//! to the origin.

mod config;
mod limit;
mod mouse;
mod placement;
mod rigid;
mod url;
mod velocity;

use glam::{DQuat, DVec3};
use serde::{Deserialize, Serialize};
use thiserror::Error;

pub use config::{HeadConfig, TrackingMode, VelocityFilter};
pub use limit::{celerity, limited};
pub use mouse::{Mouse, MouseButton, MouseEvent};
pub use placement::Placement;
pub use rigid::Rigid;
pub use url::{TrackerUrl, TrackerUrlError};
pub use velocity::Velocity;

use crate::config::ConfigError;
use crate::decoder::Faults;
use crate::sample::{Nanos, seconds_between};
use placement::{FARTHEST_M, UNIT_LENGTHS};

/// A pose may be this old before its velocity begins to fade, seconds: three frames at 60 Hz.
const GRACE_S: f64 = 0.05;
/// Or this old, in intervals of a slow tracker.
const GRACE_FRAMES: f64 = 1.5;
/// Over a longer gap than this, seconds, no velocity is made.
const GAP_S: f64 = 0.25;
/// A message time that goes back further than this, seconds, is a clock that was set.
const CLOCK_SET_S: f64 = 1.0;
/// No head goes faster, m/s.
const FASTEST_M_S: f64 = 5.0;
/// What noise may add to its way, metres.
const NOISE_M: f64 = 0.02;

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

/// How far a head is to be believed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Tracking {
    /// The tracker has not seen it yet.
    #[default]
    Never,
    /// The tracker sees it.
    Tracked,
    /// It has just been lost: its velocity fades.
    Fading,
    /// It has been lost: it is where it was, at rest.
    Lost,
}

/// The head at one moment.
///
/// *Frames, units*: the room's axes: x right, y up, z backward; metres.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct HeadState {
    /// Midway between the eyes.
    pub position_m: DVec3,
    /// `room_from_head`: the head looks along its −z, its right ear is at +x.
    pub orientation: DQuat,
    /// How fast it goes in the vehicle, in metres for a second of the user's own time: c times the
    /// celerity, [`celerity`].
    pub velocity_m_s: DVec3,
    /// How far this is to be believed.
    pub tracked: Tracking,
}

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
struct Seen {
    at: Nanos,
    measured_s: Option<f64>,
    room_from_head: Rigid,
}

/// The time from one pose to the next, seconds.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Interval {
    /// They belong to one track.
    Steady(f64),
    /// There was a gap, or the tracker's clock was set.
    Gap(f64),
}

impl Interval {
    fn seconds(self) -> f64 {
        match self {
            Self::Steady(seconds) | Self::Gap(seconds) => seconds,
        }
    }
}

impl Seen {
    /// The time since then; `None` if the next pose is no newer.
    fn until(&self, next: &Self) -> Option<Interval> {
        let arrived_s = seconds_between(self.at, next.at);
        let measured_s = self.measured_s.zip(next.measured_s).map(|(earlier, later)| later - earlier);
        match measured_s {
            Some(measured_s) if measured_s > -CLOCK_SET_S && measured_s <= 0.0 => None,
            Some(measured_s) if measured_s > 0.0 && measured_s <= GAP_S => Some(Interval::Steady(measured_s)),
            None if arrived_s <= GAP_S => Some(Interval::Steady(arrived_s)),
            _ => Some(Interval::Gap(arrived_s)),
        }
    }

    /// Whether a head may have gone there in this time; if not, how far it would be.
    fn reaches(&self, next: &Self, interval: Interval) -> Result<(), PoseError> {
        let way_m = self.room_from_head.position.distance(next.room_from_head.position);
        let interval_s = interval.seconds();
        if way_m <= FASTEST_M_S * interval_s + NOISE_M { Ok(()) } else { Err(PoseError::Leap { way_m, interval_s }) }
    }
}

/// A tracked head: fed poses in the order in which they came, asked once a frame.
#[derive(Debug)]
pub struct Head {
    config: HeadConfig,
    room_from_tracker: Rigid,
    sensor_from_head: Rigid,
    last: Option<Seen>,
    /// A pose that leapt away, which the next may confirm.
    leapt: Option<Seen>,
    velocity: Velocity,
    /// The last interval between poses of one track, seconds.
    rhythm_s: f64,
    /// When the tracker went.
    gone: Option<Nanos>,
    rejected: Faults,
}

impl Head {
    /// A head that has not been seen.
    ///
    /// # Errors
    /// Names a setting that cannot be used.
    pub fn new(config: HeadConfig) -> Result<Self, ConfigError> {
        config.check()?;
        Ok(Self {
            room_from_tracker: config.room_from_tracker.rigid(),
            sensor_from_head: config.head_from_sensor.rigid().inverse(),
            last: None,
            leapt: None,
            velocity: Velocity::new(config.velocity),
            rhythm_s: 0.0,
            gone: None,
            rejected: Faults::default(),
            config,
        })
    }

    /// How it is tracked.
    pub fn config(&self) -> &HeadConfig {
        &self.config
    }

    /// Poses that were rejected so far, and why the last one was.
    pub fn rejected(&self) -> &Faults {
        &self.rejected
    }

    /// Takes a pose; those of other sensors are passed over.
    pub fn pose(&mut self, pose: &TrackedPose) {
        if pose.sensor != self.config.sensor {
            return;
        }
        if let Err(error) = self.accept(pose) {
            self.rejected.count(error.to_string());
        }
    }

    /// The tracker came or went: from now on the head is lost, until it is seen again.
    pub fn gone(&mut self, at: Nanos) {
        self.gone.get_or_insert(at);
    }

    fn accept(&mut self, pose: &TrackedPose) -> Result<(), PoseError> {
        let mut seen = self.sound(pose)?;
        let Some(last) = self.last else {
            self.velocity.restart(seen.room_from_head.position, DVec3::ZERO);
            return self.see(seen);
        };

        // Keep the sign of the quaternion, so that neighbours can be compared.
        if last.room_from_head.orientation.dot(seen.room_from_head.orientation) < 0.0 {
            seen.room_from_head.orientation = -seen.room_from_head.orientation;
        }

        // A leap counts once it has been said twice.
        let interval = last.until(&seen).ok_or(PoseError::Stale)?;
        if let Err(leap) = last.reaches(&seen, interval) {
            let confirmed = match &self.leapt {
                None => false,
                Some(leapt) => {
                    let interval = leapt.until(&seen).ok_or(PoseError::Stale)?;
                    leapt.reaches(&seen, interval).is_ok()
                }
            };
            if !confirmed {
                self.leapt = Some(seen);
                return Err(leap);
            }
            // The leap itself is no motion.
            self.velocity.restart(seen.room_from_head.position, self.velocity.value());
            return self.see(seen);
        }

        match interval {
            Interval::Steady(interval_s) => {
                self.velocity.push(interval_s, seen.room_from_head.position);
                self.rhythm_s = interval_s;
            }
            Interval::Gap(_) => {
                let (_, share) = self.belief(&last, seen.at);
                self.velocity.restart(seen.room_from_head.position, self.velocity.value() * share);
            }
        }
        self.see(seen)
    }

    fn see(&mut self, seen: Seen) -> Result<(), PoseError> {
        (self.last, self.leapt, self.gone) = (Some(seen), None, None);
        Ok(())
    }

    /// The head's pose, if the sensor's makes sense.
    fn sound(&self, pose: &TrackedPose) -> Result<Seen, PoseError> {
        let length = pose.orientation.length();
        if !UNIT_LENGTHS.contains(&length) {
            return Err(PoseError::Quaternion(length));
        }
        if !pose.position_m.is_finite() || pose.position_m.abs().max_element() > FARTHEST_M {
            return Err(PoseError::Place(pose.position_m));
        }
        let tracker_from_sensor = Rigid { position: pose.position_m, orientation: pose.orientation.normalize() };
        let room_from_head = self.room_from_tracker * tracker_from_sensor * self.sensor_from_head;
        let measured_s = pose.measured_s.filter(|seconds| seconds.is_finite());
        Ok(Seen { at: pose.at, measured_s, room_from_head })
    }

    /// How far a pose is to be believed at the time `at`, and the share of its velocity.
    fn belief(&self, last: &Seen, at: Nanos) -> (Tracking, f64) {
        let unseen_s = seconds_between(last.at, at) - GRACE_S.max(GRACE_FRAMES * self.rhythm_s);
        let gone_s = self.gone.map_or(f64::NEG_INFINITY, |gone| seconds_between(gone, at));
        let fading_s = unseen_s.max(gone_s);
        if fading_s <= 0.0 && self.gone.is_none() {
            (Tracking::Tracked, 1.0)
        } else if fading_s < self.config.fade_s {
            (Tracking::Fading, 1.0 - fading_s.max(0.0) / self.config.fade_s)
        } else {
            (Tracking::Lost, 0.0)
        }
    }

    /// The head at the time `at`.
    pub fn state(&self, at: Nanos) -> HeadState {
        let Some(last) = &self.last else {
            return HeadState {
                position_m: DVec3::from_array(self.config.home),
                orientation: DQuat::IDENTITY,
                velocity_m_s: DVec3::ZERO,
                tracked: Tracking::Never,
            };
        };
        let (tracked, share) = self.belief(last, at);
        let Rigid { position, orientation } = last.room_from_head;
        HeadState { position_m: position, orientation, velocity_m_s: self.velocity.value() * share, tracked }
    }
}

impl TrackingMode {
    /// What of a head this mode uses.
    pub fn of(self, state: HeadState) -> Option<HeadState> {
        match self {
            Self::PositionAndVelocity => Some(state),
            Self::Position => Some(HeadState { velocity_m_s: DVec3::ZERO, ..state }),
            Self::None => None,
        }
    }
}

#[cfg(test)]
mod tests;
