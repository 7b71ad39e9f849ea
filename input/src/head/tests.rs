//! The head must be placed by the tracker's axes and the sensor's mounting, move with the velocity of the eyes, and
//! ignore impossible poses; a lost head must neither jump nor move on.

use std::f64::consts::FRAC_PI_2;

use glam::{DQuat, DVec3};

use super::config::{HeadConfig, VelocityFilter};
use super::placement::AxesPlacement;
use super::state::{HeadState, Tracking};
use super::tracked_head::TrackedHead;
use super::tracked_pose::TrackedPose;
use super::tracking_mode::TrackingMode;
use crate::clock::{Nanos, SECOND};

/// Rounding of differences of places a few metres from the origin, over a hundredth of a second, m/s.
const ROUNDING: f64 = 1e-9;

/// Interval of a 100 Hz tracker.
const FRAME: Nanos = SECOND / 100;

fn config() -> HeadConfig {
    HeadConfig::new("dtrack://".parse().unwrap())
}

fn head() -> TrackedHead {
    TrackedHead::new(HeadConfig { velocity: VelocityFilter::Off, ..config() }).unwrap()
}

/// Pose of frame `number`, measured at its arrival.
fn pose(number: u64, position_m: DVec3) -> TrackedPose {
    TrackedPose {
        sensor: 0,
        at: number * FRAME,
        measured_s: Some(1.8e9 + 0.01 * number as f64),
        latency_s: None,
        position_m,
        orientation: DQuat::IDENTITY,
        velocity_m_s: None,
    }
}

fn near(found: DVec3, expected: DVec3, tolerance: f64) {
    assert!((found - expected).length() < tolerance, "{found} for {expected}");
}

/// Head that walks ahead at 1 m/s, after ten poses.
fn walking() -> TrackedHead {
    let mut head = head();
    (0..10).for_each(|number| head.pose(&pose(number, DVec3::new(0.0, 1.7, -0.01 * number as f64))));
    assert_eq!(head.rejected().number(), 0);
    head
}

/// Time of the last pose of the walk above.
const SEEN: Nanos = 9 * FRAME;
/// Tolerance for message times, which have a resolution of a quarter of a microsecond against the frame.
const CLOCK: f64 = 1e-4;

#[test]
fn a_head_not_seen_yet_is_at_home() {
    let state = head().state(SECOND);
    assert_eq!((state.tracked, state.position_m), (Tracking::Never, DVec3::new(0.0, 1.7, 0.0)));
    assert_eq!((state.orientation, state.velocity_m_s), (DQuat::IDENTITY, DVec3::ZERO));
}

#[test]
fn the_transforms_apply_in_their_order() {
    // The tracker hangs 2 m up, turned to the left; the sensor sits 10 cm above the eyes and 5 cm behind, upside
    // down.
    let room_from_tracker = AxesPlacement { position: [0.0, 2.0, 0.0], yaw: 90.0, ..Default::default() };
    let head_from_sensor = AxesPlacement { position: [0.0, 0.1, 0.05], roll: 180.0, ..Default::default() };
    let mut head = TrackedHead::new(HeadConfig { room_from_tracker, head_from_sensor, ..config() }).unwrap();
    // A metre ahead of the tracker, 30 cm below it, turned upside down as it is mounted.
    let upside_down = DQuat::from_xyzw(0.0, 0.0, 1.0, 0.0);
    head.pose(&TrackedPose { orientation: upside_down, ..pose(0, DVec3::new(0.0, -0.3, -1.0)) });
    let state = head.state(0);
    near(state.position_m, DVec3::new(-1.05, 1.6, 0.0), ROUNDING);
    near(state.orientation * DVec3::NEG_Z, DVec3::NEG_X, ROUNDING);
    near(state.orientation * DVec3::Y, DVec3::Y, ROUNDING);
}

#[test]
fn the_velocity_is_that_of_the_eyes() {
    // The sensor stays at its place while the head, whose eyes are 20 cm ahead of it, turns at 2 rad/s to the left.
    let head_from_sensor = AxesPlacement { position: [0.0, 0.0, 0.2], ..Default::default() };
    let velocity = VelocityFilter::Off;
    let mut head = TrackedHead::new(HeadConfig { head_from_sensor, velocity, ..config() }).unwrap();
    for number in 0..50 {
        let orientation = DQuat::from_rotation_y(0.02 * number as f64);
        head.pose(&TrackedPose { orientation, ..pose(number, DVec3::Y) });
    }
    let state = head.state(49 * FRAME);
    // The velocity is 0.4 m/s to the left of the eyes' direction half a frame ago.
    let left = DQuat::from_rotation_y(0.02 * 48.5) * DVec3::NEG_X;
    near(state.velocity_m_s, 0.4 * left, CLOCK);
    near(state.position_m, DVec3::Y + DQuat::from_rotation_y(0.98) * DVec3::NEG_Z * 0.2, ROUNDING);
}

#[test]
fn message_times_make_the_velocity_not_arrivals() {
    let mut head = head();
    for number in 0..20 {
        let jitter = if number % 2 == 0 { FRAME } else { 0 };
        let walking = pose(number, DVec3::Y + DVec3::X * 0.01 * number as f64);
        head.pose(&TrackedPose { at: walking.at + jitter, ..walking });
        if number > 0 {
            near(head.state(number * FRAME).velocity_m_s, DVec3::X, CLOCK);
        }
    }
    assert_eq!(head.rejected().number(), 0);
}

#[test]
fn without_message_times_arrivals_make_the_velocity() {
    let mut head = head();
    for number in 0..20 {
        head.pose(&TrackedPose { measured_s: None, ..pose(number, DVec3::Y + DVec3::X * 0.01 * number as f64) });
    }
    near(head.state(19 * FRAME).velocity_m_s, DVec3::X, ROUNDING);
}

#[test]
fn a_lost_head_stays_and_its_velocity_fades() {
    let head = walking();
    let ahead = |at: Nanos| -head.state(at).velocity_m_s.z;
    let place = head.state(SEEN).position_m;
    assert_eq!(head.state(SEEN + SECOND / 25).tracked, Tracking::Tracked);
    assert!((ahead(SEEN + SECOND / 25) - 1.0).abs() < CLOCK);
    // Half-way through the fading.
    assert_eq!(head.state(SEEN + 3 * SECOND / 20).tracked, Tracking::Fading);
    assert!((ahead(SEEN + 3 * SECOND / 20) - 0.5).abs() < CLOCK);
    assert_eq!(head.state(SEEN + SECOND / 4 + 1).tracked, Tracking::Lost);
    let speeds: Vec<f64> = (0..100).map(|step| ahead(SEEN + step * SECOND / 200)).collect();
    assert!(speeds.is_sorted_by(|a, b| a >= b), "{speeds:?}");
    assert_eq!(speeds[99], 0.0);
    for at in [SEEN + SECOND / 10, SEEN + SECOND, SEEN + 1000 * SECOND] {
        assert_eq!(head.state(at).position_m, place);
    }
}

#[test]
fn a_slow_tracker_loses_nobody_between_its_frames() {
    let mut head = head();
    for number in 0..20 {
        // A tracker of 8 Hz.
        let at = number * SECOND / 8;
        let measured_s = Some(0.125 * number as f64);
        head.pose(&TrackedPose { at, measured_s, ..pose(0, DVec3::Y + DVec3::X * 0.125 * number as f64) });
        if number > 0 {
            let state = head.state(at + SECOND / 8);
            assert_eq!((state.tracked, state.velocity_m_s), (Tracking::Tracked, DVec3::X));
        }
    }
    assert_eq!(head.state(5 * SECOND).tracked, Tracking::Lost);
}

#[test]
fn a_tracker_that_goes_loses_the_head_at_once() {
    let mut head = walking();
    head.gone(SEEN);
    // A second loss, before the head is seen again, changes nothing.
    head.gone(SEEN + SECOND / 10);
    assert_eq!(head.state(SEEN).tracked, Tracking::Fading);
    let halfway = head.state(SEEN + SECOND / 10);
    assert!((halfway.velocity_m_s.z + 0.5).abs() < CLOCK, "{halfway:?}");
    assert_eq!(head.state(SEEN + SECOND / 5).tracked, Tracking::Lost);
}

#[test]
fn a_head_found_again_makes_no_velocity_of_the_gap() {
    let mut head = walking();
    // The head is found a second later, two metres away, at rest.
    for number in 110..120 {
        head.pose(&pose(number, DVec3::new(2.0, 1.7, 0.0)));
        let state = head.state(number * FRAME);
        assert_eq!((state.tracked, state.position_m.x), (Tracking::Tracked, 2.0));
        assert!(state.velocity_m_s.length() < CLOCK, "{state:?}");
    }
    assert_eq!(head.rejected().number(), 0);
}

#[test]
fn a_single_leap_is_rejected_and_a_repeated_one_believed() {
    let mut head = walking();
    let before = head.state(SEEN);
    head.pose(&pose(10, DVec3::new(3.0, 1.7, 0.0)));
    assert_eq!(head.state(SEEN), before);
    assert_eq!(head.rejected().number(), 1);
    assert!(head.rejected().last().unwrap().starts_with("a leap of 3.00 m in"), "{:?}", head.rejected());
    // A pose back on the old track: the leap does not count.
    head.pose(&pose(11, DVec3::new(0.0, 1.7, -0.11)));
    assert_eq!((head.state(11 * FRAME).position_m.x, head.rejected().number()), (0.0, 1));
    near(head.state(11 * FRAME).velocity_m_s, DVec3::NEG_Z, CLOCK);
    // Two leaps to different places do not count either; the second one to the same place does.
    head.pose(&pose(12, DVec3::new(3.0, 1.7, 0.0)));
    head.pose(&pose(13, DVec3::new(-3.0, 1.7, 0.0)));
    assert_eq!((head.state(13 * FRAME).position_m.x, head.rejected().number()), (0.0, 3));
    head.pose(&pose(14, DVec3::new(-3.0, 1.7, 0.0)));
    let state = head.state(14 * FRAME);
    assert_eq!((state.position_m.x, head.rejected().number()), (-3.0, 3));
    // The leap makes no velocity.
    assert!(state.velocity_m_s.length() < 1.001, "{state:?}");
    head.pose(&pose(15, DVec3::new(-3.0, 1.7, 0.0)));
    assert_eq!(head.state(15 * FRAME).velocity_m_s, DVec3::ZERO);
}

#[test]
fn the_same_message_twice_confirms_no_leap() {
    let mut head = walking();
    let leap = pose(10, DVec3::new(3.0, 1.7, 0.0));
    (0..5).for_each(|_| head.pose(&leap));
    assert_eq!((head.state(SEEN).position_m.x, head.rejected().number()), (0.0, 5));
}

#[test]
fn a_turning_head_has_the_velocity_of_its_turn() {
    // 2 rad/s about an axis that is none of the room's, in a room whose tracker hangs askew.
    let axis = DVec3::new(0.3, 0.9, -0.2).normalize();
    for velocity in [VelocityFilter::Off, VelocityFilter::default(), VelocityFilter::least_squares()] {
        let room_from_tracker = AxesPlacement { yaw: 30.0, pitch: -20.0, ..Default::default() };
        let mut head = TrackedHead::new(HeadConfig { velocity, room_from_tracker, ..config() }).unwrap();
        for number in 0..50 {
            let sign = if number % 3 == 0 { -1.0 } else { 1.0 };
            let orientation = DQuat::from_axis_angle(axis, 0.02 * number as f64) * sign;
            head.pose(&TrackedPose { orientation, ..pose(number, DVec3::Y) });
        }
        let room_from_tracker = DQuat::from_euler(glam::EulerRot::YXZ, 30_f64.to_radians(), -20_f64.to_radians(), 0.0);
        near(head.state(49 * FRAME).turn_rad_s, room_from_tracker * axis * 2.0, CLOCK * 2.0);
        // It fades with the velocity, and recordings of the first edition know none.
        assert_eq!(head.state(100 * FRAME).turn_rad_s, DVec3::ZERO);
        let mut old = TrackedHead::new(HeadConfig { velocity, edition: 1, ..config() }).unwrap();
        for number in 0..9 {
            let orientation = DQuat::from_axis_angle(axis, 0.02 * number as f64);
            old.pose(&TrackedPose { orientation, ..pose(number, DVec3::Y) });
        }
        assert_eq!(old.state(8 * FRAME).turn_rad_s, DVec3::ZERO);
    }
}

#[test]
fn the_zero_pose_is_a_head_that_is_lost() {
    let mut head = walking();
    let place = head.state(SEEN).position_m;
    (10..40).for_each(|number| head.pose(&pose(number, DVec3::ZERO)));
    let state = head.state(40 * FRAME);
    assert_eq!((state.position_m, state.tracked), (place, Tracking::Lost));
    assert!(head.rejected().last().unwrap().starts_with("the zero pose"), "{:?}", head.rejected());
    head.pose(&pose(41, place));
    assert_eq!(head.state(41 * FRAME).tracked, Tracking::Tracked);
}

#[test]
fn nonsense_is_rejected_and_counted() {
    let mut head = walking();
    let before = head.state(SEEN);
    let good = pose(10, DVec3::new(0.0, 1.7, -0.1));
    let nonsense = [
        TrackedPose { position_m: DVec3::new(f64::NAN, 0.0, 0.0), ..good },
        TrackedPose { position_m: DVec3::new(0.0, f64::INFINITY, 0.0), ..good },
        TrackedPose { position_m: DVec3::splat(1e300), ..good },
        TrackedPose { orientation: DQuat::from_xyzw(0.0, 0.0, 0.0, 0.98), ..good },
        TrackedPose { orientation: DQuat::from_xyzw(0.0, 0.0, 0.0, 0.0), ..good },
        TrackedPose { orientation: DQuat::from_xyzw(f64::NAN, 0.0, 0.0, 1.0), ..good },
        pose(9, DVec3::new(0.0, 1.7, -0.1)),
        pose(5, DVec3::new(0.0, 1.7, -0.1)),
    ];
    for (number, pose) in (1..).zip(nonsense) {
        head.pose(&pose);
        assert_eq!((head.rejected().number(), head.state(SEEN)), (number, before), "{pose:?}");
    }
    // A quaternion within the tolerance is normalised.
    head.pose(&TrackedPose { orientation: DQuat::from_xyzw(0.0, 0.0, 0.0, 1.005), ..good });
    assert_eq!(head.state(10 * FRAME).orientation, DQuat::IDENTITY);
    head.pose(&TrackedPose { sensor: 1, ..pose(11, DVec3::splat(f64::NAN)) });
    assert_eq!(head.rejected().number(), 8, "other sensors are nobody's business");
}

#[test]
fn a_tracker_whose_clock_is_set_is_followed() {
    let mut head = walking();
    for (number, clock_s) in [(10, 5.0), (11, 5.01), (12, 5e9), (13, 5e9 + 0.01)] {
        let position = DVec3::new(0.0, 1.7, -0.01 * number as f64);
        head.pose(&TrackedPose { measured_s: Some(clock_s), ..pose(number, position) });
        assert_eq!(head.state(number * FRAME).position_m, position);
        near(head.state(number * FRAME).velocity_m_s, DVec3::NEG_Z, 1e-3);
    }
    assert_eq!(head.rejected().number(), 0);
}

#[test]
fn quaternions_keep_their_sign() {
    let mut head = head();
    for (number, sign) in (0..6).zip([1.0, -1.0, -1.0, 1.0, -1.0, 1.0]) {
        let orientation = DQuat::from_rotation_y(FRAC_PI_2) * sign;
        head.pose(&TrackedPose { orientation, ..pose(number, DVec3::Y) });
        assert!(head.state(number * FRAME).orientation.w > 0.0);
    }
}

#[test]
fn modes_use_what_they_say() {
    let state = walking().state(SEEN);
    assert_eq!(TrackingMode::PositionAndVelocity.of(state), Some(state));
    assert_eq!(
        TrackingMode::Position.of(state),
        Some(HeadState { velocity_m_s: DVec3::ZERO, turn_rad_s: DVec3::ZERO, ..state })
    );
    assert_eq!(TrackingMode::None.of(state), None);
}
