//! Laws of turns in steps and of stances. A turn in steps turns the rider's heading by the step and leaves the place;
//! its leap is no velocity, and the velocity of a head in motion turns with the axes. Who stands keeps the height above
//! the floor and what is upright. Where neither is asked for, nothing changes to the bit. A wrong program throws the
//! rider through the vehicle, shows a flash of relativity at each flick, or lifts the floor.

use glam::{DQuat, DVec3};

use super::config::{HeadConfig, Recentring, VelocityFilter};
use super::placement::AxesPlacement;
use super::stance::Stance;
use super::state::HeadState;
use super::tracked_head::TrackedHead;
use super::tracked_pose::TrackedPose;
use crate::clock::{Nanos, SECOND};

/// Rounding of places a few metres from the origin, metres, and of velocities from their differences, m/s.
const ROUNDING_M: f64 = 1e-14;
const ROUNDING_M_S: f64 = 1e-11;
/// Rounding of a rate of turn, which is given in steps, rad/s.
const STEP_RAD_S: f64 = 2e-5;
/// Interval of a 90 Hz headset.
const FRAME: Nanos = SECOND / 90;
const HOME: [f64; 3] = [0.0, 1.7, 0.0];
/// Step of a turn, degrees.
const STEP_DEG: f64 = 30.0;

fn head(stance: Stance, velocity: VelocityFilter) -> TrackedHead {
    let config = HeadConfig {
        home: HOME,
        recentre: Recentring::Start,
        snap_turn_deg: STEP_DEG,
        stance,
        velocity,
        ..HeadConfig::new("openxr://".parse().unwrap())
    };
    TrackedHead::new(config).unwrap()
}

/// Pose of frame `number` of somebody who walks in circles, looks about and nods, far from the origin.
fn walked(number: u64) -> TrackedPose {
    let time = number as f64 / 90.0;
    let position =
        DVec3::new(3.0 + 0.4 * libm::sin(2.0 * time), 1.62 + 0.02 * libm::cos(9.0 * time), -5.0 + 0.3 * time);
    let turn =
        DQuat::from_rotation_y(1.1 + 0.9 * libm::sin(1.3 * time)) * DQuat::from_rotation_x(0.3 * libm::cos(time));
    pose(number, position, turn)
}

fn pose(number: u64, position_m: DVec3, orientation: DQuat) -> TrackedPose {
    let at = number * FRAME;
    let measured_s = Some(at as f64 / SECOND as f64);
    TrackedPose { sensor: 0, at, measured_s, latency_s: None, position_m, orientation, velocity_m_s: None }
}

fn every_filter() -> [VelocityFilter; 4] {
    [VelocityFilter::default(), VelocityFilter::least_squares(), VelocityFilter::one_euro(), VelocityFilter::Off]
}

fn near(found: DVec3, expected: DVec3, rounding: f64) {
    assert!((found - expected).length() < rounding, "{found} for {expected}");
}

/// Direction of the nose.
fn nose(state: &HeadState) -> DVec3 {
    state.orientation * DVec3::NEG_Z
}

#[test]
fn a_step_turns_the_heading_and_leaves_the_place() {
    for (stance, steps) in [(Stance::Seated, 1), (Stance::Seated, -2), (Stance::Standing, 3)] {
        let mut turned = head(stance, VelocityFilter::default());
        let mut plain = head(stance, VelocityFilter::default());
        for number in 0..20 {
            turned.pose(&walked(number));
            plain.pose(&walked(number));
        }
        let at = 19 * FRAME;
        let before = turned.state(at);
        turned.snap_turn(steps);
        let after = turned.state(at);
        let turn = DQuat::from_rotation_y((f64::from(steps) * STEP_DEG).to_radians());
        assert_eq!(after.position_m, before.position_m);
        near(nose(&after), turn * nose(&before), ROUNDING_M);
        near(after.orientation * DVec3::Y, turn * (before.orientation * DVec3::Y), ROUNDING_M);
        // The next steps of the rider lead where they would have led, seen from where the rider has turned.
        for number in 20..60 {
            turned.pose(&walked(number));
            plain.pose(&walked(number));
            let [turned, plain] = [&turned, &plain].map(|head| head.state(number * FRAME));
            near(turned.position_m - before.position_m, turn * (plain.position_m - before.position_m), 1e-13);
            near(nose(&turned), turn * nose(&plain), 1e-13);
        }
        assert_eq!(turned.rejected().number(), 0);
    }
    // To the left is counted positive.
    let mut left = head(Stance::Seated, VelocityFilter::Off);
    left.pose(&pose(0, DVec3::Y, DQuat::IDENTITY));
    left.snap_turn(3);
    near(nose(&left.state(0)), DVec3::NEG_X, ROUNDING_M);
}

#[test]
fn the_leap_of_a_step_is_no_velocity_and_a_velocity_turns_with_the_axes() {
    for filter in every_filter() {
        let [mut turned, mut plain] = [(); 2].map(|()| head(Stance::Seated, filter));
        let mut resting = head(Stance::Seated, filter);
        let mut steps = 0;
        for number in 0..120 {
            turned.pose(&walked(number));
            plain.pose(&walked(number));
            resting.pose(&pose(number, DVec3::new(3.0, 1.1, -5.0), DQuat::from_rotation_y(2.0)));
            if number > 20 && number % 7 == 0 {
                let step = if number % 3 == 0 { 1 } else { -1 };
                turned.snap_turn(step);
                resting.snap_turn(step);
                steps += step;
            }
            let turn = DQuat::from_rotation_y((f64::from(steps) * STEP_DEG).to_radians());
            let [turned, plain, rests] = [&turned, &plain, &resting].map(|head| head.state(number * FRAME));
            near(turned.velocity_m_s, turn * plain.velocity_m_s, ROUNDING_M_S);
            near(turned.turn_rad_s, turn * plain.turn_rad_s, STEP_RAD_S);
            near(rests.velocity_m_s, DVec3::ZERO, ROUNDING_M_S);
            near(rests.turn_rad_s, DVec3::ZERO, STEP_RAD_S);
        }
        assert!(plain.state(119 * FRAME).velocity_m_s.length() > 0.1);
    }
}

#[test]
fn a_leap_that_is_confirmed_after_a_step_is_where_it_was_confirmed() {
    let mut turned = head(Stance::Seated, VelocityFilter::default());
    turned.pose(&pose(0, DVec3::Y, DQuat::IDENTITY));
    turned.pose(&pose(1, DVec3::new(4.0, 1.0, 0.0), DQuat::IDENTITY));
    assert_eq!(turned.rejected().number(), 1);
    turned.snap_turn(3);
    turned.pose(&pose(2, DVec3::new(4.0, 1.0, 0.0), DQuat::IDENTITY));
    assert_eq!(turned.rejected().number(), 1, "{:?}", turned.rejected().last());
    near(turned.state(2 * FRAME).position_m, DVec3::from_array(HOME) + DVec3::NEG_Z * 4.0, ROUNDING_M);
}

#[test]
fn what_has_no_step_is_as_it_was_to_the_bit() {
    let none = |recentre, snap_turn_deg| HeadConfig {
        recentre,
        snap_turn_deg,
        ..head(Stance::Seated, VelocityFilter::Off).config().clone()
    };
    for config in [none(Recentring::Start, 0.0), none(Recentring::Never, STEP_DEG)] {
        let [mut flicked, mut plain] = [(); 2].map(|()| TrackedHead::new(config.clone()).unwrap());
        for number in 0..40 {
            flicked.pose(&walked(number));
            plain.pose(&walked(number));
            flicked.snap_turn([1, -1, 0][number as usize % 3]);
            flicked.snap_by(f64::NAN);
            assert_eq!(flicked.state(number * FRAME), plain.state(number * FRAME));
        }
    }
    // Before the first pose there is nothing to turn.
    let mut unseen = head(Stance::Seated, VelocityFilter::Off);
    unseen.snap_turn(1);
    unseen.pose(&walked(0));
    let ahead = nose(&unseen.state(0));
    near(DVec3::new(ahead.x, 0.0, ahead.z).normalize(), DVec3::NEG_Z, ROUNDING_M);
}

#[test]
fn who_stands_keeps_height_and_what_is_upright() {
    let look = DQuat::from_rotation_y(2.1) * DQuat::from_rotation_x(-0.5) * DQuat::from_rotation_z(0.2);
    let first = DVec3::new(3.0, 1.42, -5.0);
    let mut stands = head(Stance::Standing, VelocityFilter::default());
    stands.pose(&pose(0, first, look));
    let state = stands.state(0);
    near(state.position_m, DVec3::new(HOME[0], first.y, HOME[2]), ROUNDING_M);
    // The heading is ahead, and the look down is one.
    let ahead = nose(&state);
    near(DVec3::new(ahead.x, 0.0, ahead.z).normalize(), DVec3::NEG_Z, ROUNDING_M);
    assert!((ahead.y - (look * DVec3::NEG_Z).y).abs() < ROUNDING_M, "{ahead}");
    // Every height is that above the tracker's floor, whatever was turned, straightened or declared since.
    let mut heights = (1..60).map(|number| {
        let height = 1.42 + 0.005 * number as f64;
        stands.pose(&pose(number, DVec3::new(3.0, height, -5.0), look));
        match number % 20 {
            5 => stands.snap_turn(1),
            10 => stands.recentre(),
            15 => stands.take_stance(if number == 35 { Stance::Seated } else { Stance::Standing }),
            _ => {}
        }
        (number, stands.state(number * FRAME).position_m.y - height)
    });
    // From the 35th to the 55th frame, the rider sits.
    assert!(heights.all(|(number, off)| (35..55).contains(&number) || off.abs() < ROUNDING_M));

    // Who sits has the seat's height, and keeps what is upright, too; before edition 4 the whole look was straight.
    let seat = DVec3::from_array(HOME);
    let mut sits = head(Stance::Seated, VelocityFilter::default());
    let before = HeadConfig { edition: 3, ..sits.config().clone() };
    sits.pose(&pose(0, first, look));
    near(sits.state(0).position_m, seat, ROUNDING_M);
    near(nose(&sits.state(0)), ahead, ROUNDING_M);
    let level = |head: &TrackedHead| (head.state(0).orientation * DVec3::X).y - (look * DVec3::X).y;
    assert!(level(&sits).abs() < ROUNDING_M, "the head leans as it does");
    let mut sat = TrackedHead::new(before).unwrap();
    sat.pose(&pose(0, first, look));
    near(sat.state(0).position_m, seat, ROUNDING_M);
    near(nose(&sat.state(0)), DVec3::NEG_Z, ROUNDING_M);
    sits.take_stance(Stance::Standing);
    near(sits.state(0).position_m, DVec3::new(HOME[0], first.y, HOME[2]), ROUNDING_M);
    assert!((nose(&sits.state(0)).y - (look * DVec3::NEG_Z).y).abs() < ROUNDING_M);
}

#[test]
fn who_stands_and_looks_straight_up_or_down_has_the_heading_of_the_head() {
    for pitch in [1.55, -1.55, 0.8] {
        let look = DQuat::from_rotation_y(2.1) * DQuat::from_rotation_x(pitch);
        let mut stands = head(Stance::Standing, VelocityFilter::default());
        stands.pose(&pose(0, DVec3::Y, look));
        // Level again, the rider looks ahead.
        stands.pose(&pose(1, DVec3::Y, DQuat::from_rotation_y(2.1)));
        near(nose(&stands.state(FRAME)), DVec3::NEG_Z, 1e-12);
    }
}

#[test]
fn a_measured_tracker_keeps_its_room() {
    let config = HeadConfig {
        recentre: Recentring::Never,
        room_from_tracker: AxesPlacement { yaw: 90.0, ..Default::default() },
        ..head(Stance::Seated, VelocityFilter::default()).config().clone()
    };
    let mut measured = TrackedHead::new(config).unwrap();
    measured.pose(&walked(0));
    let before = measured.state(0);
    measured.take_stance(Stance::Standing);
    measured.snap_turn(2);
    assert_eq!(measured.state(0), before);
}
