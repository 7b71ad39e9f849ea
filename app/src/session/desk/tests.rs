//! Law: at a desk the head moves the picture as a window moves before it. Each of opentrack's six numbers is followed
//! from its datagram to the place on the monitor where a far point is seen, whose exact value geometry gives. A
//! mirrored axis, a wrong unit or a monitor at another height would show a street that moves against the head, or the
//! cobbles.
#![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

use crate::session::tracker::head;
use glam::{DQuat, DVec2, DVec3};
use hardware::SetUp;
use hardware::head_config;
use input::{Desk, DeskConfig, KeyboardKey, SECOND, Sample, SampleSource};
use physics::worldline::{Thrust, WorldlineState};
use physics::{Celerity, Event};
use room::{Display, EyeSide};
use walls::Occupant;

/// Rounding of places on the monitor, metres.
const ROUNDING: f64 = 1e-9;
/// Distance of what counts as far, metres: a head's step moves it by less than the rounding.
const FAR_M: f64 = 1e10;
/// Distance of the monitor from the head at home, metres.
const AWAY_M: f64 = 0.6;

/// Rider at a desk.
struct AtDesk {
    display: Display,
    desk: Desk,
    at: u64,
}

impl AtDesk {
    fn new(display: &str, url: &str) -> Self {
        let display = Display::built_in(display).unwrap();
        let head = head_config(Some(&display), &SetUp::default(), Some(&url.parse().unwrap())).unwrap();
        Self { display, desk: Desk::new(DeskConfig { head, ..Default::default() }).unwrap(), at: 0 }
    }

    /// Feeds a sample often enough that the head rests.
    fn feed(&mut self, source: SampleSource, bytes: &[u8]) {
        for _ in 0..60 {
            self.at += SECOND / 100;
            self.desk.feed(&Sample::bytes(self.at, source, bytes));
        }
    }

    fn pose(&mut self, numbers: [f64; 6]) {
        let bytes: Vec<u8> = numbers.iter().flat_map(|number| number.to_le_bytes()).collect();
        self.feed(SampleSource::Opentrack, &bytes);
    }

    /// Place on the monitor, metres to the right of and above its middle, where a point of the street is seen that is
    /// far away in this direction of the vehicle; and the height of the eye above the street.
    fn seen(&mut self, direction: DVec3) -> (DVec2, f64) {
        let state = self.desk.controls(self.at).head.unwrap();
        let event = Event { ct: 0.0, position: DVec3::ZERO };
        let vehicle = WorldlineState::new(event, Celerity::ZERO, DQuat::IDENTITY);
        let occupant = Occupant { vehicle, thrust: Thrust::default(), head: head(&state, 25.0 / 3.0) };
        assert_eq!(occupant.head.celerity, Celerity::ZERO);
        let eye = occupant.eye(&self.display.viewer, EyeSide::Centre);
        let towards = direction.normalize() * FAR_M - eye.observer.event.position;
        let towards = eye.observer_from_room.inverse() * towards;
        let flat = self.display.channels[0].flat(&self.display).unwrap();
        let middle = flat.lower_left + 0.5 * (flat.right + flat.up);
        let [right, up] = [flat.right, flat.up].map(DVec3::normalize);
        let back = right.cross(up);
        let share = (middle - eye.place_m).dot(back) / towards.dot(back);
        let on_monitor = eye.place_m + towards * share - middle;
        (DVec2::new(on_monitor.dot(right), on_monitor.dot(up)), eye.observer.event.position.y)
    }

    fn assert_seen(&mut self, direction: DVec3, expected: [f64; 2], what: &str) {
        let (seen, _) = self.seen(direction);
        assert!(seen.distance(expected.into()) < ROUNDING, "{what}: {seen} for {expected:?}");
    }
}

#[test]
fn each_number_of_opentrack_moves_the_picture_as_a_window_before_the_head() {
    let mut rider = AtDesk::new("desk", "opentrack://");
    let aside = DVec3::new(0.2, 0.1, -1.0);
    rider.pose([0.0; 6]);
    rider.assert_seen(DVec3::NEG_Z, [0.0, 0.0], "the horizon is in the middle");
    rider.assert_seen(aside, [0.2 * AWAY_M, 0.1 * AWAY_M], "true to scale");
    // The eye is where that of the plain window is.
    assert_eq!(rider.seen(aside).1, view::EYE_HEIGHT_M);

    let tan = |degrees: f64| degrees.to_radians().tan() * AWAY_M;
    let (sine, cosine) = 15_f64.to_radians().sin_cos();
    for (numbers, direction, expected, what) in [
        ([0.0, 0.0, -10.0, 0.0, 0.0, 0.0], aside, [0.2 * 0.5, 0.1 * 0.5], "closer, one sees more"),
        ([-10.0, 0.0, 0.0, 0.0, 0.0, 0.0], DVec3::NEG_Z, [0.1, 0.0], "what is ahead of the eye goes right with it"),
        ([0.0, 10.0, 0.0, 0.0, 0.0, 0.0], DVec3::NEG_Z, [0.0, 0.1], "and up with it"),
        ([0.0, 0.0, 0.0, -20.0, 0.0, 0.0], DVec3::NEG_Z, [tan(20.0), 0.0], "turned left, the street goes right"),
        ([0.0, 0.0, 0.0, 0.0, 15.0, 0.0], DVec3::NEG_Z, [0.0, -tan(15.0)], "turned up, it goes down"),
        (
            [0.0, 0.0, 0.0, 0.0, 0.0, 15.0],
            DVec3::new(0.2, 0.0, -1.0),
            [0.2 * AWAY_M * cosine, -0.2 * AWAY_M * sine],
            "inclined to the left, it turns to the right",
        ),
    ] {
        rider.pose(numbers);
        rider.assert_seen(direction, expected, what);
    }
}

#[test]
fn the_straight_pose_shows_the_street_ahead_from_the_plain_windows_height() {
    let mut rider = AtDesk::new("desk", "opentrack://");
    // A camera at the left edge of the monitor, without opentrack's centre.
    rider.pose([-12.0, 8.0, 60.0, 25.0, -12.0, 3.0]);
    assert!(rider.seen(DVec3::NEG_Z).0.length() > 0.1);
    rider.desk.feed(&Sample::key(rider.at, KeyboardKey::U, true));
    rider.assert_seen(DVec3::NEG_Z, [0.0, 0.0], "straight");
    assert_eq!(rider.seen(DVec3::NEG_Z).1, view::EYE_HEIGHT_M);
    // The same head, which the camera sees turned to the left by 20 degrees more.
    rider.pose([-12.0, 8.0, 60.0, 5.0, -12.0, 3.0]);
    assert!((rider.seen(DVec3::NEG_Z).0.x - 20_f64.to_radians().tan() * AWAY_M).abs() < 0.03);
}

#[test]
fn a_standing_head_before_the_window_sees_the_street_and_no_cobbles() {
    let frame = |y_mm: f64| format!("fr 1\r\n6d 1 [0 1.0][300.0 {y_mm} 900.0 0 0 0][0 0 -1 0 1 0 1 0 0]\r\n");
    let mut rider = AtDesk::new("window", "dtrack://");
    // A head at 1.7 m that a tracker sees turned to the left: the first pose is the straight one.
    rider.feed(SampleSource::Dtrack, frame(1700.0).as_bytes());
    rider.assert_seen(DVec3::NEG_Z, [0.0, 0.0], "the first pose");
    rider.feed(SampleSource::Dtrack, frame(1720.0).as_bytes());
    rider.assert_seen(DVec3::NEG_Z, [0.0, 0.02], "2 cm higher");
}
