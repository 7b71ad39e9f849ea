//! The tracked head: poses in; place, turn and velocity out.

use glam::{DQuat, DVec3};

use super::config::{HeadConfig, Recentring};
use super::flip::mirrored;
use super::placement::{FARTHEST_M, UNIT_LENGTHS};
use super::rigid::Rigid;
use super::seen::{PoseError, PoseInterval, SeenPose};
use super::snap_step::is_step;
use super::stance::Stance;
use super::state::{HeadState, Tracking};
use super::tracked_pose::TrackedPose;
use super::unit::LengthUnit;
use super::url::TrackerUrl;
use super::velocity::TrackVelocity;
use crate::clock::{Nanos, seconds_between};
use crate::config_error::ConfigError;
use crate::faults::Faults;

/// Age of a pose at which its velocity begins to fade, seconds: three frames at 60 Hz.
const GRACE_S: f64 = 0.05;
/// Age of a pose at which its velocity begins to fade, in intervals of a slow tracker; the larger of both counts.
const GRACE_FRAMES: f64 = 1.5;

/// Largest distance from a tracker's origin in a unit that nobody has named, metres: no hall is larger.
const FARTHEST_IN_ROOM_M: f64 = 50.0;
/// Largest distance from opentrack's centre in a unit that nobody has named, metres: no chair is rolled farther.
const FARTHEST_AT_DESK_M: f64 = 5.0;

/// Steps of the turn per radian a second: far below the noise of any tracker, they keep recordings short.
const TURN_STEPS: f64 = 1e5;

/// Tracked head. Poses are fed in the order in which they came, and the state is read once a frame.
#[derive(Debug)]
pub struct TrackedHead {
    config: HeadConfig,
    room_from_tracker: Rigid,
    sensor_from_head: Rigid,
    /// Transform to the room from where the straight pose is at home, once a pose has been declared straight.
    room_from_straight: Option<Rigid>,
    last: Option<SeenPose>,
    /// Pose that leapt away, which the next one may confirm.
    leapt: Option<SeenPose>,
    /// True if the tracker's axes have moved since the last pose.
    moved: bool,
    velocity: TrackVelocity,
    /// Velocity of the sum of all small turns, a vector along their axes, radians.
    turn: TrackVelocity,
    turned_rad: DVec3,
    /// Last interval between poses of one track, seconds.
    rhythm_s: f64,
    /// Time at which the tracker went.
    gone: Option<Nanos>,
    rejected: Faults,
}

impl TrackedHead {
    /// Head that has not been seen yet.
    ///
    /// # Errors
    /// A setting that cannot be used.
    pub fn new(config: HeadConfig) -> Result<Self, ConfigError> {
        config.check()?;
        Ok(Self {
            room_from_tracker: room_from_tracker(&config),
            room_from_straight: None,
            sensor_from_head: config.head_from_sensor.rigid().inverse(),
            last: None,
            leapt: None,
            moved: false,
            velocity: TrackVelocity::new(config.velocity),
            turn: TrackVelocity::new(config.velocity),
            turned_rad: DVec3::ZERO,
            rhythm_s: 0.0,
            gone: None,
            rejected: Faults::default(),
            config,
        })
    }

    /// Settings of the head.
    pub fn config(&self) -> &HeadConfig {
        &self.config
    }

    /// Poses that were rejected so far, and the reason for the last one.
    pub fn rejected(&self) -> &Faults {
        &self.rejected
    }

    /// Takes a pose; poses of other sensors are passed over.
    pub fn pose(&mut self, pose: &TrackedPose) {
        if pose.sensor != self.config.sensor {
            return;
        }
        if let Err(error) = self.accept(pose) {
            if error == PoseError::Zero {
                self.gone(pose.at);
            }
            self.rejected.count(error.to_string());
        }
    }

    /// Marks the head as lost until it is seen again: the tracker came or went.
    pub fn gone(&mut self, at: Nanos) {
        self.gone.get_or_insert(at);
    }

    /// Takes note that the tracker has moved its axes: the way to the next pose is no motion. Where the rider may
    /// declare a pose to be the straight one, that pose is, as the tracker's own recentring means it.
    pub fn axes_moved(&mut self) {
        self.moved = true;
    }

    /// True if the rider may declare a pose to be the straight one.
    pub fn recentres(&self) -> bool {
        self.config.recentre != Recentring::Never
    }

    /// Transform to the room from where the straight pose is at home; what else the tracker sees passes it, too.
    pub(crate) fn room_from_straight(&self) -> Rigid {
        self.room_from_straight.unwrap_or(Rigid::IDENTITY)
    }

    /// Declares the last pose to be the straight one, at home and facing −z. Does nothing before the first pose, or in
    /// a room that its tracker is calibrated to.
    pub fn recentre(&mut self) {
        if let Some(seen) = self.last.filter(|_| self.recentres()) {
            self.straighten(seen);
        }
    }

    /// Takes another stance; the last pose is the straight one of that stance. Does nothing where no pose may be
    /// declared so.
    pub fn take_stance(&mut self, stance: Stance) {
        if self.recentres() {
            self.config.stance = stance;
            self.recentre();
        }
    }

    /// Makes a step of the turn this large from now on, degrees; 0 for none. A size that no step has is passed over.
    pub fn snap_by(&mut self, degrees: f64) {
        if is_step(degrees) {
            self.config.snap_turn_deg = degrees;
        }
    }

    /// Turns the rider in the vehicle by steps to the left, or to the right where `steps` is negative, about the
    /// vertical through the head. The place stays; orientation and velocities turn, since the tracker's axes do. Does
    /// nothing before the first pose, in a room that its tracker is calibrated to, and where a step is none.
    pub fn snap_turn(&mut self, steps: i32) {
        let angle_rad = (f64::from(steps) * self.config.snap_turn_deg).to_radians();
        let Some(mut seen) = self.last.filter(|_| self.recentres() && angle_rad != 0.0) else { return };
        let (place, turn) = (seen.room_from_head.position, DQuat::from_rotation_y(angle_rad));
        let turned = Rigid { position: place - turn * place, orientation: turn };
        self.room_from_straight = Some(turned * self.room_from_straight());
        seen.room_from_head = Rigid { position: place, ..turned * seen.room_from_head };
        self.last = Some(seen);
        if let Some(leapt) = &mut self.leapt {
            leapt.room_from_head = turned * leapt.room_from_head;
        }
        // No place of the track has moved: the axes have turned.
        self.velocity.turn(place, turn);
        self.turn.turn(DVec3::ZERO, turn);
        self.turned_rad = turn * self.turned_rad;
    }

    fn straighten(&mut self, mut seen: SeenPose) {
        let home = Rigid { position: DVec3::from_array(self.config.home), orientation: DQuat::IDENTITY };
        let before = self.room_from_straight();
        let stands = self.config.stance == Stance::Standing;
        if stands || self.config.keeps_upright() {
            let tracked = before.inverse() * seen.room_from_head;
            let mut straight = upright(&tracked, home.position);
            if stands {
                straight.position.y = 0.0;
            }
            self.room_from_straight = Some(straight);
            seen.room_from_head = straight * tracked;
            if !stands {
                seen.room_from_head.position = home.position;
            }
        } else {
            self.room_from_straight = Some(home * seen.room_from_head.inverse() * before);
            seen.room_from_head = home;
        }
        // The step is no motion.
        self.restart(&seen, 0.0);
        (self.last, self.leapt) = (Some(seen), None);
    }

    fn accept(&mut self, pose: &TrackedPose) -> Result<(), PoseError> {
        let mut seen = self.sound(pose)?;
        let Some(last) = self.last else {
            self.moved = false;
            self.restart(&seen, 0.0);
            self.see(seen);
            if self.config.recentre == Recentring::Start {
                self.recentre();
            }
            return Ok(());
        };

        // Keep the sign of the quaternion, so that neighbours can be compared.
        if last.room_from_head.orientation.dot(seen.room_from_head.orientation) < 0.0 {
            seen.room_from_head.orientation = -seen.room_from_head.orientation;
        }

        if std::mem::take(&mut self.moved) {
            self.restart(&seen, 1.0);
            self.see(seen);
            self.recentre();
            return Ok(());
        }

        // Accept a leap once a second pose confirms it.
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
            self.restart(&seen, 1.0);
            self.see(seen);
            return Ok(());
        }

        match interval {
            PoseInterval::Steady(interval_s) => {
                self.velocity.push(interval_s, seen.room_from_head.position);
                self.turned_rad += turn(last.room_from_head.orientation, seen.room_from_head.orientation);
                self.turn.push(interval_s, self.turned_rad);
                self.rhythm_s = interval_s;
            }
            PoseInterval::Gap(_) => {
                let (_, share) = self.belief(&last, seen.at);
                self.restart(&seen, share);
            }
        }
        self.see(seen);
        Ok(())
    }

    /// Begins new tracks of place and turn, which keep a share of their velocities at first.
    fn restart(&mut self, seen: &SeenPose, share: f64) {
        self.velocity.restart(seen.room_from_head.position, self.velocity.value() * share);
        self.turn.restart(self.turned_rad, self.turn.value() * share);
    }

    fn see(&mut self, seen: SeenPose) {
        (self.last, self.leapt, self.gone) = (Some(seen), None, None);
    }

    /// Pose of the head, if the sensor's is possible.
    fn sound(&self, pose: &TrackedPose) -> Result<SeenPose, PoseError> {
        let still = pose.position_m == DVec3::ZERO && DVec3::from_slice(&pose.orientation.to_array()) == DVec3::ZERO;
        // opentrack's centre is a pose like any other.
        if still && self.config.counts_turn_and_clock() && !self.config.is_opentrack() {
            return Err(PoseError::Zero);
        }
        let length = pose.orientation.length();
        if !UNIT_LENGTHS.contains(&length) {
            return Err(PoseError::Quaternion(length));
        }
        let (position_m, orientation) = self.scaled(pose)?;
        let (position, orientation) = mirrored(&self.config.flip, position_m, orientation.normalize());
        let tracker_from_sensor = Rigid { position, orientation };
        let mut room_from_head = self.room_from_tracker * tracker_from_sensor * self.sensor_from_head;
        if let Some(room_from_straight) = self.room_from_straight {
            room_from_head = room_from_straight * room_from_head;
        }
        let measured_s = pose.measured_s.filter(|seconds| seconds.is_finite());
        Ok(SeenPose { at: pose.at, measured_s, room_from_head })
    }

    /// Place of the sensor, metres, and its turn, if they are possible.
    fn scaled(&self, pose: &TrackedPose) -> Result<(DVec3, DQuat), PoseError> {
        let usual = usual_unit(&self.config.url);
        let unit = self.config.scale.unwrap_or(usual);
        let position_m = match self.config.scale {
            Some(unit) => pose.position_m * (unit.metres() / usual.metres()),
            None => pose.position_m,
        };
        let farthest_m = match self.config.scale {
            None if self.config.knows_units() && self.config.is_opentrack() => FARTHEST_AT_DESK_M,
            None if self.config.knows_units() => FARTHEST_IN_ROOM_M,
            _ => FARTHEST_M,
        };
        if position_m.is_finite() && position_m.abs().max_element() <= farthest_m {
            return Ok((position_m, pose.orientation));
        }
        let distance = pose.position_m.length() / usual.metres();
        match LengthUnit::of_head(distance).filter(|_| self.config.knows_units()) {
            Some(likely) => Err(PoseError::Unit { distance, unit, likely }),
            None => Err(PoseError::Place(position_m)),
        }
    }

    /// Reliability of a pose at the time `at`, and the remaining share of its velocity, 0 to 1.
    fn belief(&self, last: &SeenPose, at: Nanos) -> (Tracking, f64) {
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

    /// Head at the time `at`.
    pub fn state(&self, at: Nanos) -> HeadState {
        let Some(last) = &self.last else {
            return HeadState {
                position_m: DVec3::from_array(self.config.home),
                orientation: DQuat::IDENTITY,
                velocity_m_s: DVec3::ZERO,
                turn_rad_s: DVec3::ZERO,
                tracked: Tracking::Never,
            };
        };
        let (tracked, share) = self.belief(last, at);
        let Rigid { position, orientation } = last.room_from_head;
        let turn = if self.config.counts_turn_and_clock() { self.turn.value() * share } else { DVec3::ZERO };
        let turn = (turn * TURN_STEPS).round() / TURN_STEPS;
        let velocity_m_s = self.velocity.value() * share;
        HeadState { position_m: position, orientation, velocity_m_s, turn_rad_s: turn, tracked }
    }
}

/// Transform that takes a pose to `home`, with its heading ahead: a turn about the vertical and a shift, so that what
/// is upright stays so.
fn upright(pose: &Rigid, home: DVec3) -> Rigid {
    let orientation = DQuat::from_rotation_y(-heading_rad(pose.orientation));
    Rigid { position: home - orientation * pose.position, orientation }
}

/// Heading of a turn: the angle to the left about y from −z to where it looks, radians. Who looks straight up or down
/// has that of the top of the head, which then lies backward or ahead.
fn heading_rad(turn: DQuat) -> f64 {
    /// Share of the view that points up or down from which on it says nothing of the heading.
    const STEEP: f64 = 0.99;
    let ahead = turn * DVec3::NEG_Z;
    let along = if ahead.y.abs() < STEEP { ahead } else { turn * DVec3::Y * -ahead.y.signum() };
    libm::atan2(-along.x, -along.z)
}

/// Unit of the lengths that such a tracker sends, which its decoder has turned into metres.
fn usual_unit(url: &TrackerUrl) -> LengthUnit {
    let name = match url {
        TrackerUrl::Vrpn { .. } | TrackerUrl::Openxr | TrackerUrl::Mouse => "m",
        TrackerUrl::Dtrack { .. } => "mm",
        TrackerUrl::Opentrack { .. } => "cm",
    };
    LengthUnit::named(name).expect("the unit of a tracker has a name")
}

/// Placement of the tracker's axes in the room. opentrack's centre is where the head is at home.
fn room_from_tracker(config: &HeadConfig) -> Rigid {
    let mut placed = config.room_from_tracker.rigid();
    if config.is_opentrack() {
        placed.position += DVec3::from_array(config.home);
    }
    placed
}

/// Turn from one orientation to the next in the room's axes, radians along its axis; their signs agree.
fn turn(from: DQuat, to: DQuat) -> DVec3 {
    let between = to * from.conjugate();
    let sine = DVec3::new(between.x, between.y, between.z);
    let length = sine.length();
    if length == 0.0 { DVec3::ZERO } else { sine * (2.0 * libm::atan2(length, between.w) / length) }
}
