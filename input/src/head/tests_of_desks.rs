//! At a desk nobody measures: units, mirrors and the straight pose must bring the head to where the rider's is. A wrong
//! program would show the cobbles, move the picture against the head, or let the head leap when it is straightened.

use glam::{DQuat, DVec3};

use super::config::{HeadConfig, Recentring, VelocityFilter};
use super::flip::FlipAxis;
use super::placement::AxesPlacement;
use super::state::HeadState;
use super::tracked_head::TrackedHead;
use super::tracked_pose::TrackedPose;
use super::unit::LengthUnit;
use crate::clock::{Nanos, SECOND};

/// Rounding of places a few metres from the origin, metres.
const ROUNDING: f64 = 1e-14;
/// Interval of a 100 Hz tracker.
const FRAME: Nanos = SECOND / 100;
const HOME: DVec3 = DVec3::new(0.0, 1.6, 0.0);

fn config(url: &str) -> HeadConfig {
    HeadConfig {
        home: HOME.to_array(),
        velocity: VelocityFilter::Off,
        recentre: Recentring::Key,
        ..HeadConfig::new(url.parse().unwrap())
    }
}

/// Pose of frame `number`.
fn pose(number: u64, position_m: DVec3, orientation: DQuat) -> TrackedPose {
    let at = number * FRAME;
    TrackedPose { sensor: 0, at, measured_s: None, latency_s: None, position_m, orientation, velocity_m_s: None }
}

/// Head after one pose.
fn seen(config: HeadConfig, position_m: DVec3, orientation: DQuat) -> HeadState {
    let mut head = TrackedHead::new(config).unwrap();
    head.pose(&pose(0, position_m, orientation));
    assert_eq!(head.rejected().last(), None);
    head.state(0)
}

/// Sentence on a pose at this place; `None` if it is taken.
fn refusal(config: HeadConfig, position_m: DVec3) -> Option<String> {
    let mut head = TrackedHead::new(config).unwrap();
    head.pose(&pose(0, position_m, DQuat::IDENTITY));
    head.rejected().last().map(str::to_owned)
}

fn near(found: DVec3, expected: DVec3) {
    assert!((found - expected).length() < ROUNDING, "{found} for {expected}");
}

#[test]
fn a_unit_scales_what_was_sent_and_a_mirror_turns_left_into_right_before_the_placement() {
    let room_from_tracker = AxesPlacement { position: [0.0, 2.0, 0.0], yaw: 90.0, ..Default::default() };
    let turn = DQuat::from_rotation_y(0.3);
    // Feet of a left-handed tracker, whose z is ahead: as they come, a decoder takes them for metres.
    let scale = Some(LengthUnit::named("ft").unwrap());
    let vrpn = HeadConfig { scale, flip: vec![FlipAxis::Z], room_from_tracker, ..config("vrpn://lab/Head") };
    let state = seen(vrpn, DVec3::new(1.0, 0.0, 2.0), turn);
    // A foot to the right and two ahead; the tracker's right is the room's back.
    near(state.position_m, DVec3::new(-0.6096, 2.0, -0.3048));
    near(state.orientation * DVec3::NEG_Z, DQuat::from_rotation_y(90_f64.to_radians() - 0.3) * DVec3::NEG_Z);

    // DTrack's numbers are millimetres, so the decoder has divided them by a thousand.
    for (unit, expected) in [("mm", 0.7), ("cm", 7.0), ("m", 700.0)] {
        let scale = Some(LengthUnit::named(unit).unwrap());
        let state = seen(HeadConfig { scale, ..config("dtrack://") }, DVec3::X * 0.7, DQuat::IDENTITY);
        near(state.position_m / expected, DVec3::X);
    }
}

#[test]
fn a_pose_that_can_only_be_in_another_unit_says_so() {
    let vrpn = config("vrpn://lab/Head");
    let told = refusal(vrpn.clone(), DVec3::new(0.0, 1700.0, 0.0)).unwrap();
    let expected = "a pose 1700 metres from the tracker's origin: does the tracker send millimetres? Set scale = \"mm\" \
                    in [tracker]";
    assert_eq!(told, expected);
    assert!(refusal(vrpn.clone(), DVec3::new(0.0, 170.0, 0.0)).unwrap().contains("scale = \"cm\""));
    assert!(refusal(vrpn.clone(), DVec3::X * 1e7).unwrap().contains("which is nowhere"));
    assert_eq!(refusal(vrpn.clone(), DVec3::X * 49.0), None);
    // 600 of opentrack's centimetres are six metres from the screen.
    let told = refusal(config("opentrack://"), DVec3::Z * 6.0).unwrap();
    assert!(told.contains("600 centimetres from") && told.contains("scale = \"mm\""), "{told}");

    // Whoever names the unit is believed, and older recordings keep their poses.
    let scale = Some(LengthUnit::new(1.0).unwrap());
    assert_eq!(refusal(HeadConfig { scale, ..vrpn.clone() }, DVec3::Y * 170.0), None);
    assert_eq!(refusal(HeadConfig { edition: 2, ..vrpn.clone() }, DVec3::Y * 170.0), None);
    assert!(refusal(HeadConfig { edition: 2, ..vrpn }, DVec3::Y * 1700.0).unwrap().contains("nowhere"));
}

#[test]
fn a_head_of_opentrack_moves_from_home() {
    let config = config("opentrack://");
    let state = seen(config.clone(), DVec3::new(0.1, 0.0, -0.2), DQuat::IDENTITY);
    near(state.position_m, HOME + DVec3::new(0.1, 0.0, -0.2));
    // opentrack's centre is no lost head.
    near(seen(config, DVec3::ZERO, DQuat::IDENTITY).position_m, HOME);
}

#[test]
fn the_straight_pose_is_at_home_and_its_directions_are_the_rooms() {
    let mut head = TrackedHead::new(config("vrpn://lab/Head")).unwrap();
    head.recentre();
    let (place, turn) = (DVec3::new(3.0, 0.9, -2.0), DQuat::from_rotation_y(1.2) * DQuat::from_rotation_x(-0.2));
    let mut number = 0;
    // Twice, because the second time counts from the first.
    for step in [DVec3::ZERO, DVec3::new(0.03, -0.02, 0.01)] {
        for _ in 0..3 {
            number += 1;
            head.pose(&pose(number, place + turn * step, turn * DQuat::from_rotation_z(step.x)));
        }
        head.recentre();
        let state = head.state(number * FRAME);
        assert_eq!((state.position_m, state.orientation), (HOME, DQuat::IDENTITY));
        assert_eq!((state.velocity_m_s, state.turn_rad_s), (DVec3::ZERO, DVec3::ZERO));
    }
    // 2 cm ahead of the last straight pose, turned to the left by 0.1.
    let straight = turn * DQuat::from_rotation_z(0.03);
    let ahead = place + turn * DVec3::new(0.03, -0.02, 0.01) + straight * DVec3::NEG_Z * 0.02;
    head.pose(&pose(number + 1, ahead, straight * DQuat::from_rotation_y(0.1)));
    let state = head.state((number + 1) * FRAME);
    assert_eq!(head.rejected().last(), None);
    near(state.position_m, HOME + DVec3::NEG_Z * 0.02);
    near(state.orientation * DVec3::NEG_Z, DQuat::from_rotation_y(0.1) * DVec3::NEG_Z);
    assert!((state.velocity_m_s - DVec3::NEG_Z * 2.0).length() < 1e-9, "{}", state.velocity_m_s);
}

#[test]
fn a_calibrated_room_is_never_straightened_and_a_window_by_its_first_pose() {
    let (place, turn) = (DVec3::new(0.4, 1.7, 0.6), DQuat::from_rotation_y(0.5));
    for (recentre, expected) in [(Recentring::Never, place), (Recentring::Key, place), (Recentring::Start, HOME)] {
        let mut head = TrackedHead::new(HeadConfig { recentre, ..config("vrpn://lab/Head") }).unwrap();
        head.pose(&pose(0, place, turn));
        near(head.state(0).position_m, expected);
        head.recentre();
        near(head.state(0).position_m, if recentre == Recentring::Never { place } else { HOME });
    }
}

#[test]
fn axes_that_a_tracker_moves_are_no_motion_and_make_the_present_place_the_seat() {
    // A step that a head could make in that time, and one that none could.
    for step in [0.05, 3.0] {
        for (recentre, is_seat) in [(Recentring::Never, false), (Recentring::Key, true), (Recentring::Start, true)] {
            let mut head = TrackedHead::new(HeadConfig { recentre, ..config("openxr://") }).unwrap();
            // A walk along x with 1 m/s.
            let at = |number: u64| DVec3::new(0.01 * number as f64, 1.7, 0.0);
            (0..5).for_each(|number| head.pose(&pose(number, at(number), DQuat::IDENTITY)));
            head.axes_moved();
            let moved = |number: u64| at(number) + DVec3::NEG_Z * step;
            head.pose(&pose(5, moved(5), DQuat::IDENTITY));
            let state = head.state(5 * FRAME);
            near(state.position_m, if is_seat { HOME } else { moved(5) });
            assert!((state.velocity_m_s - if is_seat { DVec3::ZERO } else { DVec3::X }).length() < 1e-9, "{state:?}");
            // The walk goes on from there, at its own speed.
            head.pose(&pose(6, moved(6), DQuat::IDENTITY));
            let state = head.state(6 * FRAME);
            near(state.position_m, if is_seat { HOME + DVec3::X * 0.01 } else { moved(6) });
            assert!((state.velocity_m_s - DVec3::X).length() < 1e-9, "{state:?}");
            assert_eq!(head.rejected().number(), 0);
        }
    }
}
